"""Oren and Nayar's diffuse reflection from rough surfaces, in their simplified form."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from ..formula import Vec, maximum, pi
from ..geometry.sampling import CosineSampler, Sampler
from ..parameters import RGB, Scalar, albedo, choice, number
from .model import Model

_OFFSET_OF_A = {"ignored": 0.33, "included": 0.57}


class OrenNayar(Model):
    """V-shaped grooves of Lambertian facets, their slopes normally distributed; the authors' simplified form.

        f(wi, wo) = albedo / pi (A + B max(0, cos dphi) sin(theta_max) tan(theta_min))      [1/sr]
        A = 1 - 0.5 sigma^2 / (sigma^2 + 0.33),   B = 0.45 sigma^2 / (sigma^2 + 0.09)

    theta_max and theta_min are the larger and the smaller of the two polar angles, dphi the azimuth between the two
    directions. Real-Time Rendering (AkenineMoller2008, eq. 7.57) prints the two angles the other way round, which
    grows without bound at grazing angles; the original has them as here. With `interreflection="included"` 0.57 takes
    the place of 0.33, which stands in for the light exchanged between facets. Reference: Oren1994.
    """

    breaks: ClassVar[Mapping[str, str]] = {
        "energy": "the fit by its authors gains up to 4 % at grazing angles where the facets are white [Oren1994]"
    }

    albedo: RGB = albedo("reflectance of the facets", default=0.5)
    sigma: Scalar = number("standard deviation of the facet slope angle", default=0.3, low=0.0, high=1.6, unit="rad")
    interreflection: str = choice("light exchanged between facets", "ignored", _OFFSET_OF_A)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        sigma2 = self.sigma * self.sigma
        offset = _OFFSET_OF_A[self.interreflection]
        A = 1.0 - 0.5 * sigma2 / (sigma2 + offset)
        B = 0.45 * sigma2 / (sigma2 + 0.09)
        # sin sin cos(dphi) is the dot product in the tangent plane; the smaller angle has the larger cosine.
        projected = wi.x * wo.x + wi.y * wo.y
        return self.albedo * ((A + B * maximum(projected, 0.0) / maximum(wi.z, wo.z)) / pi)

    def _make_sampler(self) -> Sampler:
        return CosineSampler()
