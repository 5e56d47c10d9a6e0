"""He, Torrance, Sillion and Greenberg's wave-optical model: its directional-diffuse part."""

from __future__ import annotations

from typing import Any

from ..formula import Scalar as Number
from ..formula import Vec, dot, erf, exp, maximum, minimum, pi, sqrt
from ..parameters import Scalar, choice, number
from .model import Model
from .terms.diffraction import lambert_w, poisson_sum
from .terms.fresnel import TERMS as FRESNEL_TERMS

SQRT_PI = 1.7724538509055159


class HeTorrance(Model):
    """Diffraction from a Gaussian random surface: lobes from mirror-like to rough with the wavelength as the yardstick.

        f(wi, wo) = F(h . wi) S(wi) S(wo) / (pi cos_i cos_o) (v . v / v.z)^2 D      [1/sr],   v = wi + wo
        D = pi^2 tau^2 / 4 sum_{m >= 1} g^m exp(-g) / (m! m) exp(-pi^2 tau^2 (v.x^2 + v.y^2) / m)
        g = (2 pi sigma (cos_i + cos_o))^2,   sigma = sigma0 / sqrt(1 + x^2)
        x exp(x^2 / 2) = (K_i + K_o) / sqrt(8 pi),   K = tan theta erfc(tau cot theta / (2 sigma0))
        S = (1 - erfc(a) / 2) / (1 + Lambda),   a = tau cot theta / (2 sigma0)
        Lambda = (exp(-a^2) / (sqrt(pi) a) - erfc(a)) / 2

    sigma0 and tau are in wavelengths. The paper's polarisation factor is (v . v / v.z)^2 exactly: what multiplies it
    there is 1 for any two directions. Lambda has the exponential that the paper's errata supply. The coherent (mirror)
    part, weight F exp(-g), and the uniform-diffuse part are not in it. For sigma0 >> 1 it is a Beckmann surface of
    RMS slope 2 sigma0 / tau. References: He1991, Westin2004.
    """

    sigma0: Scalar = number("RMS roughness", default=0.5, low=0.005, high=10.0, unit="wavelength")
    tau: Scalar = number("autocorrelation length", default=4.0, low=1.0, high=200.0, unit="wavelength")
    fresnel: Any = choice("Fresnel reflectance", "dielectric", FRESNEL_TERMS)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        v = wi + wo
        v2 = dot(v, v)
        slope_ratio = self.tau / (2.0 * self.sigma0)
        K = self.shadowed_tangent(wi, slope_ratio) + self.shadowed_tangent(wo, slope_ratio)
        x2 = lambert_w(K * K / (8.0 * pi))
        sigma = self.sigma0 / sqrt(1.0 + x2)
        root_g = 2.0 * pi * sigma * v.z
        e = (pi * self.tau) ** 2 * (v.x * v.x + v.y * v.y)
        D = 0.25 * (pi * self.tau) ** 2 * poisson_sum(root_g * root_g, e)
        geometry = v2 / v.z * self.visible(wi, slope_ratio) * self.visible(wo, slope_ratio) * (v2 / v.z)
        return self.fresnel.F(0.5 * sqrt(v2)) * (D * geometry / pi)

    def shadowed_tangent(self, w: Vec, slope_ratio: Number) -> Number:
        """K = tan theta erfc(a), finite up to a cosine of 1e-6."""
        sine = sqrt(w.x * w.x + w.y * w.y)
        return sine / w.z * maximum(1.0 - erf(reach(w, slope_ratio)), 0.0)

    def visible(self, w: Vec, slope_ratio: Number) -> Number:
        """S / cos theta, finite at the horizon: cos theta (1 + Lambda) is."""
        sine = sqrt(w.x * w.x + w.y * w.y)
        a = reach(w, slope_ratio)
        erfc = 1.0 - erf(a)
        masked = 0.5 * (exp(-a * a) * sine / (SQRT_PI * slope_ratio) - w.z * erfc)
        return (1.0 - 0.5 * erfc) / (w.z + maximum(masked, 0.0))


def reach(w: Vec, slope_ratio: Number) -> Number:
    """a = cot theta tau / (2 sigma0); beyond 9 every function of it is constant, in double precision as well."""
    sine = sqrt(w.x * w.x + w.y * w.y)
    return minimum(slope_ratio * w.z / maximum(sine, 1e-12), 9.0)
