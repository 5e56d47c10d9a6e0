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


def refine(problem: Problem, equations: Equations, numbers: Array, robust: str) -> Array:
    """The numbers at the robust minimum near `numbers`; all free ones are searched for."""
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

    typical = SCALE * float(np.median(np.abs(residuals(begin))))
    found: Any = least_squares(
        residuals, begin, jac=jacobian, bounds=(low, high), loss=robust, f_scale=max(typical, 1e-12), x_scale="jac"
    )
    return at(found.x)
