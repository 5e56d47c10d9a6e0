"""Phong's highlight made physically plausible: reciprocal and energy conserving."""

from __future__ import annotations

from ..formula import Vec, pi
from ..parameters import RGB, Scalar, albedo, number
from .model import Model
from .terms.cosine_lobes import mirror_lobe


class ModifiedPhong(Model):
    """Phong's specular lobe about the mirror direction r of wi.

        f(wi, wo) = ks (n + 2) / (2 pi) max(0, r . wo)^n      [1/sr],   r = (-wi.x, -wi.y, wi.z)

    The albedo is `ks` at normal incidence and falls towards grazing angles. References: Phong1975, Lewis1994,
    Lafortune1994.
    """

    ks: RGB = albedo("albedo at normal incidence", default=0.5)
    n: Scalar = number("exponent", default=50.0, low=0.0, high=1e6)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        return self.ks * ((self.n + 2.0) / (2.0 * pi) * mirror_lobe(wi, wo, self.n))
