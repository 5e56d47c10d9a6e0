"""Reflectances made of reflectances: sums, scaled, turned, two-sided ones, mixtures, ones that vary in space."""

from __future__ import annotations

from .rearranged import QuarterTurned, Transposed
from .sums import Scaled, Sum, add, lobes, mix, scaled
from .two_sided import TwoSided
from .varying import SpatiallyVarying

__all__ = [
    "QuarterTurned",
    "Scaled",
    "SpatiallyVarying",
    "Sum",
    "Transposed",
    "TwoSided",
    "add",
    "lobes",
    "mix",
    "scaled",
]
