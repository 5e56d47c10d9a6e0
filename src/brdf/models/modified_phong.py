"""Phong's highlight made physically plausible: reciprocal and energy conserving."""

from __future__ import annotations

from ..formula import Vec, minimum, pi, where
from ..parameters import RGB, Scalar, albedo, number
from .model import Model
from .terms.powers import power_of_one_minus


class ModifiedPhong(Model):
    """Phong's specular lobe about the mirror direction r of wi.

        f(wi, wo) = ks (n + 2) / (2 pi) max(0, r . wo)^n      [1/sr],   r = (-wi.x, -wi.y, wi.z)

    The albedo is `ks` at normal incidence and falls towards grazing angles. References: Phong1975, Lewis1994,
    Lafortune1994.
    """

    ks: RGB = albedo("albedo at normal incidence", default=0.5)
    n: Scalar = number("exponent", default=50.0, low=0.0, high=1e6)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        # 1 - r . wo, from the chord between the two unit vectors: keeps its digits inside a sharp lobe
        x, y, z = wo.x + wi.x, wo.y + wi.y, wo.z - wi.z
        one_minus_cosine = 0.5 * (x * x + y * y + z * z)
        lobe = power_of_one_minus(minimum(one_minus_cosine, 1.0), self.n)
        return self.ks * ((self.n + 2.0) / (2.0 * pi) * where(one_minus_cosine < 1.0, lobe, 0.0 * lobe))
