"""Tables of every basis made into tables of every other, at twice the resolution."""

from __future__ import annotations

from typing import NamedTuple

from ....loading import load
from ....metrics.importance import ErrorsAgainst, importance_pairs
from ....representations.baking.bake import bake_points
from ....representations.tables.layout import Layout
from ....representations.tables.layouts import BASES, named_layout, shape_of
from ....representations.tables.table import Table
from ...report import Cell, Column, Report
from .measuring import SEED
from .settings import Settings

MATERIAL = "Lambertian:albedo=.3/.2/.1 + GGX:alpha=.3,F0=.04"


class Conversion(NamedTuple):
    """Relative RMS errors of f cos."""

    source: float
    """of the source from the reflectance: its interpolation error"""
    converting: float
    """of what it was converted to from the source"""
    direct: float
    """of a table like the converted one, baked from the reflectance itself"""
    total: float
    """of what it was converted to from the reflectance"""


def layout_of(basis: str, n: int) -> Layout:
    """The layouts that are converted: f itself, or the basis's own encoding, as floats."""
    return named_layout(basis, "bezier", shape_of(basis, n), "float32")


def conversions(text: str, n: int, pairs: int = 16384) -> dict[tuple[str, str], Conversion]:
    """From every basis at N to every one at 2 N, by both names."""
    m = load(text)
    at = importance_pairs(pairs, SEED)
    against = ErrorsAgainst(m, at)
    found = {}
    direct = {basis: against(bake_points(m, layout_of(basis, 2 * n))).relative_rms for basis in BASES}
    for source in BASES:
        table: Table = bake_points(m, layout_of(source, n))
        own = ErrorsAgainst(table, at)
        for target in BASES:
            made = bake_points(table, layout_of(target, 2 * n))
            found[source, target] = Conversion(
                against(table).relative_rms, own(made).relative_rms, direct[target], against(made).relative_rms
            )
    return found


def present(report: Report, settings: Settings) -> dict[tuple[str, str], Conversion]:
    """The table of conversions, which it returns."""
    n = settings.converted
    found = conversions(MATERIAL, n, settings.pairs)
    rows: list[list[Cell]] = [
        [source, 100 * found[source, source].source, *(100 * found[source, target].converting for target in BASES)]
        for source in BASES
    ]
    rows.append(["from the reflectance itself", None, *(100 * found[target, target].direct for target in BASES)])
    within = [key for key, c in found.items() if c.converting <= c.source]
    others = [key for key in found if key not in within]
    coarse = [key for key in others if found[key].direct > found[key].source]
    report.table(
        "conversion",
        "Conversion between bases at twice the resolution",
        ["from", Column("the source's own error", "%", ".2f", "ours"),
         *(Column(f"to {basis}", "%", ".2f", "ours") for basis in BASES)],
        rows,
        f"Relative RMS of f cos between the table converted to and its source, {MATERIAL}; N = {n} to {2 * n}, Bézier "
        "warps, linear, 32-bit floats, at the nodes. The last row: tables of the second size baked directly.",
        f"{len(within)} of {len(found)} conversions change the table by no more than its linear interpolation had "
        f"already changed the reflectance, among them all {len(BASES)} within a basis. Of the other {len(others)} "
        f"{len(coarse)} lead into a basis whose table of twice the resolution, baked directly, is worse than the "
        "source."
    )  # fmt: skip
    return found
