"""Masking and shadowing: the share G of facets that light and viewer both see.

Given as the visibility G / (cos_i cos_o) [1], which stays finite at the horizon where both G and the cosines vanish.
Terms that were given as a denominator of their own, without a G, are here as what they make of this visibility.
"""

from __future__ import annotations

from typing import Any, ClassVar

from ...formula import Scalar, Vec, dot, maximum, minimum, pi, sqrt
from ...parameters import Parameterised

MASKINGS: dict[str, type[Masking]] = {}
"""Every masking term by the name it is chosen by; a term enters by being defined with one."""


class Masking(Parameterised):
    """Base of the masking terms. Smith's are written with the projected area A(w) = cos (1 + Lambda(w)) of an NDF."""

    breaks: ClassVar[dict[str, str]] = {}
    """Laws that reflectances with this term break, whatever the other terms, with reason and source."""

    def __init_subclass__(cls, name: str = "", **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        if name:
            MASKINGS[name] = cls

    def visibility(self, ndf: Any, wi: Vec, wo: Vec) -> Scalar:
        raise NotImplementedError


class SmithCorrelated(Masking, name="smith"):
    """Smith's masking with heights correlated: G = 1 / (1 + Lambda(wi) + Lambda(wo)). Reference: Heitz2014."""

    def visibility(self, ndf: Any, wi: Vec, wo: Vec) -> Scalar:
        return 1.0 / (ndf.projected_area(wi) * wo.z + wi.z * (ndf.projected_area(wo) - wo.z))


class SmithSeparable(Masking, name="smith-separable"):
    """Smith's masking, heights independent: G = G1(wi) G1(wo). References: Smith1967, Walter2007.

    For a distribution given by samples it is the generator of Ashikhmin2000, whose g(w) is A(w) to a factor.
    """

    def visibility(self, ndf: Any, wi: Vec, wo: Vec) -> Scalar:
        return 1.0 / (ndf.projected_area(wi) * ndf.projected_area(wo))


class SmithSchlick(Masking, name="smith-schlick"):
    """Schlick's rational stand-in for Smith's masking: G1 = cos / (cos (1 - k) + k), k = sqrt(2 m^2 / pi).

    m is the RMS slope, the width of the Beckmann distribution that the NDF resembles. References: Schlick1994,
    AkenineMoller2008 (eq. 7.56).
    """

    breaks: ClassVar[dict[str, str]] = {"energy": "made for Beckmann's slopes: too little for long tails [Schlick1994]"}

    def visibility(self, ndf: Any, wi: Vec, wo: Vec) -> Scalar:
        k = minimum(sqrt(2.0 / pi) * ndf.slope_width(), 1.0)
        return 1.0 / ((wi.z * (1.0 - k) + k) * (wo.z * (1.0 - k) + k))


class VGroove(Masking, name="v-groove"):
    """Torrance and Sparrow's grooves: G = min(1, 2 h.z cos_i / (wo . h), 2 h.z cos_o / (wo . h)).

    References: Torrance1967, Blinn1977, Cook1982, AkenineMoller2008 (eq. 7.54).
    """

    def visibility(self, ndf: Any, wi: Vec, wo: Vec) -> Scalar:
        h = wi + wo
        # with h not normalised, 2 h.z / (wo . h) = 4 h.z / (h . h)
        steepest = 4.0 * h.z / dot(h, h)
        return minimum(1.0, steepest * minimum(wi.z, wo.z)) / (wi.z * wo.z)


class Kelemen(Masking, name="kelemen"):
    """G / (cos_i cos_o) = 2 / (1 + wi . wo): close to the grooves', and cheap.

    References: Kelemen2001, AkenineMoller2008 (eq. 7.55).
    """

    def visibility(self, ndf: Any, wi: Vec, wo: Vec) -> Scalar:
        h = wi + wo
        return 4.0 / dot(h, h)


class Implicit(Masking, name="implicit"):
    """G = cos_i cos_o: no denominator at all, as in Blinn-Phong shading. Reference: AkenineMoller2008."""

    def visibility(self, ndf: Any, wi: Vec, wo: Vec) -> Scalar:
        return 1.0 + 0.0 * wi.z


class Neumann(Masking, name="neumann"):
    """G / (cos_i cos_o) = 1 / max(cos_i, cos_o). References: Neumann1999, AkenineMoller2008."""

    def visibility(self, ndf: Any, wi: Vec, wo: Vec) -> Scalar:
        return 1.0 / maximum(wi.z, wo.z)


class AshikhminShirley(Masking, name="ashikhmin-shirley"):
    """G / (cos_i cos_o) = 1 / ((wo . h) max(cos_i, cos_o)). References: Ashikhmin2000a, AkenineMoller2008."""

    def visibility(self, ndf: Any, wi: Vec, wo: Vec) -> Scalar:
        h = wi + wo
        return 2.0 / (sqrt(dot(h, h)) * maximum(wi.z, wo.z))


class AshikhminPremoze(Masking, name="ashikhmin-premoze"):
    """G / (cos_i cos_o) = 1 / (cos_i + cos_o - cos_i cos_o). References: Ashikhmin2007, AkenineMoller2008."""

    def visibility(self, ndf: Any, wi: Vec, wo: Vec) -> Scalar:
        return 1.0 / (wi.z + wo.z * (1.0 - wi.z))


class Ward(Masking, name="ward"):
    """G / (cos_i cos_o) = 1 / sqrt(cos_i cos_o). References: Ward1992, AkenineMoller2008."""

    breaks: ClassVar[dict[str, str]] = {
        "energy": "the reflectance grows without bound towards the horizon [AkenineMoller2008]"
    }

    def visibility(self, ndf: Any, wi: Vec, wo: Vec) -> Scalar:
        return 1.0 / sqrt(wi.z * wo.z)
