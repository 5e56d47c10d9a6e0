"""The law of Lommel and Seeliger: the full moon."""

from __future__ import annotations

from ..formula import Vec, dot, pi, sqrt
from ..parameters import RGB, Scalar, albedo, number
from .model import Model


class LommelSeeliger(Model):
    """Light scattered once in a deep layer of dark grains: the lunar, retro-reflective law.

        f(wi, wo) = w / (4 pi) p(phase) / (cos_i + cos_o)      [1/sr]
        p = (1 - g^2) / (1 + g^2 + 2 g cos(phase))^(3/2),   cos(phase) = wi . wo

    Lit from the viewer's place (wi = wo) the radiance f cos_i = w p(0) / (8 pi) does not depend on the angle: the full
    moon is a flat disc. p is the phase function of Henyey and Greenstein; g < 0 sends light back where it came from,
    g = 0 scatters evenly. References: Lommel1889, Seeliger1887, Blinn1982, Henyey1941.
    """

    albedo: RGB = albedo("single-scattering albedo w of the grains", default=0.3)
    g: Scalar = number("asymmetry of the phase function", default=0.0, low=-0.95, high=0.95)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        spread = 1.0 + self.g * self.g + 2.0 * self.g * dot(wi, wo)
        phase_function = (1.0 - self.g * self.g) / (spread * sqrt(spread))
        return self.albedo * (phase_function / (4.0 * pi * (wi.z + wo.z)))
