"""The compiled loop of mesh.py: smooth normals."""

from __future__ import annotations

import math
from typing import Any

from .compiled import kernel


@kernel("void(f8[:,::1], i8[::1], i8[::1], f8, f8[:,::1])")
def averaged(face: Any, order: Any, starts: Any, least_cosine: Any, normals: Any) -> None:
    """For each corner the unit sum of the `face` vectors (F, 3) around its position that point much the same way.

    `order`: corners (3 face + number) sorted by position; position p has those from `starts[p]` to `starts[p + 1]`.
    """
    for p in range(len(starts) - 1):
        for i in range(starts[p], starts[p + 1]):
            a = face[order[i] // 3]
            length = math.sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])
            x = y = z = 0.0
            for j in range(starts[p], starts[p + 1]):
                b = face[order[j] // 3]
                dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
                if dot >= least_cosine * length * math.sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]):
                    x, y, z = x + b[0], y + b[1], z + b[2]
            norm = math.sqrt(x * x + y * y + z * z)
            normals[order[i], 0], normals[order[i], 1], normals[order[i], 2] = x / norm, y / norm, z / norm
