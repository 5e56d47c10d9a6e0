"""Curves, drawn alike in every document: for a column of 400 pixels, in the colours of the text around them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ..plot.page import COLOURS, DASHES
from .pictures import INK

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SIZE = (4.4, 3.5)
"""Inches: with letters of 9 points it stays legible in a column of a telephone's width."""
LEGEND_ROW = 0.17
"""Inches a row of the legend is high."""
LONGEST_OF_TWO = 30
"""Letters of a name beside which another has room."""

Curve = tuple[Sequence[float], Sequence[float]]


def curves(
    series: Mapping[str, Curve], x_label: str, y_label: str, x_ticks: Mapping[float, str] | None = None,
    x_scale: str = "linear", y_scale: str = "linear", marker: str = "o",
) -> Figure:  # fmt: skip
    """Curves by name, each (x, y); `x_ticks`: the words at places of the horizontal axis; `marker` "" for none."""
    import matplotlib
    from matplotlib.figure import Figure

    style: Any = dict.fromkeys(("text.color", "axes.edgecolor", "axes.labelcolor"), INK)
    with matplotlib.rc_context(style | {"font.size": 9, "axes.linewidth": 0.6}):
        columns = 2 if max(map(len, series)) <= LONGEST_OF_TWO else 1
        further = 0.0 if columns == 2 else len(series) / 2 * LEGEND_ROW
        figure = Figure((SIZE[0], SIZE[1] + further), dpi=100, layout="constrained")
        axes: Any = figure.add_subplot()
        for number, (name, (x, y)) in enumerate(series.items()):
            colour = (*COLOURS, "#7F7F7F")[number % (len(COLOURS) + 1)]
            axes.plot(
                x, y, color=colour, ls=DASHES[number % len(DASHES)], lw=1.6, marker=marker, markersize=3.5, label=name
            )
        axes.set(xscale=x_scale, yscale=y_scale, xlabel=x_label, ylabel=y_label)
        if x_ticks is not None:
            axes.set_xticks(list(x_ticks), list(x_ticks.values()))
            axes.minorticks_off()
        axes.tick_params(which="both", color=INK, labelcolor=INK)
        axes.spines[["top", "right"]].set_visible(False)
        axes.grid(alpha=0.25, color=INK, lw=0.5)
        figure.legend(loc="outside lower center", ncols=columns, frameon=False, fontsize=9)
    return figure
