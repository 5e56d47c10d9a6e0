"""What all figures share: size, colours, titles, writing them to a file."""

from __future__ import annotations

import html
import io
import math
import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from ..container import replacing
from ..errors import ParameterError, UnknownFormatError
from ..reflectance import Reflectance

if TYPE_CHECKING:
    from matplotlib.figure import Figure, FigureBase

WIDTH = 6.0
"""Inches; at 100 dpi this is the page's 600 pixels."""

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00")
"""Distinct with any colour vision. Reference: Okabe2008."""

DASHES: tuple[Any, ...] = ("-", (0, (5, 1.5)), (0, (1, 1)), "-.", (0, (3, 1, 1, 1, 1, 1)), (0, (8, 3)))
"""Second key to the curves, for print without colour."""

LEGEND: dict[str, Any] = {"fontsize": 9, "title_fontsize": 9, "frameon": False}

Materials = Reflectance | Sequence[Reflectance]
"""One reflectance, or several to lay over each other."""


def several(given: Materials) -> list[Reflectance]:
    """The reflectances as a list. Raises ParameterError for none, or more than colours tell apart."""
    found = [given] if isinstance(given, Reflectance) else list(given)
    if not 1 <= len(found) <= len(COLOURS):
        raise ParameterError(f"a figure shows 1 to {len(COLOURS)} materials, got {len(found)}")
    return found


def figure_of(height: float, layout: Literal["constrained"] | None = "constrained") -> Figure:
    from matplotlib.figure import Figure

    return Figure((WIDTH, height), dpi=100, layout=layout)


def name_of(m: Any, longest: int = 60) -> str:
    name = m.name or type(m).__name__
    return name if len(name) <= longest else name[: longest - 1] + "…"


def names_of(given: Sequence[Any]) -> str:
    """All names on one line."""
    return " and ".join(name_of(m, 60 // len(given)) for m in given)


def titled(figure: FigureBase, text: str) -> None:
    figure.suptitle(text, fontsize=11, parse_math=False)


def log_range(values: Any, decades: int) -> tuple[float, int]:
    """log10 of an axis' upper end, just above the largest value, and of its lower end, a whole number."""
    positive = values[np.isfinite(values) & (values > 0)]
    if not positive.size:
        return 0.0, -2
    top = math.log10(positive.max()) + 0.1
    bottom = max(math.floor(math.log10(positive.min())), math.floor(top) - decades)
    return top, min(bottom, math.floor(top) - 2)


def degrees_axis(axes: Any, ticks: Sequence[int], label: str) -> None:
    """The horizontal axis as angles."""
    axes.set_xlim(ticks[0], ticks[-1])
    axes.set_xticks(ticks, [f"{t}°" for t in ticks])
    axes.set_xlabel(label)
    axes.tick_params(labelsize=9)
    axes.grid(alpha=0.35)


def save(figure: Figure, path: str | os.PathLike[str]) -> None:
    """Write a figure by the file's extension: .png, .svg, .pdf, …, or .html, one page that needs no other file.

    Raises UnknownFormatError.
    """
    target, kind = Path(path), figure_format(path)
    with replacing(target) as temporary:
        if kind == "html":
            temporary.write_text(_page(figure), "utf-8")
        else:
            _draw(figure, temporary, kind)


def figure_format(path: str | os.PathLike[str]) -> str:
    """The format of a figure's file, by its extension. Raises UnknownFormatError."""
    from matplotlib.backend_bases import FigureCanvasBase

    known = {*FigureCanvasBase.get_supported_filetypes(), "html"}
    kind = Path(path).suffix.lower()[1:]
    if kind not in known:
        raise UnknownFormatError(path, "figures are written as .png, .svg, .pdf or .html; choose one of them.")
    return kind


def _draw(figure: Figure, target: Any, kind: str) -> None:
    """The figure as a picture; vectors without a date and with the same names of their parts each time."""
    import matplotlib

    undated: dict[str, dict[str, Any]] = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}
    with matplotlib.rc_context({"svg.hashsalt": "brdf"}):
        figure.savefig(target, format=kind, metadata=undated.get(kind))


def _page(figure: Figure) -> str:
    """The figure as vectors in a page of its own."""
    drawn = io.StringIO()
    _draw(figure, drawn, "svg")
    picture = drawn.getvalue()
    title = html.escape(" ".join(figure.get_suptitle().split()))
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{title}</title><style>body{{margin:1rem;text-align:center}}"
        "svg{max-width:100%;height:auto}</style></head>\n"
        f"<body>\n{picture[picture.index('<svg') :]}</body></html>\n"
    )
