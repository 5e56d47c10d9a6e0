"""Blinn's highlight: a power of the cosine between normal and half vector, normalised."""

from __future__ import annotations

from ..formula import Vec, dot, exp, pi
from ..parameters import RGB, Scalar, albedo, number
from .model import Model
from .terms.powers import power_of_one_minus

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
        h = wi + wo
        sin2_h = (h.x * h.x + h.y * h.y) / dot(h, h)
        lobe = power_of_one_minus(sin2_h, 0.5 * self.n)
        norm = (self.n + 2.0) * (self.n + 4.0) / (8.0 * pi * (exp(-0.5 * LOG_2 * self.n) + self.n))
        return self.ks * (norm * lobe)
