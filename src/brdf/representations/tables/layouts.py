"""Table layouts by name: the tables of the literature, at any resolution.

The published modes are `named_layout("normal", "identity" | "uniform" | "bezier", n)` with N x N x 2N nodes and, for
"bezier", an alpha for the polar angles and one for the azimuth; "half" with "bezier" is the layout that serves best at
equal size. Reference: Mallett2016.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from ...errors import ParameterError, UnknownNameError
from ...geometry.warps import Bezier, Chord, Circle, TwoSided, Warp, identity, square_root, uniform
from .anisotropic import AnisotropicHalfBasis, AnisotropicNormalBasis
from .bases import Basis, HalfBasis, NormalBasis
from .encoding import Encoding, Log, Plain, Root
from .layout import Layout
from .triangle_bases import MarschnerBasis, ShearedBasis, StarkBasis

PI = math.pi

Alpha = tuple[float, float]
"""Of a Bezier warp: over the polar angles (theta_d alone in the half basis), and over the azimuth."""

Warps = Callable[[Alpha], tuple[Warp, ...]]

HALF_WARPS: dict[str, Warps] = {
    "uniform": lambda alpha: (uniform(), uniform(), uniform()),
    "merl": lambda alpha: (square_root(), uniform(), uniform()),
    "bezier": lambda alpha: (Chord(), Bezier(alpha=alpha[0]), Bezier(alpha=alpha[1])),
}
"""Warps of (theta_h, theta_d, phi_d), phi_d folded to a quarter turn."""

NORMAL_WARPS: dict[str, Warps] = {
    "identity": lambda alpha: (identity(), identity(), identity(PI)),
    "uniform": lambda alpha: (uniform(), uniform(), uniform(PI)),
    "bezier": lambda alpha: (Bezier(alpha=alpha[0]), Bezier(alpha=alpha[0]), Bezier(PI, alpha[1])),
}
"""Warps of two polar angles and an azimuth."""

STARK_WARPS: dict[str, Warps] = {
    "uniform": HALF_WARPS["uniform"],
    "bezier": HALF_WARPS["bezier"],
}
"""Warps of (theta_h, theta_d, psi)."""

ANISOTROPIC_HALF_WARPS: dict[str, Warps] = {
    "uniform": lambda alpha: (Circle(), uniform(), uniform(), uniform(PI)),
    "merl": lambda alpha: (Circle(), square_root(), uniform(), uniform(PI)),
    "bezier": lambda alpha: (Circle(), Chord(), Bezier(alpha=alpha[0]), Bezier(PI, alpha[1])),
}
"""Warps of (phi_h, theta_h, theta_d, phi_d), phi_d folded to half a turn."""


def _around(warps: Warps) -> Warps:
    def made(alpha: Alpha) -> tuple[Warp, ...]:
        first, second, third = warps(alpha)
        return Circle(), first, second, TwoSided(half=third)

    return made


ANISOTROPIC_NORMAL_WARPS = {name: _around(warps) for name, warps in NORMAL_WARPS.items()}
"""Warps of (phi_i, theta_i, theta_o, phi_delta), phi_delta around the whole circle."""

ENCODINGS: dict[str, Encoding] = {
    "f": Encoding(Plain()),
    "sqrt": Encoding(Root(2)),
    "cube-root": Encoding(Root(3)),
    "log": Encoding(Log(1e-3)),
}
"""What is stored in place of f. Cosines are left out: to divide by small ones multiplies errors."""

BASES: dict[str, tuple[Basis, dict[str, Warps], Encoding]] = {
    "half": (HalfBasis("quarter-turn"), HALF_WARPS, ENCODINGS["log"]),
    "normal": (NormalBasis(), NORMAL_WARPS, ENCODINGS["f"]),
    "sheared": (ShearedBasis(), NORMAL_WARPS, ENCODINGS["log"]),
    "marschner": (MarschnerBasis(), NORMAL_WARPS, ENCODINGS["f"]),
    "stark": (StarkBasis(), STARK_WARPS, ENCODINGS["log"]),
}
"""What a table of three axes may be made of."""

ANISOTROPIC_BASES: dict[str, tuple[Basis, dict[str, Warps], Encoding]] = {
    "half": (AnisotropicHalfBasis("half-turn"), ANISOTROPIC_HALF_WARPS, ENCODINGS["log"]),
    "normal": (AnisotropicNormalBasis(), ANISOTROPIC_NORMAL_WARPS, ENCODINGS["f"]),
}
"""What a table of four axes may be made of."""

ALPHAS: dict[str, Alpha] = {"half": (0.65, 0.75), "stark": (0.65, 0.75)}
"""The alphas that serve most reflectances best, where they differ from those of the normal basis."""

NORMAL_ALPHAS: Alpha = (0.65, 0.2)


def shape_of(basis: str, n: int, isotropic: bool = True) -> tuple[int, ...]:
    """The preset of 2 N^3 nodes: N x N x 2N, or 2N x 2N x N / 2 over half vectors; 2N azimuths before, anisotropic."""
    if n < 4:
        raise ParameterError(f"a table's resolution must be at least 4, got {n}")
    sizes = (2 * n, 2 * n, n // 2) if basis in ("half", "stark") else (n, n, 2 * n)
    return sizes if isotropic else (2 * n, *sizes)


def named_layout(
    basis: str,
    warp: str,
    shape: tuple[int, ...],
    storage: str = "half",
    filter: str = "linear",
    alpha: Alpha | None = None,
    encoding: str | None = None,
) -> Layout:
    """The layout of `Table.bake`'s names, anisotropic for a shape of four axes.

    Raises UnknownNameError, ParameterError for an alpha outside [0, 1], ReflectanceError for an impossible shape.
    """
    bases = ANISOTROPIC_BASES if len(shape) == 4 else BASES
    if basis not in bases:
        raise UnknownNameError("table basis", basis, bases)
    chosen, warps, usual = bases[basis]
    if warp not in warps:
        raise UnknownNameError(f"warp of the {basis} basis", warp, warps)
    if encoding is not None and encoding not in ENCODINGS:
        raise UnknownNameError("table encoding", encoding, ENCODINGS)
    if alpha is not None and warp != "bezier":
        raise ParameterError(f"alpha belongs to the 'bezier' warp and has no effect with {warp!r}")
    made = warps[warp](alpha or ALPHAS.get(basis, NORMAL_ALPHAS))
    return Layout(chosen, made, tuple(shape), usual if encoding is None else ENCODINGS[encoding], storage, filter)
