"""What a fit gives: the material, its parameters with their errors, and how far it is from the data."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..geometry.directions import to_half_difference
from ..metrics import LOG_OFFSET, METRICS
from ..reflectance import Reflectance
from .pictures import picture_error, radiances
from .samples import Samples

Array = NDArray[np.floating[Any]]

IMAGE = "image"
"""The metric of pictures of a sphere, and the loss of that name."""

MAP_SIZE = 45
"""Cells of a residual map along theta_h and theta_d: two degrees of theta_d each."""


@dataclass(frozen=True)
class Estimate:
    """One fitted number."""

    name: str
    value: float
    error: float
    """Standard error; infinite where the data do not determine it, NaN where it was held or lies at a bound."""
    state: str
    """"free", "held" or "at bound"."""


@dataclass(frozen=True, eq=False)
class FitResult:
    """A model fitted to data."""

    reflectance: Reflectance
    """The fitted material; `.save(path)` keeps it."""
    data: str
    model: str
    lobes: int
    metric: str
    """Name of the loss."""
    parameters: tuple[Estimate, ...]
    correlation: Array
    """(P, P) of the parameters; NaN for those that have no error"""
    warnings: tuple[str, ...]
    errors: dict[str, float]
    """Every metric between the data and the fit; `image` where the data can be seen in a picture."""
    residual_map: Array
    """(45, 45) weighted mean of ln (f_fit cos + e) / (f cos + e): row theta_d, column sqrt(theta_h); NaN: no data"""
    cost: float
    """Half the weighted sum of squared residuals"""
    bic: float
    """Bayesian information criterion; fits of the same data with other numbers of lobes are compared by it."""
    samples: int
    left_out: int
    """Pairs that were not fitted: invalid, or beyond the grazing angle."""
    grazing: float
    """Degrees from the normal beyond which nothing was fitted."""
    starts: int
    agreeing: int
    """Starts that ended in the same minimum."""
    seed: int
    seconds: float
    robust: str = ""

    def rows(self) -> list[tuple[str, str, str]]:
        """(parameter, value, standard error) lines."""
        return [(e.name, f"{e.value:.5g}", _shown(e)) for e in self.parameters]

    def table(self) -> str:
        """Parameters, metrics and warnings as text."""
        width = max(len(e.name) for e in self.parameters)
        lines = [f"{self.data or 'data'} fitted by {self.model}, {self.metric}"]
        lines += [f"  {name:{width}}  {value:>12}  {error}" for name, value, error in self.rows()]
        lines += [f"  {name:{width}}  {value:12.5g}" for name, value in self.errors.items()]
        return "\n".join([*lines, *(f"  ! {warning}" for warning in self.warnings)])

    def numbers(self) -> dict[str, Any]:
        """Everything but the material and the map, as plain data."""
        return {
            "data": self.data, "model": self.model, "lobes": self.lobes, "metric": self.metric, "robust": self.robust,
            "parameters": {
                e.name: {"value": e.value, "error": e.error, "state": e.state} for e in self.parameters
            },
            "errors": self.errors, "warnings": list(self.warnings), "cost": self.cost, "bic": self.bic,
            "samples": self.samples, "left_out": self.left_out, "grazing": self.grazing, "starts": self.starts,
            "agreeing": self.agreeing, "seed": self.seed, "seconds": self.seconds,
        }  # fmt: skip

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the fitted material, which `brdf.load` reads. Raises FileError."""
        self.reflectance.save(path)


def _shown(e: Estimate) -> str:
    if e.state != "free":
        return e.state
    return f"± {e.error:.2g}" if math.isfinite(e.error) else "not determined"


def errors_of(samples: Samples, fitted: Array, pictures: Array | None, m: Reflectance) -> dict[str, float]:
    """Every metric: `fitted` (N, 3) are the fit's values at the samples, `pictures` the data's radiances."""
    cosine = samples.wi[:, 2:].astype(np.float64)
    weight = samples.weight.mean(1)
    weight = weight / weight.sum()
    pair = samples.values * cosine, np.asarray(fitted, np.float64) * cosine
    found = {name: metric(*pair, weight) for name, metric in METRICS.items()}
    if pictures is not None:
        found[IMAGE] = picture_error(pictures, radiances(m))
    return found


def residual_map(samples: Samples, fitted: Array, size: int = MAP_SIZE) -> Array:
    """(size, size) weighted mean of ln (f_fit cos + e) / (f cos + e) over channels and phi_d."""
    h = to_half_difference(samples.wi, samples.wo)
    column = np.sqrt(h.theta_h / (math.pi / 2)) * size
    row = h.theta_d / (math.pi / 2) * size
    cell = np.clip(row, 0, size - 1).astype(np.intp) * size + np.clip(column, 0, size - 1).astype(np.intp)
    cosine = samples.wi[:, 2:]
    ratio = np.log((fitted * cosine + LOG_OFFSET) / (samples.values * cosine + LOG_OFFSET)).mean(1)
    weight = samples.weight.mean(1)
    total = np.bincount(cell, weight, size * size)
    with np.errstate(invalid="ignore"):
        return np.asarray((np.bincount(cell, weight * ratio, size * size) / total).reshape(size, size))
