"""Low, Kronander, Ynnerman and Unger's micro-facet model of glossy surfaces."""

from __future__ import annotations

from typing import ClassVar

from ..formula import Vec, dot, exp, log, sqrt
from ..parameters import RGB, Scalar, number, rgb
from .model import Model
from .terms.fresnel import dielectric
from .terms.grooves import v_groove_visibility


class LowMicrofacet(Model):
    """Facets with the ABC lobe as their distribution, in V-grooves.

        f(wi, wo) = A F(h . wi) G / ((1 + B (1 - cos theta_h))^C cos_i cos_o)      [1/sr]
        G = min(1, 2 cos_h cos_i / (h . wi), 2 cos_h cos_o / (h . wi))

    F is the exact dielectric reflectance of the real index eta. A has no normalisation. Reference: Low2012.
    """

    breaks: ClassVar = {"energy": "A is fitted and has no normalisation [Low2012]"}

    A: RGB = rgb("scale of the distribution", default=10.0, low=0.0, high=1e5, unit="1/sr")
    B: Scalar = number("inverse of the lobe's width", default=1000.0, low=0.0, high=1e8)
    C: Scalar = number("exponent of the tail", default=1.0, low=0.0, high=10.0)
    eta: Scalar = number("relative refractive index", default=1.5, low=1.0, high=100.0)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        h = wi + wo
        h2 = dot(h, h)
        length = sqrt(h2)
        # 1 - cos theta_h without its cancellation
        tilt = (h.x * h.x + h.y * h.y) / (length * (length + h.z))
        lobe = exp(-self.C * log(1.0 + self.B * tilt))
        return self.A * (lobe * v_groove_visibility(wi, wo) * dielectric(0.5 * length, self.eta))
