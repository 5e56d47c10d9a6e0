"""Tables that were tried: their errors against their bytes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ..errors import ParameterError
from ..representations.baking.budget import Candidate, Search, pareto
from .page import COLOURS, DASHES, LEGEND, figure_of, titled

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HEIGHT = 6.4

FAMILIES = {
    "identity": ("0.6", "v"), "uniform": (COLOURS[5], "s"), "bezier": (COLOURS[1], "D"), "half": (COLOURS[3], "<"),
    "stack": (COLOURS[4], "^"), "adaptive": (COLOURS[0], "o"),
}  # fmt: skip
"""Colour and marker of each kind of table."""

LABELS = ("relative RMS of f cos", "RMS of display values")


def candidates(searches: Search | Sequence[Search]) -> Figure:
    """Both errors against bytes: every table tried, the best of each kind joined, and the chosen ones ringed.

    Give the searches of one reflectance within several budgets to see how each kind grows; black is the frontier, the
    tables that no other beats in bytes and in both errors. Raises ParameterError for none.
    """
    given = [searches] if isinstance(searches, Search) else list(searches)
    if not given:
        raise ParameterError("at least one search is needed")
    figure = figure_of(HEIGHT)
    panels: Any = figure.subplots(2, 1, sharex=True)
    tried = [c for search in given for c in search.candidates]
    for k, axes in enumerate(panels):
        for number, (family, (colour, marker)) in enumerate(FAMILIES.items()):
            _draw_family(axes, given, family, k, colour, marker, DASHES[number % len(DASHES)])
        frontier = pareto(tried)
        axes.plot(*_points(frontier, k), ".", color="black", ms=3, zorder=4, label="frontier")
        axes.plot(*_points([s.candidates[0] for s in given], k), "o", mfc="none", mec="black", ms=11, label="chosen")
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_ylabel(LABELS[k])
        axes.grid(alpha=0.35)
    sizes = sorted({search.budget for search in given})
    panels[1].set_xticks(sizes, [f"{size / 1024:g} KB" for size in sizes], minor=False)
    panels[1].minorticks_off()
    panels[1].set_xlim(sizes[0] / 1.5, sizes[-1] * 1.5)
    panels[1].set_xlabel("bytes")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=4, **LEGEND)
    titled(figure, f"{given[0].material}\ntables within a budget")
    return figure


def _draw_family(
    axes: Any, searches: list[Search], family: str, error: int, colour: str, marker: str, dash: Any
) -> None:
    found = [[c for c in search.candidates if c.family == family] for search in searches]
    best = [min(some, key=lambda c: c.errors[error]) for some in found if some]
    best.sort(key=lambda c: c.nbytes)
    axes.plot(*_points([c for some in found for c in some], error), marker, color=colour, ms=3, alpha=0.35)
    axes.plot(*_points(best, error), marker=marker, color=colour, ls=dash, lw=1.5, ms=5, label=family)


def _points(some: Sequence[Candidate], error: int) -> tuple[list[int], list[float]]:
    return [c.nbytes for c in some], [c.errors[error] for c in some]
