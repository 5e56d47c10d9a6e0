"""Small quadratic problems with bounds, as the colours of a fit pose them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SINGULAR = 1e-12
"""Curvature below this share of the largest counts as none: nothing is moved along it."""


def minimise_quadratic(hessian: Array, gradient: Array, low: Array, high: Array) -> Array:
    """The step s, low <= s <= high, with the least s^T H s / 2 + g^T s; H symmetric, positive semidefinite.

    An active-set method: from the best feasible point so far towards the free minimum, stopping at the first bound;
    bounds are let go one at a time where the slope points inwards. Exact to rounding; a few steps for a few unknowns.
    """
    diagonal = np.diag(hessian)
    told = diagonal > max(SINGULAR**3 * diagonal.max(initial=0), 1e-300)  # of the others there is rounding alone
    scale = 1 / np.sqrt(np.where(told, diagonal, 1.0))
    H, g = hessian * np.outer(scale * told, scale * told), gradient * scale * told
    given, (low, high) = (low, high), (low / scale, high / scale)
    s = np.clip(np.zeros(len(g)), low, high)
    free = (low < s) & (s < high)
    for _ in range(10 * len(g) + 10):
        slope = H @ s + g
        target = s.copy()
        target[free] += _solve(H[np.ix_(free, free)], -slope[free])
        step = target - s
        reach = np.full(len(g), np.inf)
        towards = free & (step != 0)
        limit = np.where(step > 0, high, low)
        with np.errstate(over="ignore"):  # a step so short that it never gets there
            reach[towards] = (limit[towards] - s[towards]) / step[towards]
        share = min(1.0, float(reach.min(initial=np.inf)))
        s = np.clip(s + share * step, low, high)
        if share < 1:
            free[int(np.argmin(reach))] = False
            continue
        slope = H @ s + g
        inward = np.where(s <= low, -slope, np.where(s >= high, slope, 0.0))
        inward[free | (low == high)] = 0
        worst = int(np.argmax(inward))
        if inward[worst] <= 1e-12 * (1 + float(np.abs(g).max())):
            break
        free[worst] = True
    return np.clip(s * scale, *given)


def _solve(H: Array, g: Array) -> Array:
    """H^-1 g, without what has no curvature."""
    if not len(g):
        return g
    values, vectors = np.linalg.eigh(H)
    kept = values > SINGULAR * max(values[-1], 1e-300)
    return np.asarray(vectors[:, kept] @ ((vectors[:, kept].T @ g) / values[kept]))
