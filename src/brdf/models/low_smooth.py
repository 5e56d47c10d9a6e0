"""Low, Kronander, Ynnerman and Unger's model of smooth glossy surfaces."""

from __future__ import annotations

from typing import ClassVar

from ..formula import Vec, exp, log, maximum, sqrt
from ..parameters import RGB, Scalar, number, rgb
from .model import Model
from .terms.fresnel import dielectric


class LowSmooth(Model):
    """Scatter of a smooth surface (Rayleigh-Rice): an ABC lobe over the deviation from the mirror, in projection.

        f(wi, wo) = A F(theta_d) / (1 + B |dp|^2)^C      [1/sr],   dp = (wi.x + wo.x, wi.y + wo.y)
        cos theta_d = sqrt(1 - |(wi.x - wo.x, wi.y - wo.y)|^2 / 4)

    F is the exact dielectric reflectance of the real index eta. A has no normalisation. Reference: Low2012.
    """

    breaks: ClassVar = {"energy": "A is fitted and has no normalisation [Low2012]"}

    A: RGB = rgb("peak over the Fresnel reflectance", default=50.0, low=0.0, high=1e5, unit="1/sr")
    B: Scalar = number("inverse square of the lobe's width", default=1000.0, low=0.0, high=1e8)
    C: Scalar = number("exponent of the tail", default=1.0, low=0.0, high=10.0)
    eta: Scalar = number("relative refractive index", default=1.5, low=1.0, high=100.0)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        deviation2 = (wi.x + wo.x) ** 2 + (wi.y + wo.y) ** 2
        chord2 = (wi.x - wo.x) ** 2 + (wi.y - wo.y) ** 2
        cos_d = sqrt(maximum(1.0 - 0.25 * chord2, 0.0))
        lobe = exp(-self.C * log(1.0 + self.B * deviation2))
        return self.A * (lobe * dielectric(cos_d, self.eta))
