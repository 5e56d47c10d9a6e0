"""How well the data determine what was fitted: standard errors, correlations, warnings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..reflectance import Reflectance
from .equations import Equations
from .losses import Loss
from .parameters import Component
from .robust import influence
from .samples import Samples

Array = NDArray[np.float64]

CORRELATED = 0.98
"""Correlations beyond this are warned of."""

VAGUE = 0.5
"""So are standard errors above this share of the value."""

BLIND = 1e-9
"""Curvature along a direction, of unit diagonal, below which the data say nothing about it."""

SILENT = 1e-14
"""Squared relative effect of a number on the data, in parts of the largest, below which it has none."""


@dataclass(frozen=True, eq=False)
class Certainty:
    """Standard errors and correlations of all numbers; NaN for what was held, or lies at a bound."""

    errors: Array
    """(P,) infinite for what the data do not determine"""
    correlation: Array
    """(P, P)"""
    warnings: tuple[str, ...]


def sandwich(
    m: Reflectance, samples: Samples, loss: Loss, numbers: Array, robust: str | None, scale: float
) -> tuple[Array, Array]:
    """(P, P) the curvature of what was made small at its minimum, and the products of the samples' own slopes there.

    For a robust loss both are weighted by how it pulls (Huber1964), `scale` being where it begins to. The channels of
    a sample count as three measurements, unless they are copies of one. In double precision: they are inverted.
    """
    cosine = samples.wi[:, 2:]
    residual = loss.scale(np.asarray(m(samples.wi, samples.wo)) * cosine) - loss.scale(samples.values * cosine)
    weighted = np.sqrt(samples.weight, dtype=np.float64) * residual

    def equations(factor: Array | float) -> Equations:
        return Equations(m, samples.reweighted(samples.weight * factor), loss, "float64")

    pull, slope = (1.0, 1.0) if robust is None else influence(robust, residual, scale)
    curvature = equations(np.maximum(slope, 0))(numbers).hessian
    if np.min(slope) < 0:
        curvature = curvature - equations(np.maximum(-slope, 0))(numbers).hessian
    if samples.is_monochrome:
        return curvature, equations(pull).scores(numbers)
    return curvature, equations(np.square(weighted * pull))(numbers).hessian


def certainty(
    components: list[Component], numbers: Array, free: NDArray[np.bool_], hessian: Array, meat: Array, residuals: int
) -> Certainty:
    """From the curvature and the products of slopes, see `sandwich`; `residuals`: how many there are, 0 for too
    few to determine anything.

    The sandwich H^-1 M H^-1 n / (n - p): it stays right where errors are not equally large everywhere, as those of
    measurements are not. References: White1980.
    """
    low, high = (np.array([getattr(c, side) for c in components]) for side in ("low", "high"))
    least = np.maximum(low, [c.lowest for c in components])
    near = np.isclose(numbers, least, 1e-9, 0) | np.isclose(numbers, high, 1e-9, 0)
    at_bound = free & (near | (numbers < least) | (numbers > high))
    effect = np.diag(hessian) * np.maximum(np.abs(numbers), 1e-3) ** 2
    known = np.flatnonzero(free & ~at_bound & (effect > SILENT * effect.max()))
    errors = np.full(len(numbers), np.nan)
    correlation = np.full((len(numbers), len(numbers)), np.nan)
    errors[free & ~at_bound] = np.inf
    warnings = [f"{components[k].name} lies at its bound {numbers[k]:g}" for k in np.flatnonzero(at_bound)]
    if residuals and len(known) and np.isfinite(hessian).all() and np.isfinite(meat).all():
        scale = 1 / np.sqrt(np.diag(hessian)[known])
        H = hessian[np.ix_(known, known)] * np.outer(scale, scale)
        values, vectors = np.linalg.eigh(H)
        seen = values > BLIND
        inverse = (vectors[:, seen] / values[seen]) @ vectors[:, seen].T
        M = meat[np.ix_(known, known)] * np.outer(scale, scale)
        covariance = inverse @ M @ inverse * (residuals / max(residuals - len(known), 1))
        deviation = np.sqrt(np.maximum(np.diag(covariance), 0))
        blind = (vectors[:, ~seen] ** 2).sum(1) > 0.01
        errors[known] = np.where(blind, np.inf, deviation * scale)
        product = np.outer(deviation, deviation)
        none = np.zeros_like(product)
        correlation[np.ix_(known, known)] = np.divide(covariance, product, out=none, where=product > 1e-300)
    unseen = np.isinf(errors) & ~np.isin(np.arange(len(numbers)), known)
    warnings += [f"{components[k].name} is not determined by the data" for k in np.flatnonzero(unseen)]
    if len(known):
        common = np.where(hessian != 0, correlation, 0)[np.ix_(known, known)]
        warnings += _warnings([components[k] for k in known], numbers[known], errors[known], common)
    return Certainty(errors, correlation, tuple(warnings))


def _warnings(some: list[Component], numbers: Array, errors: Array, correlation: Array) -> list[str]:
    """`correlation`: 0 where two numbers act on no common channel: those of copied channels err alike, no more."""
    found = []
    for c, value, error in zip(some, numbers, errors, strict=True):
        if np.isinf(error):
            found.append(f"{c.name} is not determined by the data")
        elif error > VAGUE * max(abs(value), 1e-12):
            found.append(f"{c.name} is hardly determined: {value:.3g} ± {error:.2g}")
    for a in range(len(some)):
        for b in range(a):
            r = correlation[a, b]
            if abs(r) > CORRELATED and np.isfinite(errors[[a, b]]).all():
                found.append(f"{some[b].name} and {some[a].name} are exchangeable (correlation {r:+.3f})")
    return found
