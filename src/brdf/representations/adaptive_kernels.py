# mypy: allow-untyped-defs, allow-untyped-calls
"""Compiled evaluation and sampling of adaptively parameterised measurements [Dupuy2018].

A warp is a density on the unit square given on grid nodes (bilinear between them) for each incident direction
(linear between those), with its cumulative sums. The x axis of a grid (its last) runs over the zenith angle
of the half vector, u = sqrt(2 theta / pi), the y axis over its azimuth, v = phi / 2 pi + 1/2. All tables are
(phi, theta, ny, nx[, channels]).

Everything is compiled once, for float32 and for float64 directions, and kept on disk; loops release the
interpreter lock.
"""

from __future__ import annotations

import math
from typing import Any

import numba
from numba import boolean, float32, float64, int64, types

from ..formula.machine_code import kept_on_disk

_TABLE = types.Array(float32, 4, "C", readonly=True)
_COLOURS = types.Array(float32, 5, "C", readonly=True)
_NODES = types.Array(float64, 1, "C", readonly=True)
_SETTINGS = types.UniTuple(int64, 2)
_MODEL = types.Tuple((_NODES, _NODES, types.UniTuple(_TABLE, 3), types.UniTuple(_TABLE, 3), _TABLE, _TABLE))
_JIT: dict[str, Any] = {"nogil": True, "cache": kept_on_disk(), "error_model": "numpy"}

TINY_AREA = 1e-12
"""Floor of the area d(omega) / d(u, v), which vanishes as u^3 at the pole: 1e-12 is reached at 1e-8 rad from it."""


def _inline(function: Any) -> Any:
    return numba.njit(function, **_JIT)


@_inline
def bracket(nodes, x):
    """Interval of the sorted nodes that holds x, and the position in it, clamped to [0, 1]."""
    if nodes.size == 1:
        return 0, 0.0
    low, high = 0, nodes.size - 1
    while high - low > 1:
        middle = (low + high) // 2
        if nodes[middle] <= x:
            low = middle
        else:
            high = middle
    position = (x - nodes[low]) / (nodes[low + 1] - nodes[low])
    return low, min(max(position, 0.0), 1.0)


@_inline
def blend(table, at, j, i):
    """Node (j, i) of a grid, interpolated between incident directions."""
    p, fp, t, ft = at
    value = float(table[p, t, j, i])
    if ft > 0:
        value += ft * (table[p, t + 1, j, i] - value)
    if fp > 0:
        other = float(table[p + 1, t, j, i])
        if ft > 0:
            other += ft * (table[p + 1, t + 1, j, i] - other)
        value += fp * (other - value)
    return value


@_inline
def patch(x, count):
    """The patch of a grid axis with `count` nodes that holds x in [0, 1], and the position in it."""
    x = x * (count - 1)
    index = min(max(int(x), 0), count - 2)
    return index, x - index


@_inline
def bilinear(table, at, x, y):
    """The value of a grid at (x, y) in the unit square."""
    i, fx = patch(x, table.shape[3])
    j, fy = patch(y, table.shape[2])
    lower = (1 - fx) * blend(table, at, j, i) + fx * blend(table, at, j, i + 1)
    upper = (1 - fx) * blend(table, at, j + 1, i) + fx * blend(table, at, j + 1, i + 1)
    return (1 - fy) * lower + fy * upper


@_inline
def unwarp(warp, at, x, y):
    """(x, y) with the warp's density -> uniform numbers, and the density there: the inverse of `draw`."""
    density, conditional, marginal = warp
    columns, rows = density.shape[3], density.shape[2]
    i, fx = patch(x, columns)
    j, fy = patch(y, rows)
    left = (1 - fy) * blend(density, at, j, i) + fy * blend(density, at, j + 1, i)
    right = (1 - fy) * blend(density, at, j, i + 1) + fy * blend(density, at, j + 1, i + 1)
    before = (1 - fy) * blend(conditional, at, j, i) + fy * blend(conditional, at, j + 1, i)
    row0 = blend(conditional, at, j, columns - 1)
    row1 = blend(conditional, at, j + 1, columns - 1)
    row = (1 - fy) * row0 + fy * row1
    ux = (before + fx * (left + 0.5 * fx * (right - left))) / row if row > 0 else fx
    uy = blend(marginal, at, 0, j) + fy * (row0 + 0.5 * fy * (row1 - row0))
    value = ((1 - fx) * left + fx * right) * (columns - 1) * (rows - 1)
    return min(max(ux, 0.0), 1.0), min(max(uy, 0.0), 1.0), value


@_inline
def solve(start, end, area):
    """t in [0, 1] up to which the density that runs linearly from `start` to `end` encloses `area`."""
    root = math.sqrt(max(start * start + 2 * area * (end - start), 0.0))
    return min(2 * area / (start + root), 1.0) if start + root > 0 else 0.0


@_inline
def draw(warp, at, ux, uy):
    """Uniform numbers -> (x, y) with the warp's density."""
    density, conditional, marginal = warp
    columns, rows = density.shape[3], density.shape[2]
    low, high = 0, rows - 1
    while high - low > 1:
        middle = (low + high) // 2
        if blend(marginal, at, 0, middle) <= uy:
            low = middle
        else:
            high = middle
    j = low
    row0 = blend(conditional, at, j, columns - 1)
    row1 = blend(conditional, at, j + 1, columns - 1)
    fy = solve(row0, row1, max(uy - blend(marginal, at, 0, j), 0.0))

    target = ux * ((1 - fy) * row0 + fy * row1)
    low, high = 0, columns - 1
    while high - low > 1:
        middle = (low + high) // 2
        if (1 - fy) * blend(conditional, at, j, middle) + fy * blend(conditional, at, j + 1, middle) <= target:
            low = middle
        else:
            high = middle
    i = low
    left = (1 - fy) * blend(density, at, j, i) + fy * blend(density, at, j + 1, i)
    right = (1 - fy) * blend(density, at, j, i + 1) + fy * blend(density, at, j + 1, i + 1)
    before = (1 - fy) * blend(conditional, at, j, i) + fy * blend(conditional, at, j + 1, i)
    fx = solve(left, right, max(target - before, 0.0))
    return (i + fx) / (columns - 1), (j + fy) / (rows - 1)


@_inline
def elevation(x, y, z):
    """Zenith angle of a unit vector, exact near the pole, too."""
    return math.atan2(math.sqrt(x * x + y * y), z)


@_inline
def folded(x, y, reduction):
    """Signs that bring an incident direction into the measured range of azimuths: a half or a quarter of the circle."""
    if reduction == 1:
        return 1.0, 1.0
    sy = -1.0 if y > 0 else 1.0
    if reduction == 4:
        return (-1.0 if x > 0 else 1.0), sy
    return sy, sy


@_inline
def half_vector(ix, iy, iz, ox, oy, oz, relative, phi_i):
    """The half vector's place (u, v) on the grids, its zenith angle, and its cosine with the incident direction."""
    mx, my, mz = ix + ox, iy + oy, iz + oz
    length = math.sqrt(mx * mx + my * my + mz * mz)
    mx, my, mz = mx / length, my / length, mz / length
    theta = elevation(mx, my, mz)
    phi = math.atan2(my, mx) - (phi_i if relative else 0.0)
    v = phi / (2 * math.pi) + 0.5
    return math.sqrt(theta * (2 / math.pi)), v - math.floor(v), theta, ix * mx + iy * my + iz * mz


@_inline
def locate(phis, thetas, phi, theta):
    """Where an incident direction lies between the measured ones."""
    p, fp = bracket(phis, phi)
    t, ft = bracket(thetas, theta)
    return p, fp, t, ft


def _evaluate(model, colours, settings, has_jacobian, wi, wo, out):
    """f [1/sr] of every channel at (N, 3) pairs into `out` (N, C), negative values kept; zero below the horizon.

    Equations 14 to 16 of Dupuy2018, divided by the cosine that the measured values contain.
    """
    phis, thetas, vndf, _, ndf, sigma = model
    relative, reduction = settings
    here = (0, 0.0, 0, 0.0)
    for n in range(wi.shape[0]):
        out[n, :] = 0
        iz, oz = float(wi[n, 2]), float(wo[n, 2])
        if not (iz > 0 and oz > 0):
            continue
        sx, sy = folded(wi[n, 0], wi[n, 1], reduction)
        ix, iy, ox, oy = sx * wi[n, 0], sy * wi[n, 1], sx * wo[n, 0], sy * wo[n, 1]
        theta_i, phi_i = elevation(ix, iy, iz), math.atan2(iy, ix)
        u, v, _, _ = half_vector(ix, iy, iz, ox, oy, oz, relative, phi_i)
        at = locate(phis, thetas, phi_i, theta_i)
        x, y, _ = unwarp(vndf, at, u, v)
        scale = 1 / oz
        if has_jacobian:
            u_i, v_i = math.sqrt(theta_i * (2 / math.pi)), phi_i / (2 * math.pi) + 0.5
            scale *= bilinear(ndf, here, u, v) / (4 * bilinear(sigma, here, u_i, v_i))
        i, fx = patch(x, colours.shape[3])
        j, fy = patch(y, colours.shape[2])
        p, fp, t, ft = at
        for dp in range(2 if fp > 0 else 1):
            for dt in range(2 if ft > 0 else 1):
                weight = scale * (fp if dp else 1 - fp) * (ft if dt else 1 - ft)
                grid = colours[p + dp, t + dt]
                for c in range(grid.shape[2]):
                    lower = (1 - fx) * grid[j, i, c] + fx * grid[j, i + 1, c]
                    upper = (1 - fx) * grid[j + 1, i, c] + fx * grid[j + 1, i + 1, c]
                    out[n, c] += weight * ((1 - fy) * lower + fy * upper)


def _density(model, settings, given, drawn, out):
    """Density [1/sr] with which `_draw_directions` gives `drawn` for the incident direction `given`."""
    phis, thetas, vndf, luminance, _, _ = model
    relative, reduction = settings
    for n in range(given.shape[0]):
        out[n] = 0
        iz, oz = float(given[n, 2]), float(drawn[n, 2])
        if not (iz > 0 and oz > 0):
            continue
        sx, sy = folded(given[n, 0], given[n, 1], reduction)
        ix, iy, ox, oy = sx * given[n, 0], sy * given[n, 1], sx * drawn[n, 0], sy * drawn[n, 1]
        theta_i, phi_i = elevation(ix, iy, iz), math.atan2(iy, ix)
        u, v, theta_m, cosine = half_vector(ix, iy, iz, ox, oy, oz, relative, phi_i)
        at = locate(phis, thetas, phi_i, theta_i)
        x, y, density = unwarp(vndf, at, u, v)
        area = max(2 * math.pi**2 * u * math.sin(theta_m), TINY_AREA) * 4 * cosine
        out[n] = (
            density
            * bilinear(luminance[0], at, x, y)
            / area
            * ((luminance[0].shape[2] - 1) * (luminance[0].shape[3] - 1))
        )


def _draw_directions(model, settings, given, uniform, out):
    """Directions for the incident directions `given` (N, 3): luminance warp, half vector warp, mirror reflection."""
    phis, thetas, vndf, luminance, _, _ = model
    relative, reduction = settings
    for n in range(given.shape[0]):
        sx, sy = folded(given[n, 0], given[n, 1], reduction)
        ix, iy, iz = sx * given[n, 0], sy * given[n, 1], float(given[n, 2])
        theta_i, phi_i = elevation(ix, iy, iz), math.atan2(iy, ix)
        at = locate(phis, thetas, phi_i, theta_i)
        x, y = draw(luminance, at, uniform[n, 0], uniform[n, 1])
        u, v = draw(vndf, at, x, y)
        theta = u * u * (math.pi / 2)
        phi = (2 * v - 1) * math.pi + (phi_i if relative else 0.0)
        mx, my, mz = math.cos(phi) * math.sin(theta), math.sin(phi) * math.sin(theta), math.cos(theta)
        twice = 2 * (ix * mx + iy * my + iz * mz)
        out[n, 0] = sx * (twice * mx - ix)
        out[n, 1] = sy * (twice * my - iy)
        out[n, 2] = twice * mz - iz


def _rows(real: Any, axes: int, readonly: bool) -> Any:
    return types.Array(real, axes, "C", readonly=readonly)


def _signatures(layout: Any) -> list[Any]:
    return [types.void(*layout(real)) for real in (float32, float64)]


evaluate = numba.njit(
    _signatures(
        lambda r: (
            _MODEL, _COLOURS, _SETTINGS, boolean, _rows(r, 2, True), _rows(r, 2, True), _rows(r, 2, False)
        )
    ),
    **_JIT,
)(_evaluate)  # fmt: skip
density = numba.njit(
    _signatures(lambda r: (_MODEL, _SETTINGS, _rows(r, 2, True), _rows(r, 2, True), _rows(r, 1, False))), **_JIT
)(_density)
draw_directions = numba.njit(
    _signatures(lambda r: (_MODEL, _SETTINGS, _rows(r, 2, True), _rows(r, 2, True), _rows(r, 2, False))), **_JIT
)(_draw_directions)
