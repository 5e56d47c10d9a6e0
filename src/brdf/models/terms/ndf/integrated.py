"""Distributions with a closed form of their own but none of their masking."""

from __future__ import annotations

from typing import Any

from ....formula import Scalar, Vec, abs, atan2, dot, exp, log, maximum, minimum, pi, pow, sin, sqrt
from ....geometry.quadrature import gauss_legendre
from ....parameters import number, width
from ..exponentials import mean_exponential
from ..powers import power_of_one_minus
from .distribution import Stretched
from .projected_area import Integrated, area_from, facets_away, tan2

_NODES, _WEIGHTS = (rule.tolist() for rule in gauss_legendre(32))


def _integral(integrand: Any, length: Scalar) -> Scalar:
    """Of a smooth function from 0 to `length`, in terms a derivative can follow."""
    total = 0.0 * length
    for node, weight in zip(_NODES, _WEIGHTS, strict=True):
        total = total + weight * integrand(node * length)
    return total * length


def _sin2(h: Vec) -> Scalar:
    return (h.x * h.x + h.y * h.y) / dot(h, h)


class BlinnPhong(Integrated, name="blinn-phong"):
    """D = (n + 2) / (2 pi) cos^n theta_h. References: Blinn1977, Walter2007."""

    n: Scalar = number("exponent", default=50.0, low=0.0, high=1e6)

    def D(self, h: Vec) -> Scalar:
        return (self.n + 2.0) / (2.0 * pi) * power_of_one_minus(_sin2(h), 0.5 * self.n)

    def slope_width(self) -> Scalar:
        return sqrt(2.0 / (self.n + 2.0))


class Gaussian(Integrated, name="gaussian"):
    """D = c exp(-(theta_h / m)^2); c normalises it numerically. References: Torrance1967, Blinn1977."""

    m: Scalar = width("width in angle", default=0.2)

    def D(self, h: Vec) -> Scalar:
        theta = atan2(sqrt(h.x * h.x + h.y * h.y), h.z)
        # 2 pi times the integral of sin cos exp(-theta^2 / m^2), with x = theta / m; beyond x = 6 nothing is left
        m = self.m
        c = pi * m * _integral(lambda x: sin(2.0 * m * x) * exp(-x * x), minimum(0.5 * pi / m, 6.0))
        return exp(-((theta / m) ** 2)) / c

    def slope_width(self) -> Scalar:
        return self.m


class GTR(Integrated, name="gtr"):
    """Generalised Trowbridge-Reitz: D = c / (alpha^2 cos^2 theta_h + sin^2 theta_h)^gamma; gamma = 2 is GGX.

    1 / (pi c) is the mean of s^-gamma over alpha^2 < s < 1. Reference: Burley2012.
    """

    alpha: Scalar = width("width of the distribution", default=0.2)
    gamma: Scalar = number("exponent: the smaller, the longer the tail", default=1.0, low=0.0, high=10.0)

    def D(self, h: Vec) -> Scalar:
        # alpha = 1 is the even distribution whatever gamma; the bound keeps its normalisation from 0 / 0
        alpha2 = minimum(self.alpha * self.alpha, 1.0 - 1e-6)
        s = alpha2 + (1.0 - alpha2) * _sin2(h)
        # with s = exp(-y) the mean is that of exp((gamma - 1) y); exp of the larger end is kept in the exponent below
        decay = -log(alpha2)
        growth = (self.gamma - 1.0) * decay
        mean = decay * mean_exponential(-abs(growth)) / (1.0 - alpha2)
        return exp(-self.gamma * log(s) - maximum(growth, 0.0)) / (pi * mean)

    def slope_width(self) -> Scalar:
        return self.alpha


class StudentT(Stretched, name="student-t"):
    """Student's t distribution of slopes, between GGX (gamma = 2) and Beckmann (gamma to infinity).

    D = (1 + tan^2 theta_h / ((gamma - 1) alpha^2))^-gamma / (pi alpha^2 cos^4 theta_h). Reference: Ribardiere2017.
    """

    gamma: Scalar = number("exponent: the smaller, the longer the tail", default=3.0, low=1.6, high=40.0)

    def D(self, h: Vec) -> Scalar:
        # over h.z^2, which cancels the cosines as far as gamma reaches
        cos2 = h.z * h.z + 1e-18
        slope2 = ((h.x / self.alpha_x) ** 2 + (h.y / self.alpha_y) ** 2) / cos2
        tail = exp(-self.gamma * log(1.0 + slope2 / (self.gamma - 1.0)) - 2.0 * log(cos2))
        return tail / (pi * self.alpha_x * self.alpha_y)

    def derived_textures(self) -> Any:
        gamma = float(self.gamma)
        return {"facets_away": facets_away(lambda t: (1 + t * t / (gamma - 1)) ** -gamma / pi, 1.0)}

    def projected_area(self, w: Vec) -> Scalar:
        return area_from(self.facets_away, self.stretched2(w), w.z)


class ABC(Integrated, name="abc"):
    """D = c / (1 + B (1 - cos theta_h))^C. Reference: Low2012."""

    B: Scalar = number("inverse width of the peak", default=100.0, low=1.0, high=1e7)
    C: Scalar = number("exponent of the tail", default=1.5, low=0.0, high=10.0)

    def D(self, h: Vec) -> Scalar:
        sin2 = _sin2(h)
        one_minus_cosine = sin2 / (1.0 + sqrt(maximum(1.0 - sin2, 0.0)))
        # 2 pi times the integral of (1 - t) (1 + B t)^-C over t in [0, 1], by parts
        L = log(1.0 + self.B)
        first = L * mean_exponential((1.0 - self.C) * L)
        second = L * mean_exponential((2.0 - self.C) * L)
        c = 2.0 * pi * ((1.0 + self.B) * first - second) / (self.B * self.B)
        return pow(1.0 + self.B * one_minus_cosine, -self.C) / c

    def slope_width(self) -> Scalar:
        return minimum(sqrt(2.0 / (self.B * self.C + 1e-3)), 1.0)


class SGD(Integrated, name="sgd"):
    """Shifted Gamma distribution: D = K exp(-x) / (pi x^p cos^4 theta_h), x = alpha + tan^2 theta_h / alpha.

    K = 1 / (alpha Gamma(1 - p, alpha)); the incomplete Gamma function is integrated over log x. Reference: Bagher2012.
    """

    alpha: Scalar = width("width of the distribution", default=0.2)
    p: Scalar = number("exponent: the larger, the sharper the peak", default=0.5, low=0.0, high=10.0)

    def D(self, h: Vec) -> Scalar:
        alpha = self.alpha
        # x over alpha, logarithm y: Gamma(1 - p, alpha) = alpha^(1 - p) integral exp((1 - p) y - alpha e^y) dy
        upper = log(1.0 + 40.0 / alpha)
        gamma = _integral(lambda y: exp((1.0 - self.p) * y - alpha * (exp(y) - 1.0)), upper)
        t2 = tan2(h)
        y = log(1.0 + t2 / (alpha * alpha))
        return exp(-self.p * y - t2 / alpha) * (1.0 + t2) ** 2 / (pi * alpha * alpha * gamma)

    def slope_width(self) -> Scalar:
        return self.alpha / sqrt(1.0 + self.p / self.alpha)
