"""Phong's shading as he wrote it, read as a BRDF."""

from __future__ import annotations

from typing import ClassVar

from ..formula import Vec
from ..parameters import RGB, Scalar, albedo, number
from .model import Model
from .terms.cosine_lobes import mirror_lobe


class Phong(Model):
    """Phong's shading in radiometric notation: what is left when L_o / L_i is divided by the cosine it lacks.

        L_o = L_i (kd cos_i + ks max(0, r . wo)^n)
        f(wi, wo) = kd + ks max(0, r . wo)^n / cos_i      [1/sr],   r = (-wi.x, -wi.y, wi.z)

    kd and ks are not albedos: the albedo is near pi kd + 2 pi ks / (n + 1). `ModifiedPhong` is the lobe that physics
    allows. Reference: Phong1975.
    """

    breaks: ClassVar = {
        "reciprocity": "only the cosine of the light's angle divides the highlight [Lewis1994]",
        "energy": "kd and ks are brightnesses without a normalisation [Lewis1994]",
    }

    kd: RGB = albedo("diffuse brightness: reflected radiance over irradiance", default=0.5)
    ks: RGB = albedo("brightness of the highlight", default=0.5)
    n: Scalar = number("exponent", default=50.0, low=0.0, high=1e6)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        return self.kd + self.ks * (mirror_lobe(wi, wo, self.n) / wi.z)
