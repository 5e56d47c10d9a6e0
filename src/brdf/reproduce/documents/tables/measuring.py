"""Errors of every option, and total intensities, of the shipped materials."""

from __future__ import annotations

import functools
import itertools
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from ....loading import load
from ....metrics.importance import Errors, ErrorsAgainst, importance_pairs
from ....reflectance import Reflectance
from ....render.progress import Progress
from ....representations.baking.alpha_search import STEPS, total_intensity, with_alpha
from ....representations.tables.layouts import named_layout
from ....threads import map_threads
from .options import Alphas, measured_alphas_of, tables
from .settings import FIT, Settings, chosen

SEED = 7
"""Of the pairs errors are measured at; those that alphas and layouts are chosen at have others."""

INTENSITY_SHAPE = (16, 16, 32)
"""Of the tables whose total intensities are compared: their ratios do not depend on it."""


@dataclass(frozen=True)
class Intensities:
    """Mean texels [1/sr] of one material's tables."""

    identity: float
    uniform: float
    bezier: dict[Alphas, float]
    """By (alpha_theta, alpha_phi)."""

    @property
    def best(self) -> Alphas:
        """The alphas of the largest one."""
        return max(self.bezier, key=self.bezier.__getitem__)


@dataclass
class Measured:
    """What was found, by material."""

    intensities: dict[str, Intensities] = field(default_factory=dict)
    alphas: dict[str, dict[str, Alphas]] = field(default_factory=dict)
    errors: dict[tuple[str, float], dict[str, Errors]] = field(default_factory=lambda: defaultdict(dict))
    """By option and KB."""

    @property
    def names(self) -> list[str]:
        return list(self.intensities)

    @property
    def options(self) -> list[str]:
        return list(dict.fromkeys(option for option, _ in self.errors))

    @property
    def budgets(self) -> list[float]:
        return sorted({kilobytes for _, kilobytes in self.errors})

    def ratios(self, worse: str, better: str, kilobytes: float, error: int = 0) -> list[float]:
        """By how much the second option's error (0 relative, 1 display) is smaller, material by material."""
        a, b = self.errors[worse, kilobytes], self.errors[better, kilobytes]
        return [a[name][error] / b[name][error] for name in a]

    def median(self, option: str, kilobytes: float, error: int = 0) -> float:
        """Over the materials."""
        return float(np.median([e[error] for e in self.errors[option, kilobytes].values()]))

    def worst(self, option: str, kilobytes: float, error: int = 0) -> float:
        """Over the materials."""
        return max(e[error] for e in self.errors[option, kilobytes].values())


def measured(settings: Settings) -> Measured:
    """Every option of every chosen material."""
    found = Measured()
    names = chosen(settings)
    with Progress("errors of the shipped materials", len(names), None) as bar:

        def one(name: str) -> tuple[Intensities, dict[str, Alphas], dict[tuple[str, float], Errors]]:
            m = load(f"{name}@{FIT}")
            intensities, alphas = choices_of(f"{name}@{FIT}")
            errors = errors_of(m, settings.budgets, alphas, settings.pairs)
            bar.step()
            return intensities, alphas, errors

        for name, (intensities, alphas, errors) in zip(names, map_threads(one, names), strict=True):
            found.intensities[name], found.alphas[name] = intensities, alphas
            for key, error in errors.items():
                found.errors[key][name] = error
    return found


@functools.cache
def choices_of(text: str) -> tuple[Intensities, dict[str, Alphas]]:
    """The total intensities of a material's tables, and its alphas by origin; `text` as for `load`."""
    m = load(text)
    intensities = intensities_of(m)
    return intensities, {"intensity": intensities.best, "measured": measured_alphas_of(m)}


def intensities_of(m: Reflectance) -> Intensities:
    """Total intensities of the three parameterisations, the third over a grid of both alphas."""
    layout = named_layout("normal", "bezier", INTENSITY_SHAPE)
    plain = {
        warp: total_intensity(m, named_layout("normal", warp, INTENSITY_SHAPE)) for warp in ("identity", "uniform")
    }
    grid = [round(float(alpha), 6) for alpha in np.linspace(0, 1, STEPS)]
    pairs = itertools.product(grid, grid)
    return Intensities(**plain, bezier={pair: total_intensity(m, with_alpha(m, layout, pair)) for pair in pairs})


def errors_of(
    m: Reflectance, budgets: Sequence[float], alphas: dict[str, Alphas], pairs: int
) -> dict[tuple[str, float], Errors]:
    """Of every option that fits into each budget [KB], by both."""
    against = ErrorsAgainst(m, importance_pairs(pairs, SEED))
    return {
        (option, kilobytes): against(bake()) for kilobytes in budgets for option, bake in tables(m, kilobytes, alphas)
    }
