"""Neumann, Neumann and Szirmay-Kalos' metallic Phong."""

from __future__ import annotations

from ..formula import Vec, maximum, pi
from ..parameters import RGB, Scalar, albedo, number
from .model import Model
from .terms.cosine_lobes import mirror_lobe


class NeumannNeumann(Model):
    """Phong's lobe made metallic: divided by the larger cosine, it becomes the ideal mirror as n grows.

        f(wi, wo) = ks (n + 2) / (2 pi) max(0, r . wo)^n / max(cos_i, cos_o)      [1/sr],   r = (-wi.x, -wi.y, wi.z)

    `ModifiedPhong` darkens towards grazing angles, as the cosine; this one keeps its albedo there. Reference:
    Neumann1999.
    """

    ks: RGB = albedo("albedo at normal incidence", default=0.5)
    n: Scalar = number("exponent", default=50.0, low=1.0, high=1e6)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        return self.ks * ((self.n + 2.0) / (2.0 * pi) * mirror_lobe(wi, wo, self.n) / maximum(wi.z, wo.z))
