"""Normal distribution functions: how much microsurface faces which way.

`D(h)` [1/sr] integrates, times h.z, to 1 over the hemisphere; `Lambda(w)` is Smith's auxiliary function of a direction.
"""

from __future__ import annotations

from ...formula import Scalar, Vec, exp, pi, sqrt, where
from ...geometry.sampling import GGXSampler, Sampler
from ...parameters import Parameterised, width


class Distribution(Parameterised):
    """Base of the distributions: widths along tangent and bitangent, equal unless both are given."""

    alpha: Scalar = width("width of the distribution", default=0.2)
    alpha_x: Scalar = width("width along the tangent", follows="alpha")
    alpha_y: Scalar = width("width along the bitangent", follows="alpha")

    @property
    def isotropic(self) -> bool:
        return bool(self.alpha_x == self.alpha_y)

    def D(self, h: Vec) -> Scalar:
        raise NotImplementedError

    def Lambda(self, w: Vec) -> Scalar:
        raise NotImplementedError

    def sampler(self) -> Sampler | None:
        """A sampler of its own, if it has one."""
        return None


class GGX(Distribution):
    """Trowbridge-Reitz. References: Trowbridge1975, Walter2007, Heitz2014."""

    def D(self, h: Vec) -> Scalar:
        stretched = (h.x / self.alpha_x) ** 2 + (h.y / self.alpha_y) ** 2 + h.z**2
        return 1.0 / (pi * self.alpha_x * self.alpha_y * stretched**2)

    def Lambda(self, w: Vec) -> Scalar:
        a2 = ((w.x * self.alpha_x) ** 2 + (w.y * self.alpha_y) ** 2) / w.z**2
        return 0.5 * (sqrt(1.0 + a2) - 1.0)

    def sampler(self) -> Sampler:
        return GGXSampler(self.alpha_x, self.alpha_y)


class Beckmann(Distribution):
    """Gaussian slopes; Lambda in the rational form of Walter2007 (relative error below 0.35 %)."""

    def D(self, h: Vec) -> Scalar:
        slope2 = ((h.x / self.alpha_x) ** 2 + (h.y / self.alpha_y) ** 2) / h.z**2
        return exp(-slope2) / (pi * self.alpha_x * self.alpha_y * h.z**4)

    def Lambda(self, w: Vec) -> Scalar:
        projected = sqrt((w.x * self.alpha_x) ** 2 + (w.y * self.alpha_y) ** 2)
        a = w.z / (projected + 1e-12)
        rational = (1.0 - 1.259 * a + 0.396 * a * a) / (3.535 * a + 2.181 * a * a)
        return where(a < 1.6, rational, 0.0 * a)
