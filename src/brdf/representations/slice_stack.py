"""The theta_d slice stack: an isotropic reflectance in 16 KB.

For one light a sphere seen from afar shows a single theta_d: a table over (theta_h, theta_d, phi_d) is a stack of such
pictures. With the diffuse floor and the growth towards grazing angles taken out, logarithms stored, theta_h warped by
a square root and phi_d folded to a quarter turn, 8 slices of 64 x 8 texels of 4 bytes do.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from ..errors import UnknownNameError
from ..geometry.warps import FarPower, square_root, uniform
from ..reflectance import Reflectance
from .bake import bake_least_squares, bake_points
from .bases import HalfBasis
from .encoding import Encoding, Log
from .layout import Layout
from .table import Table

BUDGETS: dict[str, tuple[int, int, int]] = {"16K": (64, 8, 8), "64K": (96, 12, 14), "256K": (256, 16, 16)}
"""Nodes over theta_h, theta_d, phi_d for so many bytes at 4 bytes a node."""

LAST_ANGLE = {8: 172.0, 12: 174.0, 16: 176.0}
"""The angle between light and viewer of the last slice [degrees], by the number of slices."""

MEASURED_FLOOR = 0.02
"""The quantile of measured values that counts as the diffuse floor: their minimum is noise."""

METHODS: dict[str, Callable[..., Table]] = {"least-squares": bake_least_squares, "points": bake_points}


class SliceStack:
    """Makes tables of one preset; `SliceStack.bake(m)` returns a `Table`."""

    @staticmethod
    def layout(budget: str = "16K") -> Layout:
        """The preset for a budget: "16K", "64K" or "256K". Raises UnknownNameError."""
        if budget not in BUDGETS:
            raise UnknownNameError("slice stack budget", budget, BUDGETS)
        shape = BUDGETS[budget]
        slices = FarPower(math.radians(LAST_ANGLE[shape[1]]) / 2, exponent=1.3)
        return Layout(
            HalfBasis("quarter-turn"),
            (square_root(), slices, uniform()),
            shape,
            Encoding(Log(1e-3), cosine_power=1.5, scale=math.pi),
            "10-10-10",
        )

    @staticmethod
    def bake(m: Reflectance, budget: str = "16K", method: str = "least-squares") -> Table:
        """`m` as a slice stack of 16, 64 or 256 KB.

        `method` is "least-squares" (the slices fit what lies between them) or "points" (evaluation at the nodes; some
        3 dB less). Of measured values the floor is a low quantile, and directions that the folds join are averaged.
        Raises ReflectanceError when `m` is anisotropic, UnknownNameError for an unknown budget or method.
        """
        if method not in METHODS:
            raise UnknownNameError("bake method", method, METHODS)
        measured = is_measured(m)
        floor_quantile = MEASURED_FLOOR if measured else 0.0
        return METHODS[method](m, SliceStack.layout(budget), floor_quantile, symmetrise=measured)


def is_measured(m: Reflectance) -> bool:
    """Whether the values carry the noise and the asymmetry of a measurement: tables with holes, and what needs a search
    to be evaluated."""
    return not m.has_formula or (isinstance(m, Table) and m.has_holes)
