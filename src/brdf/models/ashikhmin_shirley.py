"""Ashikhmin and Shirley's anisotropic Phong model."""

from __future__ import annotations

from typing import Any

from ..formula import Vec, dot, maximum, pi, sqrt
from ..parameters import RGB, Scalar, albedo, choice, number
from .model import Model
from .terms.fresnel import TERMS as FRESNEL_TERMS
from .terms.powers import power_of_one_minus


class AshikhminShirley(Model):
    """An anisotropic Phong lobe over half vectors with Fresnel reflectance, and a diffuse part that makes room for it.

        f(wi, wo) = sqrt((nx + 1)(ny + 1)) / (8 pi) cos^e(theta_h) / ((h . wi) max(cos_i, cos_o)) F(h . wi)
                    + 28 kd / (23 pi) (1 - F(1)) (1 - (1 - cos_i / 2)^5)(1 - (1 - cos_o / 2)^5)      [1/sr]
        e = nx cos^2 phi_h + ny sin^2 phi_h

    The paper's Rs is `F0` of Schlick's Fresnel term. Reference: Ashikhmin2000a.
    """

    kd: RGB = albedo("reflectance of the diffuse part", default=0.0)
    n: Scalar = number("exponent", default=100.0, low=0.0, high=1e6)
    n_x: Scalar = number("exponent along the tangent", low=0.0, high=1e6, follows="n")
    n_y: Scalar = number("exponent along the bitangent", low=0.0, high=1e6, follows="n")
    fresnel: Any = choice("Fresnel reflectance", "schlick", FRESNEL_TERMS)

    @property
    def isotropic(self) -> bool:
        return bool(self.n_x == self.n_y)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        h = wi + wo
        h2 = dot(h, h)
        cos_d = 0.5 * sqrt(h2)
        tangential2 = h.x * h.x + h.y * h.y
        exponent = (self.n_x * h.x * h.x + self.n_y * h.y * h.y) / maximum(tangential2, 1e-30)
        lobe = power_of_one_minus(tangential2 / h2, 0.5 * exponent)
        norm = sqrt((self.n_x + 1.0) * (self.n_y + 1.0)) / (8.0 * pi)
        specular = self.fresnel.F(cos_d) * (norm * lobe / (cos_d * maximum(wi.z, wo.z)))
        room = (1.0 - (1.0 - 0.5 * wi.z) ** 5) * (1.0 - (1.0 - 0.5 * wo.z) ** 5)
        return specular + self.kd * (1.0 - self.fresnel.F(1.0)) * (28.0 / (23.0 * pi) * room)
