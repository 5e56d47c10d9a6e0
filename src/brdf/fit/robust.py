"""Losses that count outliers less, minimised by SciPy from where the least squares ended."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import UnknownNameError
from .equations import Equations
from .levenberg import Problem, coordinates

Array = NDArray[np.float64]

ROBUST = ("soft_l1", "huber", "cauchy")
"""Names as SciPy has them."""

SCALE = 2.0
"""Residuals beyond this many times the median one count less."""

MOST = 20_000
"""Samples: SciPy keeps the whole Jacobian."""


def require_known(name: str) -> None:
    """Raises UnknownNameError."""
    if name not in ROBUST:
        raise UnknownNameError("robust loss", name, ROBUST)


def refine(problem: Problem, equations: Equations, weight: Array, numbers: Array, robust: str) -> tuple[Array, float]:
    """The numbers near `numbers` where the sum of weight rho(r) is least, and from which r on one counts less.

    `equations`: of samples without weights, for what counts as an outlier does not depend on them; `weight` (N, 3).
    All free numbers are searched for.
    """
    from scipy.optimize import least_squares

    free = np.flatnonzero(problem.free)
    low, high = (np.array([problem.components[k].bounds[side] for k in free]) for side in (0, 1))
    begin = np.clip(coordinates(problem, numbers)[free], low, high)
    margin = 1e-9 * np.maximum(1, np.abs(begin))
    begin = np.clip(begin, low + margin, high - margin)

    def at(q: Array) -> Array:
        full = numbers.copy()
        full[free] = [problem.components[k].to_value(x) for k, x in zip(free, q, strict=True)]
        return full

    def residuals(q: Array) -> Array:
        return np.concatenate([rows[-1] for rows in equations.rows_at(at(q))])

    def jacobian(q: Array) -> Array:
        full = at(q)
        slope = np.array([v if c.is_log else 1.0 for c, v in zip(problem.components, full, strict=True)])
        blocks = []
        for channel, rows in enumerate(equations.rows_at(full)):
            block = np.zeros((rows.shape[1], len(full)))
            block[:, list(equations.active(channel))] = rows[:-1].T
            blocks.append(block * slope)
        return np.concatenate(blocks)[:, free]

    weights = weight.T.ravel()
    scale = max(SCALE * _median(np.abs(residuals(begin)), weights), 1e-12)
    found: Any = least_squares(
        residuals, begin, jac=jacobian, bounds=(low, high), loss=lambda z: weights * rho(robust, z), f_scale=scale,
        x_scale="jac",
    )  # fmt: skip
    return at(found.x), scale


def _median(values: Array, weights: Array) -> float:
    order = np.argsort(values)
    total = np.cumsum(weights[order])
    return float(values[order[np.searchsorted(total, total[-1] / 2)]])


def rho(robust: str, z: Array) -> Array:
    """A loss over z = (r / scale)^2, its derivative and its second derivative, (3, N)."""
    if robust == "soft_l1":
        return np.array([2 * (np.sqrt(1 + z) - 1), (1 + z) ** -0.5, -0.5 * (1 + z) ** -1.5])
    if robust == "cauchy":
        return np.array([np.log1p(z), 1 / (1 + z), -((1 + z) ** -2.0)])
    root = np.sqrt(np.maximum(z, 1))
    return np.where(z <= 1, [z, np.ones_like(z), np.zeros_like(z)], [2 * root - 1, 1 / root, -0.5 / root**3])


def influence(robust: str, residuals: Array, scale: float) -> tuple[Array, Array]:
    """By how much a loss rho(r^2) pulls at a residual r, in parts of r, and the slope of that pull.

    rho' and rho' + 2 r^2 rho'' at r / scale; both are 1 for least squares.
    """
    z = np.square(residuals / scale)
    _, first, second = rho(robust, z)
    return first, first + 2 * z * second
