"""Rough diffuse reflection that keeps its energy: Oren and Nayar's model with the missing light put back."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ..formula import Scalar, Vec, acos, dot, maximum, pi, sqrt, where
from ..geometry.sampling import CosineSampler, Sampler
from ..parameters import RGB, albedo, choice, number
from .model import Model

_DIRECTIONAL_ALBEDOS = {"exact": "", "approximate": ""}
_C1 = 0.5 - 2 / (3 * pi)
_C2 = 2 / 3 - 28 / (15 * pi)
_SERIES = (0.0571085289, 0.491881867, -0.332181442, 0.0714429953)
"""G / pi in powers 1 to 4 of 1 - cosine, fitted by the authors; the directional albedo comes out within 0.1 %."""


class EON(Model):
    """Energy-preserving Oren-Nayar: Fujii's form for light scattered once, plus a lobe for what is scattered again.

        f(wi, wo) = rho / pi A (1 + r s / t) + rho_ms / pi (1 - E(wi)) (1 - E(wo)) / (1 - E_mean)      [1/sr]
        s = wi . wo - cos_i cos_o,   t = max(cos_i, cos_o) where s > 0, else 1
        A = 1 / (1 + (1/2 - 2 / (3 pi)) r),   E_mean = A (1 + (2/3 - 28 / (15 pi)) r)
        rho_ms = rho^2 E_mean / (1 - rho (1 - E_mean))
        E(w) = A (1 + r G(w) / pi),   G = sin (theta - sin cos) + 2/3 (tan (1 - sin^3) - sin)

    E is the directional albedo of the first lobe at rho = 1. With rho = 1 nothing is lost: the albedo is 1, exactly
    with `directional_albedo="exact"`, within 0.1 % with the authors' polynomial. References: Portsmouth2025, Fujii2012.
    """

    lossless = {"rho": 1.0}  # noqa: RUF012

    rho: RGB = albedo("reflectance of the facets", default=0.5)
    roughness: Scalar = number("roughness r", default=0.5, low=0.0, high=1.0)
    directional_albedo: Any = choice("how E is computed", "exact", _DIRECTIONAL_ALBEDOS)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        approximate = self.directional_albedo == "approximate"
        return eon(wi, wo, self.rho, self.roughness, fitted_G_over_pi if approximate else exact_G_over_pi)

    def _make_sampler(self) -> Sampler:
        return CosineSampler()


def eon(wi: Vec, wo: Vec, rho: Vec, r: Scalar, G_over_pi: Callable[[Vec], Scalar]) -> Vec:
    """The formula with every number an argument [1/sr]: for models with such a diffuse part."""
    s = dot(wi, wo) - wi.z * wo.z
    s_over_t = where(s > 0.0, s / maximum(wi.z, wo.z), s)
    A = 1.0 / (1.0 + _C1 * r)
    once = A * (1.0 + r * s_over_t) / pi

    # 1 - E = A r (C1 - G / pi), so that (1 - E)(1 - E) / (1 - E_mean) needs no division by what vanishes with r
    lost_i, lost_o = _C1 - G_over_pi(wi), _C1 - G_over_pi(wo)
    again = A * r * lost_i * lost_o / ((_C1 - _C2) * pi)
    E_mean = A * (1.0 + _C2 * r)
    rho_ms = rho * rho * E_mean / (1.0 - rho * (1.0 - E_mean))
    return rho * once + rho_ms * again


def fitted_G_over_pi(w: Vec) -> Scalar:
    x = 1.0 - w.z
    return x * (_SERIES[0] + x * (_SERIES[1] + x * (_SERIES[2] + x * _SERIES[3])))


def exact_G_over_pi(w: Vec) -> Scalar:
    sine2 = w.x * w.x + w.y * w.y
    sine = sqrt(sine2)
    # tan (1 - sin^3) with the common factor cos taken out: tan grows beyond bounds at the horizon
    grazing = sine * w.z * (1.0 + sine + sine2) / (1.0 + sine)
    return (sine * (acos(w.z) - sine * w.z) + 2.0 / 3.0 * (grazing - sine)) / pi
