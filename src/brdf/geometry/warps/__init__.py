"""Axis parameterisations: where the nodes of a table's axis lie."""

from .base import HALF_PI, Angle, Warp, warp_from
from .bezier import Bezier, identity
from .circle import Circle, TwoSided
from .listed import Listed, listed
from .powers import Chord, FarPower, Power, square_root, uniform
from .spline import Spline
from .squared_sine import SquaredSine

__all__ = [
    "HALF_PI", "Angle", "Bezier", "Chord", "Circle", "FarPower", "Listed", "Power", "Spline", "SquaredSine",
    "TwoSided", "Warp", "identity", "listed", "square_root", "uniform", "warp_from",
]  # fmt: skip
