"""The distributions whose masking is known in closed form."""

from __future__ import annotations

from ....formula import Scalar, Vec, exp, maximum, pi, sqrt, where
from ....geometry.sampling import GGXSampler, Sampler
from .distribution import Stretched


class GGX(Stretched, name="ggx"):
    """Trowbridge-Reitz. References: Trowbridge1975, Walter2007, Heitz2014."""

    def D(self, h: Vec) -> Scalar:
        stretched = (h.x / self.alpha_x) ** 2 + (h.y / self.alpha_y) ** 2 + h.z**2
        return 1.0 / (pi * self.alpha_x * self.alpha_y * stretched**2)

    def projected_area(self, w: Vec) -> Scalar:
        return 0.5 * (w.z + sqrt(self.stretched2(w) + w.z**2))

    def sampler(self) -> Sampler:
        return GGXSampler(self.alpha_x, self.alpha_y)


class Beckmann(Stretched, name="beckmann"):
    """Gaussian slopes; Lambda in the rational form of Walter2007 (relative error of G1 below 0.35 %).

    Reference: Beckmann1963.
    """

    def D(self, h: Vec) -> Scalar:
        cos2 = maximum(h.z * h.z, 1e-18)
        slope2 = ((h.x / self.alpha_x) ** 2 + (h.y / self.alpha_y) ** 2) / cos2
        return exp(-slope2) / (pi * self.alpha_x * self.alpha_y * cos2 * cos2)

    def projected_area(self, w: Vec) -> Scalar:
        spread = sqrt(self.stretched2(w)) + 1e-12
        a = w.z / spread
        # w.z Lambda(a), Lambda = (1 - 1.259 a + 0.396 a^2) / (3.535 a + 2.181 a^2) for a < 1.6, else 0
        masked = spread * (1.0 - 1.259 * a + 0.396 * a * a) / (3.535 + 2.181 * a)
        return w.z + where(a < 1.6, masked, 0.0 * a)
