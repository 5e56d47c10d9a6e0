"""The errors of all candidates on all materials."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .... import metrics
from ....formula.engine import SMALL
from ....formula.kernels import compile_ahead
from ....loading import load
from ....reflectance import Reflectance
from ....render.progress import Progress
from ....threads import cores
from .candidates import Candidate, by_bytes, by_pictures, largest
from .settings import FIT, Settings, chosen

Array = NDArray[np.floating[Any]]
Key = tuple[str, str, float]

CAP = 100.0
"""dB at which an exact agreement counts in a mean."""

STATISTICS: Mapping[str, Callable[[Array], float]] = {
    "mean": lambda values: float(np.minimum(values, CAP).mean()),
    "median": lambda values: float(np.median(values)),
    "min": lambda values: float(values.min()),
}


@dataclass
class Errors:
    """PSNR [dB] by material, and bytes, of each (sweep, method, key)."""

    psnr: dict[Key, dict[str, float]] = field(default_factory=lambda: defaultdict(dict))
    nbytes: dict[Key, int] = field(default_factory=dict)

    def statistic(
        self, sweep: str, method: str, key: float, name: str = "mean", materials: Iterable[str] | None = None
    ) -> float | None:
        """One of `STATISTICS` over the materials (all), or nothing where it was not measured."""
        found = self.psnr.get((sweep, method, key))
        if not found:
            return None
        return STATISTICS[name](np.array([found[material] for material in (materials or found)]))

    def mean(self, sweep: str, method: str, key: float, materials: Iterable[str] | None = None) -> float:
        """Mean PSNR; NaN where it was not measured."""
        found = self.statistic(sweep, method, key, "mean", materials)
        return math.nan if found is None else found

    def methods(self, sweep: str) -> list[str]:
        return list(dict.fromkeys(method for found, method, _ in self.psnr if found == sweep))

    def keys(self, sweep: str) -> list[float]:
        return sorted({key for found, _, key in self.psnr if found == sweep})


def measured(settings: Settings) -> Errors:
    """Every candidate of every chosen material."""
    errors = Errors()
    names = chosen(settings)
    with Progress("errors of the shipped materials", len(names), None) as bar:
        for name in names:
            m = load(f"{name}@{FIT}")
            if name == names[0]:
                _compile([candidate.reflectance for candidate in _candidates(m, settings)], settings)
            measure(errors, name, m, _candidates(m, settings), settings.sphere)
            bar.step()
    return errors


def measure(errors: Errors, name: str, m: Reflectance, candidates: Iterable[Candidate], sphere: int) -> None:
    """Add the errors of `candidates` for the material `m`."""
    reference = metrics.sphere_radiance(m, sphere)
    for sweep, method, key, made in candidates:
        errors.psnr[sweep, method, key][name] = metrics.psnr_of(reference, metrics.sphere_radiance(made, sphere))
        errors.nbytes[sweep, method, key] = made.nbytes


def _candidates(m: Reflectance, settings: Settings) -> Iterable[Candidate]:
    yield from by_pictures(m, settings.texture)
    yield from by_bytes(m, settings.budgets, settings.fitted)
    yield from largest(m, settings.largest)


def _compile(made: list[Reflectance], settings: Settings) -> None:
    """On every core a process that compiles its share of the kernels, where pictures are large enough to need them."""
    if len(metrics.sphere_pairs(settings.sphere)[0]) >= SMALL:
        for core in range(cores()):
            compile_ahead(made[core :: cores()])
