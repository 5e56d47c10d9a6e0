"""The formula of pictures of spheres: where a pair of directions is in them, and what two of them say there."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ...formula import Scalar, Vec, atan2, cos, cross, dot, length, maximum, sin, sqrt, where
from ..storage import storage
from .blends import blend_rule, neighbours, trend
from .separated import View, combined

Fetch = Callable[[Scalar, Scalar, Scalar], Vec]
"""(number of the picture, u, v) -> texel."""

SAME_DIRECTION = 1e-6
"""Sine of the angle between light and viewer below which they count as one direction."""


def seen_from_viewer(wi: Vec, wo: Vec) -> tuple[Scalar, Scalar, Scalar, Scalar]:
    """The normal (n_x, n_y, n_z) in the frame with the viewer at +z and the light in the plane y = 0, and the angle phi
    between them."""
    across = cross(wi - wo, wo)  # wi x wo; the difference keeps its digits when the two are close
    sine = length(across)
    apart = sine > SAME_DIRECTION
    scale = 1.0 / maximum(sine, SAME_DIRECTION)
    n_x = where(apart, (wo.x * across.y - wo.y * across.x) * scale, sqrt(maximum(1.0 - wo.z * wo.z, 0.0)))
    n_y = where(apart, -across.z * scale, 0.0)
    return n_x, n_y, wo.z, atan2(sine, dot(wi, wo))


def blended(images: Any, n_x: Scalar, n_y: Scalar, n_z: Scalar, phi: Scalar, fetch: Fetch) -> Vec:
    """pi f cos(theta_i) from the two pictures next to `phi`; `images` are `SphereImages` as their formula has them."""
    options = images.options
    a = atan2(n_x, n_z)
    rho = sqrt(n_x * n_x + n_z * n_z)
    first, second, number, t = neighbours(phi, images.nodes)
    k = blend_rule(images.blend)(a, phi, images.nodes[-1])
    a_1 = a + k * (first - phi)
    a_2 = a + k * (second - phi)
    u_1, u_2 = (0.5 + 0.5 * options["shorten"] * rho * sin(azimuth) for azimuth in (a_1, a_2))
    v = 0.5 - 0.5 * options["shorten"] * n_y
    store = storage(images.storage)
    value_1 = store.value(fetch(number, u_1, v), images)
    value_2 = store.value(fetch(number + 1.0, u_2, v), images)
    if images.blend == "separated":
        view = View(a, rho, phi)
        return combined((value_1, value_2), (a_1, a_2), (first, second), t, view, images.floor, images.F0)
    if options["guard"]:
        t = where(cos(a_1) < 0.0, 1.0, where(cos(a_2) < 0.0, 0.0, t))
    radiance: Vec = value_1 * (1.0 - t) + value_2 * t
    if options["trend"] and images.blend == "monotone":
        radiance = radiance * trend(value_1, value_2, phi, images.nodes)
    return radiance
