"""Smith's masking of any distribution: the integral that has no closed form, done once and looked up ever after.

A direction w = (S, 0, C) sees the facets of slope t at azimuth phi with the cosine C - S t cos(phi), per facet's own
cosine. Those that face it show it the projected area A(w); those that face away would count negatively and make up
the difference A(w) - C. With P(t) = D(t) cos^4, the density of slopes,

    A(w) - C = integral P(t) k(t) t dt from C/S on,   k(t) = 2 (t S sin p - C p),   cos p = C / (t S).

This is the generator of Ashikhmin2000 (there g(w), to a factor) and Smith's C Lambda (Heitz2014). (A - C) / S is a
function of C / S alone, looked up over u = S^(1/4) / (S^(1/4) + C^(1/4)): the fourth roots give widths from 1e-4 to 1
and long tails their share of one axis.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....formula import Scalar, Vec, dot, maximum, sqrt, texture1d
from ....geometry.quadrature import gauss_legendre
from .distribution import Distribution

Floats = NDArray[np.floating[Any]]

NODES = 1024
"""Directions from the normal to the horizon."""

SLOPES = 192
"""Nodes of the integral over slopes."""


def node_coordinate(t: Scalar, nodes: int) -> Scalar:
    """Texture coordinate of the place t in [0, 1] of an axis whose first and last node are its ends."""
    return t * ((nodes - 1) / nodes) + 0.5 / nodes


def facets_away(slope_density: Callable[[Floats], Floats], typical_slope: float) -> NDArray[np.float32]:
    """(A - C) / S over u as a texture (1024, 1). `slope_density` is P, over slopes [1] of any shape."""
    u = np.linspace(0, 1, NODES)[1:, None]
    C = ((1 - u) / u) ** 4  # with S = 1
    # from the least slope that faces away, in steps of its own size, to infinity; the power is for long tails
    x, weight = gauss_legendre(SLOPES)
    step = typical_slope + C
    t = C + step * ((1 - x) ** -4 - 1)
    ratio = np.minimum(C / t, 1)
    k = 2 * (t * np.sqrt((1 - ratio) * (1 + ratio)) - C * np.arccos(ratio))
    area = np.sum(slope_density(t) * k * t * weight * 4 * step / (1 - x) ** 5, axis=1)
    return np.concatenate([[0], area]).astype(np.float32)[:, None]


class Integrated(Distribution):
    """A distribution whose projected area comes from its density by integration.

    It gives D and `slope_width`; the table depends on the values, and a derivative takes it for constant.
    """

    def derived_textures(self) -> dict[str, NDArray[np.float32]]:
        def slope_density(t: Floats) -> Floats:
            cosine = 1 / np.sqrt(1 + t * t)
            density: Floats = self.D(Vec(t * cosine, 0.0 * t, cosine)) * cosine**4
            return density

        with np.errstate(under="ignore"):
            return {"facets_away": facets_away(slope_density, float(self.slope_width()))}

    def projected_area(self, w: Vec) -> Scalar:
        return area_from(self.facets_away, w.x * w.x + w.y * w.y, w.z)


def area_from(facets_away: Any, S2: Scalar, C: Scalar) -> Scalar:
    """A from the table, S squared and C."""
    S = sqrt(S2 + 1e-24)
    root_S, root_C = sqrt(sqrt(S)), sqrt(sqrt(maximum(C, 0.0)))
    return C + S * texture1d(facets_away, node_coordinate(root_S / (root_S + root_C), NODES))[0]


def tan2(h: Vec) -> Scalar:
    """Squared slope of the facet with normal h, kept finite at the horizon."""
    return (h.x * h.x + h.y * h.y) / (dot(h, h) * 1e-18 + h.z * h.z)
