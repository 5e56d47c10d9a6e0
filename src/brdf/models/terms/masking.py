"""Masking and shadowing: the share of facets that light and viewer both see, `G(ndf, wi, wo)`."""

from __future__ import annotations

from typing import Any

from ...formula import Scalar, Vec
from ...parameters import Parameterised


class Masking(Parameterised):
    """Base of the masking terms."""

    def G(self, ndf: Any, wi: Vec, wo: Vec) -> Scalar:
        raise NotImplementedError


class SmithCorrelated(Masking):
    """Smith's masking with heights correlated: G = 1 / (1 + Lambda(wi) + Lambda(wo)). Reference: Heitz2014."""

    def G(self, ndf: Any, wi: Vec, wo: Vec) -> Scalar:
        return 1.0 / (1.0 + ndf.Lambda(wi) + ndf.Lambda(wo))


class SmithSeparable(Masking):
    """Smith's masking, heights independent: G = G1(wi) G1(wo). References: Smith1967, Walter2007."""

    def G(self, ndf: Any, wi: Vec, wo: Vec) -> Scalar:
        return 1.0 / ((1.0 + ndf.Lambda(wi)) * (1.0 + ndf.Lambda(wo)))
