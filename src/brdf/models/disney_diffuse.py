"""Disney's diffuse term."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from ..formula import Vec, dot, pi
from ..geometry.sampling import CosineSampler, Sampler
from ..parameters import RGB, Scalar, albedo, number
from .model import Model


class DisneyDiffuse(Model):
    """Lambert's law darkened or brightened towards grazing angles, depending on roughness.

        f(wi, wo) = albedo / pi (1 + (F90 - 1)(1 - cos_i)^5) (1 + (F90 - 1)(1 - cos_o)^5)      [1/sr]
        F90 = 0.5 + 2 roughness cos^2 theta_d

    theta_d is the angle between either direction and their half vector. Fitted by eye to measured materials.
    Reference: Burley2012.
    """

    breaks: ClassVar[Mapping[str, str]] = {
        "energy": "rough surfaces gain light at grazing angles: the factor there reaches F90 = 2.5 [Burley2012]"
    }

    albedo: RGB = albedo("base colour", default=0.5)
    roughness: Scalar = number("perceptual roughness", default=0.5, low=0.0, high=1.0)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        cos2_d = 0.5 + 0.5 * dot(wi, wo)
        excess = 2.0 * self.roughness * cos2_d - 0.5
        factor_i, factor_o = 1.0 + excess * (1.0 - wi.z) ** 5, 1.0 + excess * (1.0 - wo.z) ** 5
        return self.albedo * (factor_i * factor_o / pi)

    def _make_sampler(self) -> Sampler:
        return CosineSampler()
