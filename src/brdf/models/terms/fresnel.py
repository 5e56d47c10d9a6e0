"""Fresnel reflectance at a mirror facet: `F(cosine)` with the cosine between direction and facet normal, in [0, 1]."""

from __future__ import annotations

from ...formula import Scalar, Vec, abs, clip, saturate, sqrt, where
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
    """Exact, unpolarised, for a real relative index eta = n_inside / n_outside. Reference: Born1999.

    With g = eta cos_t: r_s = (cosine - g) / (cosine + g), r_p = (eta^2 cosine - g) / (eta^2 cosine + g), each written
    with its numerator multiplied out by the denominator, which keeps the digits of weak reflections.
    """

    eta: Scalar = number("relative refractive index", default=1.5, low=1.0, high=4.0)

    def F(self, cosine: Scalar) -> Vec:
        c = clip(cosine, 1e-9, 1.0)  # the square of c + g stays above zero for eta = 1, too
        eta2 = self.eta * self.eta
        step = (self.eta - 1.0) * (self.eta + 1.0)
        g = sqrt(step + c * c)
        r_s = -step / (c + g) ** 2
        r_p = step * ((eta2 + 1.0) * c * c - 1.0) / (eta2 * c + g) ** 2
        reflectance = 0.5 * (r_s * r_s + r_p * r_p)
        return Vec(reflectance, reflectance, reflectance)


class Conductor(Fresnel):
    """Exact, unpolarised, for a complex index eta + i k. Reference: Born1999, in the real form of Lagarde2013."""

    eta: RGB = rgb("refractive index, real part", default=(0.2, 0.92, 1.1), low=1e-3, high=20.0)
    k: RGB = rgb("extinction coefficient", default=(3.91, 2.45, 2.14), low=0.0, high=20.0)

    def F(self, cosine: Scalar) -> Vec:
        c = saturate(cosine)
        cos2 = c * c
        sin2 = 1.0 - cos2
        eta2, k2 = self.eta * self.eta, self.k * self.k
        t = eta2 - k2 - sin2
        a2_plus_b2 = sqrt(t * t + 4.0 * eta2 * k2)
        # a^2 = (a2_plus_b2 + t) / 2; for negative t the other root of the quadratic avoids the cancellation.
        larger = 0.5 * (a2_plus_b2 + abs(t)) + 1e-30
        a = sqrt(where(t < 0.0, eta2 * k2 / larger, larger))
        r_s = (a2_plus_b2 + cos2 - 2.0 * c * a) / (a2_plus_b2 + cos2 + 2.0 * c * a)
        common = cos2 * a2_plus_b2 + sin2 * sin2
        mixed = 2.0 * c * sin2 * a
        return 0.5 * r_s * (1.0 + (common - mixed) / (common + mixed))
