"""Fresnel reflectance at a mirror facet: `F(cosine)` with the cosine between direction and facet normal, in [0, 1]."""

from __future__ import annotations

from ...formula import Scalar, Vec, saturate, sqrt
from ...parameters import RGB, Parameterised, number, rgb


class Fresnel(Parameterised):
    """Base of the Fresnel terms."""

    def F(self, cosine: Scalar) -> Vec:
        raise NotImplementedError


class Schlick(Fresnel):
    """F = F0 + (1 - F0) (1 - cosine)^5. Reference: Schlick1994."""

    F0: RGB = rgb("reflectance at normal incidence", default=0.04, low=0.0, high=1.0)

    def F(self, cosine: Scalar) -> Vec:
        return self.F0 + (1.0 - self.F0) * (1.0 - saturate(cosine)) ** 5


class Dielectric(Fresnel):
    """Exact, unpolarised, for a real relative index eta = n_inside / n_outside. Reference: Born1999."""

    eta: Scalar = number("relative refractive index", default=1.5, low=1.0, high=4.0)

    def F(self, cosine: Scalar) -> Vec:
        cos_t = sqrt(1.0 - (1.0 - cosine * cosine) / (self.eta * self.eta))
        r_s = (cosine - self.eta * cos_t) / (cosine + self.eta * cos_t)
        r_p = (self.eta * cosine - cos_t) / (self.eta * cosine + cos_t)
        reflectance = 0.5 * (r_s * r_s + r_p * r_p)
        return Vec(reflectance, reflectance, reflectance)


class Conductor(Fresnel):
    """Exact, unpolarised, for a complex index eta + i k. Reference: Born1999, in the real form of Lagarde2013."""

    eta: RGB = rgb("refractive index, real part", default=(0.2, 0.92, 1.1), low=0.0, high=20.0)
    k: RGB = rgb("extinction coefficient", default=(3.91, 2.45, 2.14), low=0.0, high=20.0)

    def F(self, cosine: Scalar) -> Vec:
        cos2 = cosine * cosine
        sin2 = 1.0 - cos2
        t = self.eta * self.eta - self.k * self.k - sin2
        a2_plus_b2 = sqrt(t * t + 4.0 * (self.eta * self.eta) * (self.k * self.k))
        a2 = 0.5 * (a2_plus_b2 + t)
        a = Vec(*(sqrt(_positive(c)) for c in a2))
        r_s = (a2_plus_b2 + cos2 - 2.0 * cosine * a) / (a2_plus_b2 + cos2 + 2.0 * cosine * a)
        common = cos2 * a2_plus_b2 + sin2 * sin2
        mixed = 2.0 * cosine * sin2 * a
        return 0.5 * r_s * (1.0 + (common - mixed) / (common + mixed))


def _positive(x: Scalar) -> Scalar:
    from ...formula import maximum

    return maximum(x, 0.0)
