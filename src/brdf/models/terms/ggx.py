"""The GGX lobe with every number an argument: for models that have several of them."""

from __future__ import annotations

from ...formula import Scalar, Vec, dot, pi, sqrt


def ggx_lobe(wi: Vec, wo: Vec, alpha_x: Scalar, alpha_y: Scalar) -> Scalar:
    """D G / (4 cos_i cos_o) [1/sr], heights correlated. References: Walter2007, Heitz2014."""
    h = wi + wo
    stretched = (h.x / alpha_x) ** 2 + (h.y / alpha_y) ** 2 + h.z * h.z
    ratio = dot(h, h) / stretched
    D = ratio * ratio / (pi * alpha_x * alpha_y)
    root_i, root_o = (sqrt((w.x * alpha_x) ** 2 + (w.y * alpha_y) ** 2 + w.z * w.z) for w in (wi, wo))
    return 0.5 * D / (wo.z * root_i + wi.z * root_o)
