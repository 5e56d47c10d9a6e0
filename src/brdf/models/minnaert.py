"""Minnaert's law: darkening or brightening of the limb by a power of the cosines."""

from __future__ import annotations

from typing import ClassVar

from ..formula import Vec, exp, log, pi
from ..parameters import RGB, Scalar, albedo, number
from .model import Model


class Minnaert(Model):
    """Lambert's law with an exponent on both cosines, made for the moon.

        f(wi, wo) = albedo / pi (cos_i cos_o)^(k - 1)      [1/sr]

    k = 1 is Lambert's law. With k = 1/2 a sphere lit from the viewer's place is evenly bright. The albedo is
    2 albedo / (k + 1) cos_o^(k - 1). Reference: Minnaert1941.
    """

    breaks: ClassVar = {"energy": "for k < 1 the albedo grows without bound at grazing angles [Minnaert1941]"}

    albedo: RGB = albedo("albedo for k = 1", default=0.5)
    k: Scalar = number("exponent of limb darkening", default=0.5, low=0.0, high=4.0)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        return self.albedo * (exp((self.k - 1.0) * (log(wi.z) + log(wo.z))) / pi)
