"""Lambert's law: a surface equally bright from everywhere."""

from __future__ import annotations

from ..formula import Vec, pi
from ..geometry.sampling import CosineSampler, Sampler
from ..parameters import RGB, albedo
from .model import Model


class Lambertian(Model):
    """Perfectly diffuse reflection.

        f(wi, wo) = albedo / pi      [1/sr]

    Reference: Lambert1760.
    """

    lossless = {"albedo": 1.0}  # noqa: RUF012

    albedo: RGB = albedo("directional-hemispherical reflectance", default=0.5)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        return self.albedo * (1 / pi)

    def _make_sampler(self) -> Sampler:
        return CosineSampler()
