"""Sheen: the glow of cloth towards grazing angles, from a microfacet distribution of fibres standing up."""

from __future__ import annotations

from ..formula import Scalar, Vec, dot, exp, log, maximum, pi, pow, where
from ..geometry.sampling import CosineSampler, Sampler
from ..parameters import RGB, albedo, number
from .model import Model

_FITS = ((25.3245, 21.5473), (3.32435, 3.82987), (0.16801, 0.19823), (-1.27393, -1.97760), (-4.85967, -4.32054))
"""Coefficients a to e of the fitted Lambda at r = 0 and r = 1 (Estevez2017, table 1)."""


class CharlieSheen(Model):
    """Conty and Kulla's sheen: an inverted Gaussian-like distribution of fibres, with its fitted masking.

        f(wi, wo) = color D G / (4 cos_i cos_o)      [1/sr],   D = (2 + 1/r) sin^(1/r)(theta_h) / (2 pi)
        G = 1 / (1 + Lambda(cos_i) + Lambda(cos_o))
        Lambda(c) = exp(L(c)) for c < 0.5, else exp(2 L(0.5) - L(1 - c)),   L(x) = a / (1 + b x^c) + d x + e

    a to e are interpolated in (1 - r)^2 between fits at r = 0 and r = 1. The softening of the terminator, which is not
    reciprocal, is left out. Reference: Estevez2017.
    """

    color: RGB = albedo("reflectance of the fibres", default=0.5)
    roughness: Scalar = number("r: how far the fibres lean", default=0.3, low=0.1, high=1.0)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        return self.color * charlie(wi, wo, self.roughness)

    def _make_sampler(self) -> Sampler:
        return CosineSampler()


def charlie(wi: Vec, wo: Vec, roughness: Scalar) -> Scalar:
    """The lobe of white fibres [1/sr]."""
    h = wi + wo
    sin2 = (h.x * h.x + h.y * h.y) / dot(h, h)
    D = (2.0 + 1.0 / roughness) * pow(maximum(sin2, 1e-30), 0.5 / roughness) / (2.0 * pi)
    G = 1.0 / (1.0 + charlie_lambda(wi.z, roughness) + charlie_lambda(wo.z, roughness))
    return D * G / (4.0 * wi.z * wo.z)


def charlie_lambda(cosine: Scalar, roughness: Scalar) -> Scalar:
    """Smith's auxiliary function, fitted."""
    low = cosine < 0.5
    L = _exponent(where(low, cosine, 1.0 - cosine), roughness)
    return exp(where(low, L, 2.0 * _exponent(0.5, roughness) - L))


def _exponent(x: Scalar, roughness: Scalar) -> Scalar:
    t = (1.0 - roughness) ** 2
    a, b, c, d, e = (at_1 + (at_0 - at_1) * t for at_0, at_1 in _FITS)
    return a / (1.0 + b * exp(c * log(maximum(x, 1e-30)))) + d * x + e
