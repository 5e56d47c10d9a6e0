"""Oren and Nayar's diffuse reflection from rough surfaces, in full: three terms and the light between facets."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from ..formula import Scalar, Vec, abs, atan2, clip, maximum, minimum, pi, sqrt, where
from ..geometry.sampling import CosineSampler, Sampler
from ..parameters import RGB, albedo, number
from .model import Model


class OrenNayarFull(Model):
    """V-shaped grooves of Lambertian facets, their slopes normally distributed; the authors' functional approximation.

        f(wi, wo) = albedo / pi (C1 + cos(dphi) C2 tan(b) + (1 - |cos(dphi)|) C3 tan((a + b) / 2))
                  + 0.17 albedo^2 / pi sigma^2 / (sigma^2 + 0.13) (1 - cos(dphi) (2 b / pi)^2)      [1/sr]
        C1 = 1 - 0.5 sigma^2 / (sigma^2 + 0.33)
        C2 = 0.45 sigma^2 / (sigma^2 + 0.09) (sin(a) - (2 b / pi)^3 where cos(dphi) < 0, else sin(a))
        C3 = 0.125 sigma^2 / (sigma^2 + 0.09) (4 a b / pi^2)^2

    a and b are the larger and the smaller of the two polar angles, dphi the azimuth between the two directions; the
    second line is the light exchanged between facets. For sigma above 0.6 the first line dips below zero where both
    directions graze and face each other; there it counts as 0. Reference: Oren1994, equations 30 and 31.
    """

    breaks: ClassVar[Mapping[str, str]] = {
        "energy": "the fit by its authors gains up to 4 % at grazing angles where the facets are white [Oren1994]"
    }

    albedo: RGB = albedo("reflectance of the facets", default=0.5)
    sigma: Scalar = number("standard deviation of the facet slope angle", default=0.3, low=0.0, high=1.6, unit="rad")

    def f(self, wi: Vec, wo: Vec) -> Vec:
        sin_i, sin_o = sqrt(wi.x * wi.x + wi.y * wi.y), sqrt(wo.x * wo.x + wo.y * wo.y)
        theta_i, theta_o = atan2(sin_i, wi.z), atan2(sin_o, wo.z)
        a, b = maximum(theta_i, theta_o), minimum(theta_i, theta_o)
        cos_dphi = clip((wi.x * wo.x + wi.y * wo.y) / maximum(sin_i * sin_o, 1e-20), -1.0, 1.0)
        # tangents by the cosines, which keep their digits near the horizon
        tan_b = minimum(sin_i, sin_o) / maximum(wi.z, wo.z)
        tan_mean = (sin_i + sin_o) / (wi.z + wo.z)

        sigma2 = self.sigma * self.sigma
        C1 = 1.0 - 0.5 * sigma2 / (sigma2 + 0.33)
        slope = sigma2 / (sigma2 + 0.09)
        b_share = 2.0 * b / pi
        C2 = 0.45 * slope * (maximum(sin_i, sin_o) - where(cos_dphi < 0.0, b_share**3, 0.0 * b))
        C3 = 0.125 * slope * (4.0 * a * b / pi**2) ** 2
        direct = maximum(C1 + cos_dphi * C2 * tan_b + (1.0 - abs(cos_dphi)) * C3 * tan_mean, 0.0)
        exchanged = 0.17 * sigma2 / (sigma2 + 0.13) * (1.0 - cos_dphi * b_share**2)
        return self.albedo * (direct / pi) + self.albedo * self.albedo * (exchanged / pi)

    def _make_sampler(self) -> Sampler:
        return CosineSampler()
