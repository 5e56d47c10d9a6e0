"""Cook and Torrance's model as they printed it."""

from __future__ import annotations

from typing import Any, ClassVar

from ..formula import Vec, dot, exp, maximum, pi, sqrt
from ..parameters import Scalar, choice, number
from .model import Model
from .terms.fresnel import TERMS as FRESNEL_TERMS
from .terms.grooves import v_groove_visibility


class CookTorrance(Model):
    """Beckmann's facets in V-grooves; with the paper's pi, which Torrance-Sparrow theory has as 4.

        f(wi, wo) = F(h . wi) D(h) G / (pi cos_i cos_o)      [1/sr]
        D = exp(-tan^2 theta_h / m^2) / (pi m^2 cos^4 theta_h)
        G = min(1, 2 cos_h cos_i / (h . wi), 2 cos_h cos_o / (h . wi))

    m is the RMS slope. The printed D lacks its 1/pi, the published fits of Ngan2005 have it, those of Low2012 do not.
    With 4 in the place of pi it is a part of `Microfacet`. Reference: Cook1982.
    """

    breaks: ClassVar = {"energy": "pi in the place of 4 reflects 4 / pi of what arrives [Torrance1967]"}

    m: Scalar = number("RMS slope of the facets", default=0.2, low=1e-4, high=10.0)
    fresnel: Any = choice("Fresnel reflectance", "schlick", FRESNEL_TERMS)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        h = wi + wo
        h2 = dot(h, h)
        hz2 = maximum(h.z * h.z, 1e-18)
        cos_d = 0.5 * sqrt(h2)
        cos2_h = hz2 / h2
        D = exp(-(h.x * h.x + h.y * h.y) / (hz2 * self.m * self.m)) / (pi * self.m * self.m * cos2_h * cos2_h)
        return self.fresnel.F(cos_d) * (D * v_groove_visibility(wi, wo) / pi)
