"""Lafortune's generalised cosine lobe."""

from __future__ import annotations

from ..formula import Vec, abs, pi, where
from ..parameters import RGB, Scalar, albedo, number
from .model import Model
from .terms.cosine_lobes import positive_power_of_one_minus


class Lafortune(Model):
    """One lobe of Lafortune's sum of generalised cosines; several are a sum of these.

        f(wi, wo) = ks (n + 2) / (2 pi) max(0, Cx wi.x wo.x + Cy wi.y wo.y + Cz wi.z wo.z)^n      [1/sr]

    C = (-1, -1, 1) is `ModifiedPhong`; |Cz| below |Cx|, |Cy| moves the peak off the mirror direction, towards grazing
    angles; Cx, Cy > 0 make it retro-reflective; Cx != Cy anisotropic. The largest |C| is taken to be 1 and the
    normalisation kept beside it, where the paper lets C take up both. Reference: Lafortune1997.
    """

    ks: RGB = albedo("albedo at normal incidence for Cz = 1", default=0.5)
    Cxy: Scalar = number("weight in the tangent plane", default=-1.0, low=-1.0, high=1.0)
    Cx: Scalar = number("weight along the tangent", low=-1.0, high=1.0, follows="Cxy")
    Cy: Scalar = number("weight along the bitangent", low=-1.0, high=1.0, follows="Cxy")
    Cz: Scalar = number("weight along the normal", default=1.0, low=-1.0, high=1.0)
    n: Scalar = number("exponent", default=50.0, low=0.0, high=1e6)

    @property
    def isotropic(self) -> bool:
        return bool(self.Cx == self.Cy)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        # 1 - C . (wi wo) = sum((1 - |C|)(wi^2 + wo^2) + |C| (wi -+ wo)^2) / 2, free of cancellation in a sharp lobe
        weighted = zip((self.Cx, self.Cy, self.Cz), wi, wo, strict=True)
        below_one = 0.0
        for C, i, o in weighted:
            apart = where(C < 0.0, i + o, i - o)
            below_one = below_one + 0.5 * ((1.0 - abs(C)) * (i * i + o * o) + abs(C) * apart * apart)
        return self.ks * ((self.n + 2.0) / (2.0 * pi) * positive_power_of_one_minus(below_one, self.n))
