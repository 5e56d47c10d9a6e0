"""Shifted Gamma micro-facet distribution: the model that fits the MERL materials best of the classical ones."""

from __future__ import annotations

from typing import ClassVar

from ..formula import Scalar, Vec, atan2, dot, exp, log, maximum, minimum, pi, saturate, sqrt, where
from ..parameters import RGB, albedo, rgb
from .model import Model


class SGD(Model):
    """Diffuse part plus micro-facets whose slopes follow a shifted Gamma distribution; every parameter a channel each.

        f(wi, wo) = kd / pi + ks D(theta_h) G1(theta_i) G1(theta_o) F(theta_d) / (pi cos_i cos_o)      [1/sr]
        D = K exp(-x) / (pi x^p cos^4 theta_h),   x = alpha + tan^2 theta_h / alpha
        G1 = 1 + Lambda (1 - exp(c (theta - theta0)^k)) for theta > theta0, else 1; kept in [0, 1]
        F = F0 + (1 - F0)(1 - cos theta_d)^5 - F1 cos theta_d

    K normalises D: K = 1 / (alpha Gamma(1 - p, alpha)) with the upper incomplete Gamma function, so that D cos theta_h
    integrates to 1. The denominator has pi (not 4): it belongs to the published values of ks. G1, too, is a fit. c is
    given by its logarithm: published values reach 1e109, and c (theta - theta0)^k is formed from logarithms. F0 and F1
    are coefficients, not reflectances. Reference: Bagher2012.
    """

    breaks: ClassVar = {
        "energy": "ks and masking are fitted and unbounded: six published rows gain at grazing angles [Bagher2012]"
    }

    kd: RGB = albedo("diffuse albedo", default=0.1)
    ks: RGB = rgb("scale of the specular part", default=0.1, low=0.0)
    alpha: RGB = rgb("width of the distribution", default=0.1, low=1e-6, high=10.0)
    p: RGB = rgb("exponent of the distribution's tail", default=0.5, low=0.0, high=10.0)
    F0: RGB = rgb("Fresnel coefficient of normal incidence", default=1.0, low=0.0, high=100.0)
    F1: RGB = rgb("Fresnel coefficient of the linear correction", default=0.0, low=-100.0, high=100.0)
    K: RGB = rgb("normalisation of the distribution", default=8.617308, low=0.0)
    Lambda: RGB = rgb("depth of the masking", default=1.0, low=0.0)
    log_c: RGB = rgb("natural logarithm of the masking's rate c", default=-9.4)
    k: RGB = rgb("exponent of the masking", default=20.0, low=0.0)
    theta0: RGB = rgb("angle where masking begins", default=0.0, low=-pi / 2, high=pi / 2, unit="rad")

    def f(self, wi: Vec, wo: Vec) -> Vec:
        h = wi + wo
        h2 = dot(h, h)
        hz2 = maximum(h.z * h.z, 1e-18)
        tan2_h = (h.x * h.x + h.y * h.y) / hz2
        cos2_h = hz2 / h2
        cos_d = minimum(0.5 * sqrt(h2), 1.0)

        x = self.alpha + tan2_h / self.alpha
        D = self.K * exp(-(x + self.p * log(x))) / (pi * cos2_h * cos2_h)
        F = self.F0 + (1.0 - self.F0) * (1.0 - cos_d) ** 5 - self.F1 * cos_d
        # The fits of three fabrics and paints dip below zero at normal incidence, where reflectance cannot.
        specular = self.ks * D * maximum(F, 0.0) * self.G1(wi) * self.G1(wo) / (pi * wi.z * wo.z)
        return self.kd * (1 / pi) + specular

    def G1(self, w: Vec) -> Vec:
        """Share of the facets seen from `w`."""
        theta = atan2(sqrt(w.x * w.x + w.y * w.y), w.z)
        t = theta - self.theta0
        log_z = self.log_c + self.k * log(maximum(t, 1e-30))
        # Beyond z = 40, G1 is 0 for any Lambda above 1e-17; the bound keeps single precision from overflow.
        z = where(t > 0.0, exp(minimum(log_z, LOG_40)), 0.0 * t)
        return saturate(1.0 - self.Lambda * _exp_minus_one(z))


LOG_40 = 3.6888794541139363


def _exp_minus_one(z: Scalar) -> Scalar:
    """exp(z) - 1 for z >= 0 without cancellation: Lambda, up to 1.5e7, multiplies it."""
    term = 1.0 + z / 12.0
    for denominator in range(11, 1, -1):
        term = 1.0 + z * term / float(denominator)
    return where(z < 0.5, z * term, exp(z) - 1.0)
