"""Diffuse light from under a smooth surface: what the surface reflects is not there to be scattered below it."""

from __future__ import annotations

from ..formula import Scalar, Vec, pi
from ..geometry.sampling import CosineSampler, Sampler
from ..parameters import RGB, albedo, rgb
from .model import Model


class CoupledDiffuse(Model):
    """Matte component of a polished surface, coupled to Schlick's Fresnel term.

        f(wi, wo) = albedo 21 (1 - F0) / (20 pi) (1 - (1 - cos_i)^5) (1 - (1 - cos_o)^5)      [1/sr]

    Reciprocal, and with `albedo` = 1 its directional albedo is exactly 1 - F(cos_o): together with a mirror of
    reflectance F = F0 + (1 - F0)(1 - cos)^5 it returns all the light. Reference: Shirley1997.
    """

    albedo: RGB = albedo("share of the light that enters the surface and comes out again", default=0.5)
    F0: RGB = rgb("reflectance of the surface at normal incidence", default=0.04, low=0.0, high=1.0)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        return self.albedo * (1.0 - self.F0) * (21.0 / (20.0 * pi) * _entering(wi.z) * _entering(wo.z))

    def _make_sampler(self) -> Sampler:
        return CosineSampler()


def _entering(c: Scalar) -> Scalar:
    """1 - (1 - c)^5, multiplied out: keeps its digits near the horizon."""
    return c * (5.0 - c * (10.0 - c * (10.0 - c * (5.0 - c))))
