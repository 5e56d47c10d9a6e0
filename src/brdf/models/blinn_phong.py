"""Blinn's highlight: a power of the cosine between normal and half vector, normalised and as shading had it."""

from __future__ import annotations

from typing import ClassVar

from ..formula import Vec, exp, pi
from ..parameters import RGB, Scalar, albedo, number
from .model import Model
from .terms.cosine_lobes import half_lobe

LOG_2 = 0.6931471805599453


class BlinnPhong(Model):
    """Blinn's specular lobe, normalised so that the albedo at normal incidence is exactly `ks`.

        f(wi, wo) = ks (n + 2)(n + 4) / (8 pi (2^(-n/2) + n)) cos^n(theta_h)      [1/sr]

    The familiar (n + 8) / (8 pi) approximates this factor, which is the closed form of the integral over the
    hemisphere with the viewer at the normal. References: Blinn1977, Giesen2009.
    """

    ks: RGB = albedo("albedo at normal incidence", default=0.5)
    n: Scalar = number("exponent", default=50.0, low=0.0, high=1e6)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        norm = (self.n + 2.0) * (self.n + 4.0) / (8.0 * pi * (exp(-0.5 * LOG_2 * self.n) + self.n))
        return self.ks * (norm * half_lobe(wi, wo, self.n))


class BlinnPhongOriginal(Model):
    """Shading with Blinn's highlight, read as a BRDF: `Phong` with the half vector in place of the mirror direction.

        f(wi, wo) = kd + ks cos^n(theta_h) / cos_i      [1/sr]

    kd and ks are brightnesses, not albedos. References: Phong1975, Blinn1977.
    """

    breaks: ClassVar = {
        "reciprocity": "only the cosine of the light's angle divides the highlight [Lewis1994]",
        "energy": "kd and ks are brightnesses without a normalisation [Lewis1994]",
    }

    kd: RGB = albedo("diffuse brightness: reflected radiance over irradiance", default=0.5)
    ks: RGB = albedo("brightness of the highlight", default=0.5)
    n: Scalar = number("exponent", default=50.0, low=0.0, high=1e6)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        return self.kd + self.ks * (half_lobe(wi, wo, self.n) / wi.z)
