"""The parameters of a table's Bezier warps, chosen for one reflectance.

    total-intensity   Mallett's metric: the largest mean of the stored texels, by brute force
    measured          the least measured error at importance pairs, by a simplex search; light and viewer by themselves

The first is quick to state and a poor guide: it opens gaps of the grid where the table is dark, at first-order cost.
Reference: Mallett2016.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError, UnknownNameError
from ...geometry.warps import Bezier, Warp
from ...metrics.importance import Errors, ErrorsAgainst, importance_pairs
from ...reflectance import Reflectance
from ..tables.layout import Layout
from .bake import HORIZON_MARGIN, bake_points

Array = NDArray[np.floating[Any]]

Alpha = str | Sequence[float]

STEPS = 11
"""Values of each alpha that the total intensity is computed for, ends included."""

MOST_NODES = 1 << 16
"""Tables with more nodes have their alphas chosen at fewer: they depend little on it."""

PAIRS = 8192

METRICS: dict[str, Callable[[Errors], float]] = {
    "relative": lambda e: e.relative_rms,
    "display": lambda e: e.display_rms,
    "both": lambda e: math.sqrt(e.relative_rms * e.display_rms),
}
"""What `measured_alphas` minimises, by name: one error, or the geometric mean of both."""


def with_alpha(m: Reflectance, layout: Layout, alpha: Alpha) -> Layout:
    """`layout` with other alphas on its Bezier axes.

    `alpha` is "total-intensity", "measured", or numbers in [0, 1]: one an axis, or (alpha_theta, alpha_phi) for the
    normal basis. Raises UnknownNameError, ParameterError.
    """
    if isinstance(alpha, str):
        if alpha not in SEARCHES:
            raise UnknownNameError("choice of alpha", alpha, SEARCHES)
        alphas = SEARCHES[alpha](m, layout)
    else:
        alphas = tuple(map(float, alpha))
    return _replaced(layout, alphas)


def total_intensity_alphas(m: Reflectance, layout: Layout) -> tuple[float, ...]:
    """The alphas of the largest mean texel, among `STEPS` values each; polar axes that mirror each other share one."""
    layout = _coarse(layout, MOST_NODES // 8)
    axes, shared = _required_axes(layout), _are_twins(layout)
    grid = np.linspace(0, 1, STEPS)
    free = itertools.product(grid.tolist(), repeat=len(axes) - shared)
    tried: list[tuple[float, ...]] = [(a[0], *a) if shared else a for a in free]
    return max(tried, key=lambda alphas: total_intensity(m, _replaced(layout, alphas)))


def total_intensity(m: Reflectance, layout: Layout) -> float:
    """The mean of f [1/sr] over the nodes and channels: the total intensity over the number of texels."""
    basis = layout.basis
    total = 0.0
    for _, angles in layout.slabs():
        wi, wo = basis.directions(*basis.above_horizon(*angles, margin=HORIZON_MARGIN))
        total += float(np.sum(m(wi.astype(np.float32), wo.astype(np.float32)), dtype=np.float64))
    return total / (3 * math.prod(layout.shape))


def measured_alphas(
    m: Reflectance, layout: Layout, metric: str = "both", against: ErrorsAgainst | None = None
) -> tuple[float, ...]:
    """The alphas of the least measured error, one an axis: the best of a coarse grid, then Nelder and Mead's simplex.

    `metric` is a key of `METRICS`; `against` holds the pairs, by default 8192 of seed 0. Raises UnknownNameError.
    """
    from scipy.optimize import minimize

    if metric not in METRICS:
        raise UnknownNameError("metric", metric, METRICS)
    against = against or ErrorsAgainst(m, importance_pairs(PAIRS))
    layout = _coarse(layout, MOST_NODES)
    axes, shared = _required_axes(layout), _are_twins(layout)

    def error(alphas: Sequence[float]) -> float:
        return math.log(max(METRICS[metric](against(bake_points(m, _replaced(layout, alphas)))), 1e-12))

    values: list[tuple[float, ...]] = [(0.3, 0.5, 0.7, 0.9)] * len(axes)
    values[-1] = (0.05, 0.15, 0.4, 0.7)
    starts = [(a[0], *a) if shared else a for a in itertools.product(*values[shared:])]
    start = np.array(min(starts, key=error))
    simplex = np.vstack([start, *(start + np.where(start > 0.5, -0.15, 0.15) * row for row in np.eye(len(start)))])
    options = {"initial_simplex": simplex, "xatol": 0.01, "fatol": 0.005, "maxfev": 80}
    found = minimize(error, start, method="Nelder-Mead", bounds=[(0, 1)] * len(start), options=options)
    return tuple(map(float, np.clip(found.x, 0, 1)))


SEARCHES: dict[str, Callable[[Reflectance, Layout], tuple[float, ...]]] = {
    "total-intensity": total_intensity_alphas,
    "measured": measured_alphas,
}
"""Every way to choose alpha by name."""


def _replaced(layout: Layout, alphas: Sequence[float]) -> Layout:
    axes = _required_axes(layout)
    if len(alphas) == 2 and _are_twins(layout):
        alphas = (alphas[0], *alphas)
    if len(alphas) != len(axes):
        raise ParameterError(f"this layout has {len(axes)} Bezier axes, got {len(alphas)} values of alpha")
    warps: list[Warp] = list(layout.warps)
    for axis, alpha in zip(axes, alphas, strict=True):
        warps[axis] = Bezier(warps[axis].extent, alpha)
    return replace(layout, warps=tuple(warps))


def _required_axes(layout: Layout) -> list[int]:
    axes = _bezier_axes(layout)
    if not axes:
        raise ParameterError("alpha belongs to the 'bezier' warp, which this layout has on no axis")
    return axes


def _bezier_axes(layout: Layout) -> list[int]:
    return [k for k, warp in enumerate(layout.warps) if isinstance(warp, Bezier)]


def _are_twins(layout: Layout) -> bool:
    """Whether the first two of three Bezier axes are the polar angles of light and viewer."""
    return layout.basis.axes[:2] == ("theta_i", "theta_o") and len(_bezier_axes(layout)) == 3


def _coarse(layout: Layout, nodes: int) -> Layout:
    scale = min(1.0, (nodes / math.prod(layout.shape)) ** (1 / len(layout.shape)))
    return replace(layout, shape=tuple(max(2, round(n * scale)) for n in layout.shape))
