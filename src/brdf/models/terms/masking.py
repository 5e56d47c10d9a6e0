"""Masking and shadowing: the share G of facets that light and viewer both see.

Given as the visibility G / (cos_i cos_o) [1], which stays finite at the horizon where both G and the cosines vanish.
"""

from __future__ import annotations

from typing import Any

from ...formula import Scalar, Vec
from ...parameters import Parameterised


class Masking(Parameterised):
    """Base of the masking terms. Smith's are written with the projected area A(w) = cos (1 + Lambda(w)) of an NDF."""

    def visibility(self, ndf: Any, wi: Vec, wo: Vec) -> Scalar:
        raise NotImplementedError


class SmithCorrelated(Masking):
    """Smith's masking with heights correlated: G = 1 / (1 + Lambda(wi) + Lambda(wo)). Reference: Heitz2014."""

    def visibility(self, ndf: Any, wi: Vec, wo: Vec) -> Scalar:
        return 1.0 / (ndf.projected_area(wi) * wo.z + wi.z * (ndf.projected_area(wo) - wo.z))


class SmithSeparable(Masking):
    """Smith's masking, heights independent: G = G1(wi) G1(wo). References: Smith1967, Walter2007."""

    def visibility(self, ndf: Any, wi: Vec, wo: Vec) -> Scalar:
        return 1.0 / (ndf.projected_area(wi) * ndf.projected_area(wo))
