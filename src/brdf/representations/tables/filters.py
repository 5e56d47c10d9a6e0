"""How a table is read between its nodes.

    nearest                one node
    linear                 2 nodes an axis: creases along the nodes
    catmull-rom            4 nodes an axis, through the nodes, smooth; may overshoot beside a lobe it does not resolve
    b-spline               4 nodes an axis, smoother still, never beyond the nodes; blurs, for it misses them
    prefiltered-b-spline   the same through the nodes: the grid holds the spline's coefficients, which may be negative
                           where the values are not

Beyond an end of an axis the cubic ones see the nodes before it mirrored. References: Keys1981, Sigg2005.
"""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import UnknownNameError
from ...formula import Scalar, Vec, abs, floor, minimum, texture3d
from ...formula.textures import weights

Array = NDArray[np.floating[Any]]

PREFILTERED = "prefiltered-b-spline"

FILTERS = {"nearest": "nearest", "linear": "linear", "catmull-rom": "catmull-rom", "b-spline": "b-spline",
           PREFILTERED: "b-spline"}  # fmt: skip
"""Every filter by name, and the texture filter that reads the grid."""


def texture_filter(name: str) -> str:
    """The texture filter of a table's filter. Raises UnknownNameError."""
    if name not in FILTERS:
        raise UnknownNameError("table filter", name, FILTERS)
    return FILTERS[name]


def prefiltered(values: Array) -> Array:
    """Coefficients of the cubic B-spline through (n1, n2, n3, C) values at the nodes, mirrored at the ends."""
    from scipy.ndimage import spline_filter1d

    for axis in range(values.ndim - 1):
        values = spline_filter1d(values, 3, axis, output=np.float64, mode="mirror")
    return values


def b_spline_by_linear_lookups(grid: Any, positions: list[Scalar], shape: tuple[int, ...]) -> Vec:
    """The formula: the cubic B-spline over a texture of three axes by eight trilinear lookups instead of 64 texels.

    For graphics hardware, whose linear lookups cost what a texel does; equal to `texture3d(…, filter="b-spline")`.
    `positions` count nodes, from 0 to n - 1. Two neighbours with weights a, b >= 0 are (a + b) times one linear lookup
    between them; reflecting its place at an end reflects the nodes. Reference: Sigg2005.
    """
    axes = []
    for position, n in zip(positions, shape, strict=True):
        below = minimum(floor(position), n - 2.0)
        a, b, c, d = weights("b-spline", position - below)
        first, second = below - 1.0 + b / (a + b), below + 1.0 + d / (c + d)
        places = abs(first), minimum(second, 2.0 * (n - 1) - second)
        axes.append([(share, (place + 0.5) * (1 / n)) for share, place in zip((a + b, c + d), places, strict=True)])
    total: Any = 0.0
    for (a, u), (b, v), (c, w) in itertools.product(*axes):
        total = texture3d(grid, u, v, w) * (a * b * c) + total
    value: Vec = total
    return value
