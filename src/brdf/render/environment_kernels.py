"""The compiled loops of environment.py: sampling by brightness, and bilinear lookup."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..geometry.search import first_above
from .compiled import kernel

ONE = np.float32(1)
HALF = np.float32(0.5)
TWO_PI = np.float32(2 * math.pi)
PI = np.float32(math.pi)


@kernel("void(i8, i8, f4[:,::1], f4[:,:,::1], f4[:,::1], f4, f4, f4[:,::1], f4[::1])")
def look_up(
    start: int, stop: int, directions: Any, pixels: Any, cell_density: Any, cos: Any, sin: Any, radiance: Any,
    density: Any,
) -> None:  # fmt: skip
    """Bilinear radiance and the cell's density for world directions."""
    height, width = cell_density.shape
    for n in range(start, stop):
        x, y, z = directions[n, 0], directions[n, 1], directions[n, 2]
        turned_x, turned_z = cos * x - sin * z, sin * x + cos * z
        u = (math.atan2(turned_x, -turned_z) / TWO_PI + HALF) * np.float32(width)
        v = math.acos(min(max(y, -ONE), ONE)) / PI * np.float32(height)
        density[n] = cell_density[min(int(v), height - 1), min(int(u), width - 1)]
        u, v = u - HALF, v - HALF
        left, top = int(np.floor(u)), int(np.floor(v))
        a, b = u - np.float32(left), v - np.float32(top)
        i0, i1 = max(top, 0), min(top + 1, height - 1)
        j0, j1 = left % width, (left + 1) % width
        for c in range(3):
            upper = (ONE - a) * pixels[i0, j0, c] + a * pixels[i0, j1, c]
            lower = (ONE - a) * pixels[i1, j0, c] + a * pixels[i1, j1, c]
            radiance[n, c] = (ONE - b) * upper + b * lower


@kernel("void(i8, i8, f4[:,::1], f4[::1], f4[:,::1], f4, f4, f4[:,::1])")
def sample(start: int, stop: int, u: Any, rows: Any, columns: Any, cos: Any, sin: Any, directions: Any) -> None:
    """World directions distributed as the cells' brightness; within a cell evenly over solid angle."""
    height, width = columns.shape
    for n in range(start, stop):
        i = first_above(rows, u[n, 0], 0, height - 1)
        below = rows[i - 1] if i > 0 else np.float32(0)
        along_row = (u[n, 0] - below) / max(rows[i] - below, np.float32(1e-20))
        j = first_above(columns[i], u[n, 1], 0, width - 1)
        before = columns[i, j - 1] if j > 0 else np.float32(0)
        along_column = (u[n, 1] - before) / max(columns[i, j] - before, np.float32(1e-20))
        upper = math.cos(np.float32(i) * PI / np.float32(height))
        lower = math.cos(np.float32(i + 1) * PI / np.float32(height))
        y = upper + min(max(along_row, np.float32(0)), ONE) * (lower - upper)
        phi = ((np.float32(j) + min(max(along_column, np.float32(0)), ONE)) / np.float32(width) - HALF) * TWO_PI
        r = math.sqrt(max(ONE - y * y, np.float32(0)))
        x, z = r * math.sin(phi), -r * math.cos(phi)
        directions[n, 0] = cos * x + sin * z
        directions[n, 1] = y
        directions[n, 2] = cos * z - sin * x
