"""Table layouts by name: the tables of the literature, at any resolution."""

from __future__ import annotations

import math
from collections.abc import Callable

from ..errors import UnknownNameError
from ..geometry.warps import Bezier, Circle, TwoSided, Warp, square_root, uniform
from .anisotropic import AnisotropicHalfBasis, AnisotropicNormalBasis
from .bases import Basis, HalfBasis, NormalBasis
from .encoding import Encoding, Log
from .layout import Layout

PI = math.pi

Warps = Callable[[], tuple[Warp, ...]]

HALF_WARPS: dict[str, Warps] = {
    "uniform": lambda: (uniform(), uniform(), uniform()),
    "merl": lambda: (square_root(), uniform(), uniform()),
    "bezier": lambda: (square_root(), Bezier(alpha=0.65), Bezier(alpha=0.75)),
}
"""Warps of (theta_h, theta_d, phi_d), phi_d folded to a quarter turn."""

NORMAL_WARPS: dict[str, Warps] = {
    "identity": lambda: (Bezier(alpha=1.0), Bezier(alpha=1.0), Bezier(PI, 1.0)),
    "uniform": lambda: (uniform(), uniform(), uniform(PI)),
    "bezier": lambda: (Bezier(alpha=0.65), Bezier(alpha=0.65), Bezier(PI, 0.2)),
}
"""Warps of (theta_i, theta_o, phi_delta)."""

ANISOTROPIC_HALF_WARPS: dict[str, Warps] = {
    "uniform": lambda: (Circle(), uniform(), uniform(), uniform(PI)),
    "merl": lambda: (Circle(), square_root(), uniform(), uniform(PI)),
    "bezier": lambda: (Circle(), square_root(), Bezier(alpha=0.65), Bezier(PI, 0.75)),
}
"""Warps of (phi_h, theta_h, theta_d, phi_d), phi_d folded to half a turn."""

ANISOTROPIC_NORMAL_WARPS: dict[str, Warps] = {
    name: lambda warps=warps: (Circle(), *warps()[:2], TwoSided(half=warps()[2]))  # type: ignore[misc]
    for name, warps in NORMAL_WARPS.items()
}
"""Warps of (phi_i, theta_i, theta_o, phi_delta), phi_delta around the whole circle."""

BASES: dict[str, tuple[Basis, dict[str, Warps], Encoding]] = {
    "half": (HalfBasis("quarter-turn"), HALF_WARPS, Encoding(Log(1e-3))),
    "normal": (NormalBasis(), NORMAL_WARPS, Encoding()),
}
"""What a table of three axes may be made of."""

ANISOTROPIC_BASES: dict[str, tuple[Basis, dict[str, Warps], Encoding]] = {
    "half": (AnisotropicHalfBasis("half-turn"), ANISOTROPIC_HALF_WARPS, Encoding(Log(1e-3))),
    "normal": (AnisotropicNormalBasis(), ANISOTROPIC_NORMAL_WARPS, Encoding()),
}
"""What a table of four axes may be made of."""


def named_layout(basis: str, warp: str, shape: tuple[int, ...], storage: str) -> Layout:
    """The layout of `Table.bake`'s names, anisotropic for a shape of four axes.

    Raises UnknownNameError, ReflectanceError for an impossible shape.
    """
    bases = ANISOTROPIC_BASES if len(shape) == 4 else BASES
    if basis not in bases:
        raise UnknownNameError("table basis", basis, bases)
    chosen, warps, encoding = bases[basis]
    if warp not in warps:
        raise UnknownNameError(f"warp of the {basis} basis", warp, warps)
    return Layout(chosen, warps[warp](), tuple(shape), encoding, storage)
