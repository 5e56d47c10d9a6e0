"""Reflectances made of reflectances: sums, scaled ones, mixtures, two-sided ones, ones that vary in space."""

from __future__ import annotations

from .sums import Scaled, Sum, add, lobes, mix, scaled
from .two_sided import TwoSided
from .varying import SpatiallyVarying

__all__ = ["Scaled", "SpatiallyVarying", "Sum", "TwoSided", "add", "lobes", "mix", "scaled"]
