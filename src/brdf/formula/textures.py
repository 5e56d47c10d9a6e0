"""Linear texture lookup, written once for every array library.

Texel centres sit at (i + 0.5) / n and the edge texel extends outward (clamp to edge), as on a GPU. The coordinates
index the axes of the array in order; its last axis holds the channels.
"""

from __future__ import annotations

import itertools
from typing import Any

from .vec import Vec


def lookup(data: Any, coordinates: tuple[Any, ...], backend: Any) -> Vec:
    """The linearly filtered channels of `data` (n1, …, nk, C) at k coordinates, as a `Vec` of C.

    The backend gives `floor`, `minimum`, `maximum`, `integer` (to an index type) and `gather(rows, indices)`, which
    returns a list of C arrays for a (rows, C) table.
    """
    *sizes, channels = data.shape
    rows = data.reshape(-1, channels)
    lower, upper, fraction = [], [], []
    for u, size in zip(coordinates, sizes, strict=True):
        position = u * size - 0.5
        # not a number, which lanes below the horizon may hold, counts as the edge: it must not become an index
        position = backend.minimum(backend.where(position > 0.0, position, 0.0 * size), size - 1.0)
        below = backend.minimum(backend.floor(position), max(size - 2.0, 0.0))
        lower.append(backend.integer(below))
        upper.append(backend.integer(backend.minimum(below + 1.0, size - 1.0)))
        fraction.append(position - below)

    total: list[Any] = [0.0] * channels
    for corner in itertools.product((False, True), repeat=len(sizes)):
        index, weight = 0, 1.0
        for axis, is_upper in enumerate(corner):
            index = index * sizes[axis] + (upper if is_upper else lower)[axis]
            weight = weight * (fraction[axis] if is_upper else 1.0 - fraction[axis])
        texels = backend.gather(rows, index)
        total = [sum_ + weight * texel for sum_, texel in zip(total, texels, strict=True)]
    return Vec(*total)
