"""Errors over pairs of directions: numbers, and a map over half and difference angle."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError
from ..geometry.directions import from_half_difference
from ..reflectance import Reflectance

Array = NDArray[np.floating[Any]]

LOG_OFFSET = 1e-3
"""Added to f cos(theta_i) [1/sr] before the logarithm of the log-relative metric."""


class Pairs(NamedTuple):
    """Directions to compare at."""

    wi: Array
    """(N, 3)"""
    wo: Array
    """(N, 3)"""
    weight: Array
    """(N,) share of each pair; they sum to 1"""


@functools.lru_cache(maxsize=4)
def direction_pairs(polar: int = 40, difference: int = 24, azimuth: int = 64) -> Pairs:
    """Pairs spread over both hemispheres with the measure d wi d wo, dense where highlights are.

    A midpoint rule over (theta_h, theta_d, phi_d), theta_h warped by a square, theta_d up to the horizon, with the
    Jacobian 4 cos(theta_d) sin(theta_h) sin(theta_d); the azimuth of h advances by the golden ratio from pair to pair,
    so that anisotropic reflectances are seen from all sides.
    """
    u, v, w = np.meshgrid(*(((np.arange(n) + 0.5) / n) for n in (polar, difference, azimuth)), indexing="ij")
    theta_h, phi_d = u * u * math.pi / 2, w * 2 * math.pi
    horizon = np.arctan2(np.cos(theta_h), np.sin(theta_h) * np.abs(np.cos(phi_d)))
    theta_d = v * horizon
    weight = 4 * np.cos(theta_d) * np.sin(theta_h) * np.sin(theta_d) * u * horizon
    phi_h = 2 * math.pi * ((math.sqrt(5) - 1) / 2 * np.arange(u.size).reshape(u.shape) % 1)
    wi, wo = from_half_difference(theta_h, phi_h, theta_d, phi_d)
    return Pairs(wi.reshape(-1, 3), wo.reshape(-1, 3), weight.ravel() / weight.sum())


Metric = Callable[[Array, Array, Array], float]


def _rms(difference: Array, weight: Array) -> float:
    return math.sqrt(float(np.mean(np.einsum("n,nc->c", weight, np.square(difference)))))


def cosine_weighted_l2(a: Array, b: Array, weight: Array) -> float:
    """RMS of f_a cos - f_b cos [1/sr]. Reference: Ngan2005."""
    return _rms(a - b, weight)


def logarithmic(a: Array, b: Array, weight: Array) -> float:
    """RMS of ln(1 + f_a cos) - ln(1 + f_b cos). Reference: Low2012."""
    return _rms(np.log1p(a) - np.log1p(b), weight)


def cube_root(a: Array, b: Array, weight: Array) -> float:
    """RMS of (f_a cos)^(1/3) - (f_b cos)^(1/3). Reference: Fores2012."""
    return _rms(np.cbrt(a) - np.cbrt(b), weight)


def log_relative(a: Array, b: Array, weight: Array) -> float:
    """Mean of |ln (f_a cos + e) / (f_b cos + e)|, e = 1e-3: about the mean relative error where f cos >> e."""
    return float(np.mean(np.einsum("n,nc->c", weight, _log_ratio(a, b))))


def _log_ratio(a: Array, b: Array) -> Array:
    return np.asarray(np.abs(np.log((a + LOG_OFFSET) / (b + LOG_OFFSET))))


METRICS: dict[str, Metric] = {
    "cosine-weighted L2": cosine_weighted_l2,
    "log": logarithmic,
    "cube root": cube_root,
    "log relative": log_relative,
}
"""Metrics over pairs of directions by name: of f_a cos, f_b cos (N, 3) and the pairs' weights (N,)."""


def direction_metrics(a: Reflectance, b: Reflectance) -> dict[str, float]:
    """Every metric of `METRICS` between two reflectances, over `direction_pairs`."""
    wi, wo, weight = direction_pairs()
    values = a.f_cos(wi, wo), b.f_cos(wi, wo)
    return {name: metric(*values, weight) for name, metric in METRICS.items()}


def error_map(a: Reflectance, b: Reflectance, size: int = 64, azimuths: int = 16) -> Array:
    """(size, size) mean |ln (f_a cos + e) / (f_b cos + e)| over channels and phi_d: row theta_d, column theta_h.

    theta_d is (row + 0.5) / size and theta_h the square of (column + 0.5) / size quarter turns, as narrow highlights
    need. The `azimuths` values of phi_d are spread evenly over those at which light and viewer are above the horizon,
    and the azimuth of h advances by the golden ratio with them, so that anisotropic reflectances are seen from all
    sides. Raises ParameterError for a size or a number of azimuths below 1.
    """
    if size < 1 or azimuths < 1:
        raise ParameterError(f"an error map needs at least one cell and one azimuth, got {size} and {azimuths}")
    spread, turn = (np.arange(size) + 0.5) / size, (np.arange(azimuths) + 0.5) / azimuths
    theta_d, theta_h, turn = np.meshgrid(spread * math.pi / 2, spread**2 * math.pi / 2, turn, indexing="ij")
    # both are above the horizon where |cos phi_d| tan theta_h tan theta_d < 1, that is in two opposite arcs
    lowest = np.arccos(np.minimum(1, 1 / (np.tan(theta_h) * np.tan(theta_d))))
    arc, within = np.divmod(2 * turn, 1)
    phi_d = arc * math.pi + lowest + within * (math.pi - 2 * lowest)
    phi_h = 2 * math.pi * ((math.sqrt(5) - 1) / 2 * np.arange(azimuths) % 1)
    wi, wo = from_half_difference(theta_h, phi_h, theta_d, phi_d)
    return np.asarray(_log_ratio(a.f_cos(wi, wo), b.f_cos(wi, wo)).mean((-2, -1)))
