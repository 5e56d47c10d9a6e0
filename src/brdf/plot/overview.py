"""Several figures of a material, or of several, on one page."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import curves, maps, polar
from .page import Materials, figure_of, name_of, names_of, several, titled

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def overview(m: Materials) -> Figure:
    """Lobes, slices and albedo on one page; of several materials lobes, the same over a straight axis, and albedo."""
    given = several(m)
    heights = (polar.height_for(given), maps.HEIGHT, curves.HEIGHT)
    page = figure_of(sum(heights))
    page.suptitle(name_of(given[0]) if len(given) == 1 else names_of(given), fontsize=12, parse_math=False)
    parts: Any = page.subfigures(3, 1, height_ratios=heights)
    first, second, third = parts
    titled(first, polar.draw_lobes(first, given, heights[0]))
    titled(second, maps.draw_slices(second, given[0]) if len(given) == 1 else polar.draw_cartesian(second, given))
    titled(third, curves.draw_albedo(third, given))
    return page
