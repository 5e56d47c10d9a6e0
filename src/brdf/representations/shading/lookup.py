"""How a shading map finds the picture to show: the formula, and the techniques it is compared with.

A technique chooses a level of the stack; the picture of that level is shown, scaled so that its average is r. So the
sample as a whole always reflects as the BRDF says, and techniques differ in the structure they show. Functions take the
map as its formula sees itself (`bound`). Reference: Kautz2004, figure 6.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...color import LUMINANCE
from ...errors import ParameterError
from ...formula import Scalar, Vec, acos, clip, dot, maximum, minimum
from ...formula.bound import UV, Bound, bound_value
from ...threads import in_ranges

Floats = NDArray[np.floating[Any]]
Technique = Callable[[Any, Scalar, Scalar], Scalar]

PLACES_AT_ONCE = 16384


def shading(bound: Any, r: Scalar, cosine: Scalar) -> Scalar:
    """S(r): the level is r."""
    return r


def lit_texture(bound: Any, r: Scalar, cosine: Scalar) -> Scalar:
    """The brightest picture as a texture that is lit."""
    return bound.stack.ends(bound)[1] + 0.0 * r


def radiance(bound: Any, r: Scalar, cosine: Scalar) -> Scalar:
    """S(L_o), looked up outside the integral: it depends on how strong the light is."""
    return r * bound.intensity


def angular(bound: Any, r: Scalar, cosine: Scalar) -> Scalar:
    """The picture photographed at the light's angle: the average between the two nearest, linear in the angle."""
    angle = acos(minimum(cosine, 1.0)) * (180 / math.pi)
    total = bound.node_1 + 0.0 * angle
    for k in range(1, len(bound.elevations)):
        first, second = (getattr(bound, f"angle_{index}") for index in (k, k + 1))
        rise = getattr(bound, f"node_{k + 1}") - getattr(bound, f"node_{k}")
        total = total + rise * clip((first - angle) * (1.0 / (first - second)), 0.0, 1.0)
    return total


TECHNIQUES: dict[str, Technique] = {
    "shading": shading, "lit-texture": lit_texture, "radiance": radiance, "angular": angular,
}  # fmt: skip


def luminous(rgb: Vec) -> Scalar:
    """The luminance where it is above 0."""
    return maximum(dot(Vec(*map(float, LUMINANCE)), rgb), 0.0)


def looked_up(bound: Any, reflected: Scalar, cosine: Scalar, technique: Technique) -> Vec:
    """S(r) / cosine for r = reflected · cosine, without a quotient of zeros at grazing light."""
    r = technique(bound, reflected * cosine, cosine)
    stack = bound.stack
    lowest, highest = stack.ends(bound)
    level = clip(r, lowest, highest)
    over = level if bound.above == "scale" else maximum(r, lowest)
    value: Vec = stack.value(bound, stack.place(*bound.uv, bound.tiles), level) * (reflected / over)
    return value


def looked_up_arrays(m: Any, reflected: Floats, cosine: Floats, uv: Floats, technique: Technique) -> Floats:
    """`looked_up` of the map `m` on arrays (N,), (N,) and places (N, 2) -> (N, 3) in the places' dtype."""
    out = np.empty((len(uv), 3), uv.dtype)
    values, textures = m.values, m.textures

    def fill(start: int, stop: int) -> None:
        place = Vec(*uv[start:stop].T)

        def named(name: str) -> Any:
            if name == UV:
                return place
            return bound_value(values[name], uv.dtype.type) if name in values else textures[name]

        found = looked_up(Bound(m, named), reflected[start:stop], cosine[start:stop], technique)
        for channel, component in enumerate(found):
            out[start:stop, channel] = component

    in_ranges(fill, len(uv), PLACES_AT_ONCE)
    return out


def pictures_at(m: Any, r: ArrayLike, uv: ArrayLike) -> NDArray[np.float64]:
    """S(r) of the map `m`: r (...), `uv` (..., 2) -> (..., 3). Raises ParameterError."""
    r, uv = np.asarray(r, np.float64), np.asarray(uv, np.float64)
    if uv.shape[-1:] != (2,) or not (r >= 0).all():
        raise ParameterError(f"r must be at least 0 and uv (..., 2), got {uv.shape}")
    try:
        shape = np.broadcast_shapes(r.shape, uv.shape[:-1])
    except ValueError:
        raise ParameterError(f"r {r.shape} and uv {uv.shape} do not broadcast") from None
    r, uv = np.broadcast_to(r, shape).ravel(), np.broadcast_to(uv, (*shape, 2)).reshape(-1, 2)
    found = looked_up_arrays(m, r, np.ones_like(r), uv, shading)
    return found.reshape(*shape, 3).astype(np.float64, copy=False)
