"""Table layouts by name: the tables of the literature, at any resolution."""

from __future__ import annotations

import math
from collections.abc import Callable

from ..errors import UnknownNameError
from ..geometry.warps import Bezier, Warp, square_root, uniform
from .bases import Basis, HalfBasis, NormalBasis
from .encoding import Encoding, Log
from .table import Layout

Warps = Callable[[], tuple[Warp, Warp, Warp]]

HALF_WARPS: dict[str, Warps] = {
    "uniform": lambda: (uniform(), uniform(), uniform()),
    "merl": lambda: (square_root(), uniform(), uniform()),
    "bezier": lambda: (square_root(), Bezier(alpha=0.65), Bezier(alpha=0.75)),
}
"""Warps of (theta_h, theta_d, phi_d), phi_d folded to a quarter turn."""

NORMAL_WARPS: dict[str, Warps] = {
    "identity": lambda: (Bezier(alpha=1.0), Bezier(alpha=1.0), Bezier(math.pi, 1.0)),
    "uniform": lambda: (uniform(), uniform(), uniform(math.pi)),
    "bezier": lambda: (Bezier(alpha=0.65), Bezier(alpha=0.65), Bezier(math.pi, 0.2)),
}
"""Warps of (theta_i, theta_o, phi_delta)."""

BASES: dict[str, tuple[Basis, dict[str, Warps], Encoding]] = {
    "half": (HalfBasis("quarter-turn"), HALF_WARPS, Encoding(Log(1e-3))),
    "normal": (NormalBasis(), NORMAL_WARPS, Encoding()),
}


def named_layout(basis: str, warp: str, shape: tuple[int, int, int], storage: str) -> Layout:
    """The layout of `Table.bake`'s names. Raises UnknownNameError, ReflectanceError for an impossible shape."""
    if basis not in BASES:
        raise UnknownNameError("table basis", basis, BASES)
    chosen, warps, encoding = BASES[basis]
    if warp not in warps:
        raise UnknownNameError(f"warp of the {basis} basis", warp, warps)
    return Layout(chosen, warps[warp](), tuple(shape), encoding, storage)
