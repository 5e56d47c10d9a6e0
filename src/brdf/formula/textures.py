"""Texture lookup, written once for every array library.

Texel centres sit at (i + 0.5) / n and the edge texel extends outward (clamp to edge), as on a GPU. The coordinates
index the axes of the array in order; its last axis holds the channels.

Filters: "nearest", "linear", and two cubic ones of four texels an axis, for which the texels beyond an edge mirror
those before it: "catmull-rom", which passes through the texels, and "b-spline", which is smoother and does not, unless
the texels are the coefficients of the spline through what was meant (scipy.ndimage.spline_filter, mode "mirror").
References: Keys1981, Sigg2005.
"""

from __future__ import annotations

import itertools
from typing import Any

from .vec import Vec

FILTERS = ("nearest", "linear", "catmull-rom", "b-spline")

REACH = {"nearest": 1, "linear": 2, "catmull-rom": 4, "b-spline": 4}
"""Texels an axis."""


def weights(filter: str, x: Any) -> list[Any]:
    """The weights of the texels at -1, 0, 1, 2 (0 and 1 for a linear filter, 0 for the nearest) for x in [0, 1]."""
    match filter:
        case "nearest":
            return [1.0]
        case "linear":
            return [1.0 - x, x]
        case "catmull-rom":
            return [
                ((1.0 - 0.5 * x) * x - 0.5) * x,
                (1.5 * x - 2.5) * x * x + 1.0,
                ((2.0 - 1.5 * x) * x + 0.5) * x,
                (0.5 * x - 0.5) * x * x,
            ]
    y = 1.0 - x
    return [
        y * y * y * (1 / 6),
        (0.5 * x - 1.0) * x * x + 2 / 3,
        (0.5 * y - 1.0) * y * y + 2 / 3,
        x * x * x * (1 / 6),
    ]


def lookup(data: Any, coordinates: tuple[Any, ...], backend: Any, filter: str = "linear") -> Vec:
    """The filtered channels of `data` (n1, …, nk, C) at k coordinates, as a `Vec` of C.

    The backend gives `floor`, `minimum`, `maximum`, `integer` (to an index type) and `gather(rows, indices)`, which
    returns a list of C arrays for a (rows, C) table.
    """
    *sizes, channels = data.shape
    rows = data.reshape(-1, channels)
    axes = [_taps(u, size, backend, filter) for u, size in zip(coordinates, sizes, strict=True)]
    total: list[Any] = [0.0] * channels
    for taps in itertools.product(*axes):
        index, weight = 0, 1.0
        for (place, share), size in zip(taps, sizes, strict=True):
            index = index * size + place
            weight = weight * share
        texels = backend.gather(rows, index)
        total = [sum_ + weight * texel for sum_, texel in zip(total, texels, strict=True)]
    return Vec(*total)


def _taps(u: Any, size: int, backend: Any, filter: str) -> list[tuple[Any, Any]]:
    """The texels of one axis: index and weight of each."""
    position = u * size - 0.5
    # not a number, which lanes below the horizon may hold, counts as the edge: it must not become an index
    position = backend.minimum(backend.where(position > 0.0, position, 0.0 * size), size - 1.0)
    if filter == "nearest":
        return [(backend.integer(backend.floor(position + 0.5)), 1.0)]
    below = backend.minimum(backend.floor(position), max(size - 2.0, 0.0))
    offsets = (0.0, 1.0) if filter == "linear" else (-1.0, 0.0, 1.0, 2.0)
    places = []
    for offset in offsets:
        inside = backend.abs(below + offset)
        inside = backend.minimum(inside, 2.0 * (size - 1) - inside) if offset > 0 else inside
        places.append(backend.integer(backend.minimum(backend.maximum(inside, 0.0), size - 1.0)))
    return list(zip(places, weights(filter, position - below), strict=True))
