"""What reliefs are made of: noise of a given spectrum, cells, strokes. All continue themselves on all sides.

Lengths are in widths of the tile, so that a pattern is the same at every resolution that can show it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .kernels import compiled

Floats = NDArray[np.floating[Any]]
Random = np.random.Generator


def places(n: int) -> tuple[Floats, Floats]:
    """x and y (up) of the texels' centres, each (n, n), in [0, 1)."""
    axis = (np.arange(n) + 0.5) / n
    return np.broadcast_to(axis, (n, n)), np.broadcast_to(axis[::-1, None], (n, n))


def noise(
    n: int, rng: Random, low: float, high: float, slope: float = 1.0, stretch: tuple[float, float] = (1.0, 1.0)
) -> Floats:
    """(n, n) Gaussian noise of mean 0 and variance 1 with waves of `low` to `high` to the tile.

    Amplitudes fall with frequency^-slope; `stretch` makes features longer along x or y.
    """
    from scipy.fft import ifft2

    reach = math.ceil(high)
    k = np.arange(-reach, reach + 1)
    f_y, f_x = np.meshgrid(k * stretch[1], k * stretch[0], indexing="ij")
    f = np.hypot(f_x, f_y)
    inside = (f >= low) & (f <= high)
    amplitude = np.where(inside, np.maximum(f, 1e-9) ** -slope, 0)
    wave = amplitude * np.exp(2j * np.pi * rng.random(f.shape))
    wave /= math.sqrt(float((amplitude**2).sum()) / 2)
    spectrum = np.zeros((n, n), np.complex64)
    shown = np.abs(k) < n / 2
    spectrum[np.ix_(k[shown] % n, k[shown] % n)] = wave[np.ix_(shown, shown)]
    return np.asarray(ifft2(spectrum, workers=2).real * n * n, np.float32)


def smoothstep(low: float, high: float, x: Floats) -> Floats:
    """0 below `low`, 1 above `high`, a cubic in between."""
    t = np.clip((x - low) / (high - low), 0, 1)
    return np.asarray(t * t * (3 - 2 * t))


@dataclass(frozen=True)
class Cells:
    """Around each place the two nearest of scattered points."""

    nearest: Floats
    """(n, n) distance to the nearest point, in mean distances of points"""
    second: Floats
    """(n, n) distance to the next one"""
    owner: NDArray[np.int32]
    """(n, n) number of the nearest point"""


def cells(x: Floats, y: Floats, rng: Random, across: int, jitter: float = 0.8) -> Cells:
    """Cells around `across`² points, moved from a regular grid by `jitter` of its spacing, at places (n, n)."""
    offset = 0.5 + jitter * (rng.random((across, across, 2)) - 0.5)
    shape = x.shape
    nearest, second, owner = np.empty(x.size), np.empty(x.size), np.empty(x.size, np.int32)
    _cells(x.ravel() * across, y.ravel() * across, offset, nearest, second, owner)
    return Cells(nearest.reshape(shape), second.reshape(shape), owner.reshape(shape))


@compiled
def _cells(x: Any, y: Any, offset: Any, nearest: Any, second: Any, owner: Any) -> None:
    across = offset.shape[0]
    for i in range(len(x)):
        column, row = math.floor(x[i]), math.floor(y[i])
        first, after, who = 1e9, 1e9, 0
        for r in range(row - 2, row + 3):
            for c in range(column - 2, column + 3):
                point = offset[r % across, c % across]
                d = (c + point[0] - x[i]) ** 2 + (r + point[1] - y[i]) ** 2
                if d < first:
                    first, after, who = d, first, (r % across) * across + c % across
                elif d < after:
                    after = d
        nearest[i], second[i], owner[i] = math.sqrt(first), math.sqrt(after), who


@dataclass(frozen=True)
class Strokes:
    """What shows of strokes laid over each other."""

    height: Floats
    """(n, n)"""
    owner: NDArray[np.int32]
    """(n, n) number of the stroke that shows; -1 for none"""
    along: Floats
    """(n, n) place on it along its length, -1 to 1"""
    across: Floats
    """(n, n) place across its width, -1 to 1"""

    def of_owner(self, values: NDArray[Any], nothing: float = 0.0) -> NDArray[Any]:
        """(n, n, ...) one value for each stroke, where it shows."""
        shown = np.asarray(values)[np.maximum(self.owner, 0)]
        shown[self.owner < 0] = nothing
        return shown


def strokes(
    n: int, x: Floats, y: Floats, angle: ArrayLike, length: ArrayLike, width: ArrayLike, thickness: ArrayLike,
    base: ArrayLike = 0.0, arch: ArrayLike = 0.0, tilt: ArrayLike = 0.0, ground: float = -1.0, flat: bool = False,
) -> Strokes:  # fmt: skip
    """Straight strokes with their middles at (x, y), seen from above.

    At a along and c across (both -1 to 1) a stroke has the height base + thickness sqrt(1 - c²) + arch (1 - a²) +
    tilt a, with `flat` without the rounding. `angle` [rad] from +x. Where there is none, the height is `ground`.
    """
    made = np.stack(np.broadcast_arrays(x, y, angle, length, width, thickness, base, arch, tilt), -1).astype(np.float64)
    made = np.ascontiguousarray(made.reshape(-1, 9))
    height, owner = np.full((n, n), ground), np.full((n, n), -1, np.int32)
    along, across = np.zeros((n, n), np.float32), np.zeros((n, n), np.float32)
    _strokes(made, flat, height, owner, along, across)
    return Strokes(height, owner, along, across)


@compiled
def _strokes(made: Any, flat: bool, height: Any, owner: Any, along: Any, across: Any) -> None:
    n = height.shape[0]
    for k in range(len(made)):
        x, y, angle, length, width, thickness, base, arch, tilt = made[k]
        cosine, sine = math.cos(angle), math.sin(angle)
        reach_x = abs(cosine) * length / 2 + abs(sine) * width / 2
        reach_y = abs(sine) * length / 2 + abs(cosine) * width / 2
        for row in range(math.floor((1 - y - reach_y) * n - 0.5), math.ceil((1 - y + reach_y) * n)):
            for column in range(math.floor((x - reach_x) * n - 0.5), math.ceil((x + reach_x) * n)):
                d_x, d_y = (column + 0.5) / n - x, 1 - (row + 0.5) / n - y
                a = (d_x * cosine + d_y * sine) / (length / 2)
                c = (d_y * cosine - d_x * sine) / (width / 2)
                if abs(a) > 1 or abs(c) > 1:
                    continue
                level = base + arch * (1 - a * a) + tilt * a
                level += thickness if flat else thickness * math.sqrt(1 - c * c)
                r, q = row % n, column % n
                if level > height[r, q]:
                    height[r, q], owner[r, q], along[r, q], across[r, q] = level, k, a, c
