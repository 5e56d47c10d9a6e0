"""Fresnel reflectance at a mirror facet: `F(cosine)` with the cosine between direction and facet normal, in [0, 1]."""

from __future__ import annotations

from typing import Any

from ...formula import Scalar, Vec, abs, clip, maximum, minimum, saturate, sqrt, texture1d, where
from ...parameters import RGB, Parameterised, number, rgb, texture


class Fresnel(Parameterised):
    """Base of the Fresnel terms."""

    def F(self, cosine: Scalar) -> Vec:
        raise NotImplementedError


class Schlick(Fresnel):
    """F = F0 + (1 - F0) (1 - cosine)^5. Reference: Schlick1994."""

    F0: RGB = rgb("reflectance at normal incidence", default=0.04, low=0.0, high=1.0)

    def F(self, cosine: Scalar) -> Vec:
        return self.F0 + (1.0 - self.F0) * (1.0 - saturate(cosine)) ** 5


class SchlickF90(Fresnel):
    """F = F0 + (F90 - F0) (1 - cosine)^5: Schlick's curve with a grazing reflectance of its own.

    Reference: Schlick1994.
    """

    F0: RGB = rgb("reflectance at normal incidence", default=0.04, low=0.0, high=1.0)
    F90: RGB = rgb("reflectance at grazing incidence", default=1.0, low=0.0, high=1.0)

    def F(self, cosine: Scalar) -> Vec:
        return self.F0 + (self.F90 - self.F0) * (1.0 - saturate(cosine)) ** 5


def dielectric(cosine: Any, eta: Any) -> Any:
    """Exact reflectance of unpolarised light that meets a real relative index eta = n_beyond / n_here.

    With g = eta cos_t: r_s = (cosine - g) / (cosine + g), r_p = (eta^2 cosine - g) / (eta^2 cosine + g), each written
    with its numerator multiplied out by the denominator, which keeps the digits of weak reflections. Where eta < 1 and
    sin_t would exceed 1, everything is reflected. Reference: Born1999.
    """
    c = clip(cosine, 1e-9, 1.0)  # the square of c + g stays above zero for eta = 1, too
    eta2 = eta * eta
    step = (eta - 1.0) * (eta + 1.0)
    g2 = step + c * c
    g = sqrt(maximum(g2, 1e-12))
    r_s = -step / (c + g) ** 2
    r_p = step * ((eta2 + 1.0) * c * c - 1.0) / (eta2 * c + g) ** 2
    return where(g2 > 0.0, 0.5 * (r_s * r_s + r_p * r_p), 1.0 + 0.0 * g2)


class Dielectric(Fresnel):
    """Exact, unpolarised, for a real relative index, both ways: see `dielectric`. Reference: Born1999."""

    eta: Scalar = number("refractive index inside over that outside", default=1.5, low=0.25, high=4.0)

    def F(self, cosine: Scalar) -> Vec:
        reflectance = dielectric(cosine, self.eta)
        return Vec(reflectance, reflectance, reflectance)


class CookTorranceF0(Fresnel):
    """The dielectric curve through a given reflectance at normal incidence, a channel each. Reference: Cook1982.

    eta = (1 + sqrt(F0)) / (1 - sqrt(F0)), then the exact dielectric reflectance for that real index.
    """

    F0: RGB = rgb("reflectance at normal incidence", default=0.04, low=0.0, high=1.0)

    def F(self, cosine: Scalar) -> Vec:
        # F0 = 1 wants an infinite index; at 1 - 1e-6 the index is 4e6 and single precision still has room
        F0 = minimum(self.F0, 1.0 - 1e-6)
        eta = (1.0 + sqrt(F0)) ** 2 / (1.0 - F0)
        return dielectric(cosine, eta)


class Conductor(Fresnel):
    """Exact, unpolarised, for a complex index eta + i k. Reference: Born1999, in the real form of Lagarde2013."""

    eta: RGB = rgb("refractive index, real part", default=(0.2, 0.92, 1.1), low=1e-3, high=20.0)
    k: RGB = rgb("extinction coefficient", default=(3.91, 2.45, 2.14), low=0.0, high=20.0)

    def F(self, cosine: Scalar) -> Vec:
        return conductor(cosine, self.eta, self.k)


def conductor(cosine: Any, eta: Any, k: Any) -> Any:
    """Exact, unpolarised reflectance of a complex index eta + i k. References: as `Conductor`."""
    c = saturate(cosine)
    cos2 = c * c
    sin2 = 1.0 - cos2
    eta2, k2 = eta * eta, k * k
    t = eta2 - k2 - sin2
    a2_plus_b2 = sqrt(t * t + 4.0 * eta2 * k2)
    # a^2 = (a2_plus_b2 + t) / 2; for negative t the other root of the quadratic avoids the cancellation.
    larger = 0.5 * (a2_plus_b2 + abs(t)) + 1e-30
    a = sqrt(where(t < 0.0, eta2 * k2 / larger, larger))
    r_s = (a2_plus_b2 + cos2 - 2.0 * c * a) / (a2_plus_b2 + cos2 + 2.0 * c * a)
    common = cos2 * a2_plus_b2 + sin2 * sin2
    mixed = 2.0 * c * sin2 * a
    return 0.5 * r_s * (1.0 + (common - mixed) / (common + mixed))


class Table(Fresnel):
    """A curve given by samples, painted by hand for a shift of colour at grazing angles. Reference: AkenineMoller2008.

    Evenly spaced in the cosine, the first sample grazing (cosine 0), the last at normal incidence (cosine 1); linear
    between them.
    """

    table: Any = texture(
        "reflectance (n, 3) from grazing to normal incidence", [[1.0, 1.0, 1.0], [0.04, 0.04, 0.04]], 1, 3, 0.0, 1.0
    )

    def F(self, cosine: Scalar) -> Vec:
        # the first and the last texel's centres lie half a texel inside the texture
        n = self.table.shape[0]
        return texture1d(self.table, (saturate(cosine) * (n - 1.0) + 0.5) / n)


TERMS = {
    "schlick": Schlick,
    "schlick-f90": SchlickF90,
    "dielectric": Dielectric,
    "conductor": Conductor,
    "cook-torrance": CookTorranceF0,
    "table": Table,
}
"""By the name that `Microfacet(fresnel=...)` knows them by."""
