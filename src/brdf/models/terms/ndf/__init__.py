"""Normal distribution functions: how much microsurface faces which way. One family a file; each registers itself."""

from __future__ import annotations

from .closed_form import GGX, Beckmann
from .distribution import DISTRIBUTIONS, Distribution
from .integrated import ABC, GTR, SGD, BlinnPhong, Gaussian, StudentT
from .painted import PaintedCurve, PaintedMap

__all__ = [
    "ABC",
    "DISTRIBUTIONS",
    "GGX",
    "GTR",
    "SGD",
    "Beckmann",
    "BlinnPhong",
    "Distribution",
    "Gaussian",
    "PaintedCurve",
    "PaintedMap",
    "StudentT",
]
