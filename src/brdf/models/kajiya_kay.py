"""Kajiya and Kay's fur, laid flat on a surface."""

from __future__ import annotations

from typing import ClassVar

from ..formula import Vec, maximum, sqrt
from ..parameters import RGB, Scalar, albedo, number
from .model import Model
from .terms.cosine_lobes import positive_power_of_one_minus


class KajiyaKay(Model):
    """Thin fibres along the tangent x: light leaves on cones about the fibre.

        L_o = L_i (kd sin_i + ks max(0, sin_i sin_o - x_i x_o)^n),   x = cosine to the fibre, sin = sqrt(1 - x^2)
        f(wi, wo) = (kd sin_i + ks max(0, sin_i sin_o - x_i x_o)^n) / cos_i      [1/sr]

    The highlight is cos^n of the sum of both inclinations and peaks on the cone that mirrors the light. The paper
    states brightness, not a BRDF; divided by the surface's cosine it is one. Reference: Kajiya1989.
    """

    breaks: ClassVar = {
        "reciprocity": "diffuse part and cosine know the light's direction alone [Marschner2003]",
        "energy": "kd and ks are brightnesses without a normalisation [Marschner2003]",
    }

    kd: RGB = albedo("diffuse brightness", default=0.3)
    ks: RGB = albedo("brightness of the highlight", default=0.5)
    n: Scalar = number("exponent", default=50.0, low=0.0, high=1e6)

    @property
    def isotropic(self) -> bool:
        return False

    def f(self, wi: Vec, wo: Vec) -> Vec:
        sin_i = sqrt(wi.y * wi.y + wi.z * wi.z)
        sin_o = sqrt(wo.y * wo.y + wo.z * wo.z)
        # 1 - (sin_i sin_o - x_i x_o) = ((sin_i - sin_o)^2 + (x_i + x_o)^2) / 2
        apart = 0.5 * ((sin_i - sin_o) ** 2 + (wi.x + wo.x) ** 2)
        highlight = positive_power_of_one_minus(maximum(apart, 0.0), self.n)
        return (self.kd * sin_i + self.ks * highlight) / wi.z
