"""What a run found: figures, tables with the document's numbers beside ours, and claims with their verdict."""

from __future__ import annotations

import dataclasses
import json
import math
import os
import platform
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from .. import __version__
from ..container import replacing
from ..threads import cores

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Chart

RESULTS = "results.json"

LONG = 40
"""Rows from which a table is folded on the page and left out on a terminal."""

Cell = str | float | int | None


@dataclass(frozen=True)
class Panel:
    """One picture of a figure: `pixels` (H, W, 3 or 4) 8-bit sRGB, and the words below it."""

    pixels: NDArray[np.uint8]
    label: str = ""


@dataclass(frozen=True)
class Column:
    """A column of a table: `unit` ("" for names, "1" for plain numbers), `form` as in format(), `whose` numbers."""

    title: str
    unit: str = ""
    form: str = ""
    whose: Literal["", "paper", "ours"] = ""

    def text(self, cell: Cell) -> str:
        """A cell as it is printed; a dash where there is no number."""
        if cell is None:
            return "–"
        if isinstance(cell, str):
            return cell
        return "exact" if cell == math.inf else format(cell, self.form)


@dataclass(frozen=True)
class Figure:
    """Rows of panels, or a chart."""

    name: str
    caption: str
    rows: Sequence[tuple[str, Sequence[Panel]]] = ()
    chart: Chart | None = None

    def files(self) -> list[str]:
        """The names of its files."""
        if self.chart is not None:
            return [f"{self.name}.svg", f"{self.name}.png"]
        return [file for row in self.panel_files() for file in row]

    def panel_files(self) -> list[list[str]]:
        """The file of each panel, row by row: NAME.png for a single one, else NAME-1.png …"""
        counts = [len(panels) for _, panels in self.rows]
        if sum(counts) == 1:
            return [[f"{self.name}.png"]]
        starts = np.concatenate([[0], np.cumsum(counts)])
        return [
            [f"{self.name}-{start + i + 1}.png" for i in range(n)] for start, n in zip(starts, counts, strict=False)
        ]


@dataclass(frozen=True)
class Table:
    """Rows of cells under columns; `how` the numbers were measured, `verdict`: what they say, made from them."""

    name: str
    caption: str
    columns: Sequence[Column]
    rows: Sequence[Sequence[Cell]]
    how: str = ""
    verdict: str = ""

    @property
    def is_long(self) -> bool:
        """Whether it is better looked up than read."""
        return len(self.rows) > LONG

    def headings(self) -> list[list[str]]:
        """Of each column the title, whose numbers they are where there are both kinds, and the unit if it has one."""
        both = any(column.whose == "paper" for column in self.columns)
        parts = [(c.title, c.whose if both else "", c.unit if c.unit != "1" else "") for c in self.columns]
        return [[part for part in column if part] for column in parts]

    def flat_headings(self) -> list[str]:
        """The headings on one line each."""
        return [", ".join(parts) for parts in self.headings()]

    def numeric(self) -> list[bool]:
        """Of each column whether it has numbers."""
        return [all(not isinstance(cell, str) for cell in column) for column in zip(*self.rows, strict=True)]

    def texts(self) -> list[list[str]]:
        """The cells as they are printed."""
        return [[column.text(cell) for column, cell in zip(self.columns, row, strict=True)] for row in self.rows]


@dataclass(frozen=True)
class Claim:
    """What the document says, and what was measured: sentences with numbers, each with whether it bears the claim."""

    statement: str
    checks: Mapping[str, bool]

    @property
    def verdict(self) -> str:
        """ "holds", "holds in part" or "does not hold"."""
        held = sum(self.checks.values())
        return "holds" if held == len(self.checks) else "holds in part" if held else "does not hold"


@dataclass(frozen=True)
class Section:
    """A heading, a sentence or two, and what stands below it."""

    title: str
    text: str = ""
    items: list[Figure | Table | Claim] = field(default_factory=list)


class Report:
    """Collects results in the order in which they are to be read."""

    def __init__(self, name: str, title: str, source: str, settings: Any = None) -> None:
        self.name, self.title, self.source = name, title, source
        self.settings = dataclasses.asdict(settings) if dataclasses.is_dataclass(settings) else settings  # type: ignore[arg-type]
        self.sections: list[Section] = []
        self.folder: Path | None = None
        """Where it was written."""

    def section(self, title: str, text: str = "") -> None:
        """What follows stands under this heading."""
        self.sections.append(Section(title, text))

    def figure(self, name: str, caption: str, content: Chart | Mapping[str, Sequence[Panel]] | Panel) -> None:
        """A chart, one panel, or rows of panels by the words beside the row."""
        if isinstance(content, Panel):
            content = {"": [content]}
        if isinstance(content, Mapping):
            self.sections[-1].items.append(Figure(name, caption, list(content.items())))
        else:
            self.sections[-1].items.append(Figure(name, caption, chart=content))

    def table(
        self, name: str, caption: str, columns: Sequence[Column | str], rows: Sequence[Sequence[Cell]], how: str = "",
        verdict: str = "",
    ) -> None:  # fmt: skip
        """A table; see `Table`. A column of names is given by its title alone."""
        made = [Column(column) if isinstance(column, str) else column for column in columns]
        self.sections[-1].items.append(Table(name, caption, made, rows, how, verdict))

    def claim(self, statement: str, checks: Mapping[str, bool]) -> None:
        """A claim of the document; see `Claim`."""
        self.sections[-1].items.append(Claim(statement, {text: bool(held) for text, held in checks.items()}))

    @property
    def tables(self) -> list[Table]:
        return [item for section in self.sections for item in section.items if isinstance(item, Table)]

    @property
    def claims(self) -> list[Claim]:
        return [item for section in self.sections for item in section.items if isinstance(item, Claim)]

    @property
    def figures(self) -> list[Figure]:
        return [item for section in self.sections for item in section.items if isinstance(item, Figure)]

    def results(self) -> dict[str, Any]:
        """Everything but the pictures, as plain data: what `results.json` holds."""
        return {
            "document": self.name,
            "title": self.title,
            "source": self.source,
            "brdf": __version__,
            "machine": machine(),
            "settings": _plain(self.settings),
            "tables": {
                table.name: {
                    "caption": table.caption,
                    "how": table.how,
                    "verdict": table.verdict,
                    "columns": [{"title": c.title, "unit": c.unit, "whose": c.whose} for c in table.columns],
                    "rows": _plain(table.rows),
                }
                for table in self.tables
            },
            "claims": [
                {"statement": claim.statement, "verdict": claim.verdict, "checks": dict(claim.checks)}
                for claim in self.claims
            ],
            "figures": [{"files": figure.files(), "caption": figure.caption} for figure in self.figures],
        }

    def write(self, folder: str | os.PathLike[str]) -> None:
        """The figures, `results.json`, `results.md` and `index.html`, into an existing folder."""
        from .page import page
        from .pictures import write_figure
        from .text import markdown

        for figure in self.figures:
            write_figure(figure, Path(folder))
        texts = {
            RESULTS: json.dumps(self.results(), indent=1, ensure_ascii=False, allow_nan=False) + "\n",
            "results.md": markdown(self),
            "index.html": page(self),
        }
        for name, text in texts.items():
            with replacing(Path(folder) / name) as temporary:
                temporary.write_text(text, "utf-8")


def machine() -> dict[str, Any]:
    """What timings depend on."""
    return {"cores": cores(), "processor": platform.machine(), "system": platform.system()}


def _plain(data: Any) -> Any:
    """Lists and numbers for JSON, which has no infinity: where two agree exactly, "exact"."""
    if isinstance(data, Mapping):
        return {str(key): _plain(value) for key, value in data.items()}
    if isinstance(data, (list, tuple)):
        return [_plain(value) for value in data]
    if isinstance(data, np.generic):
        return _plain(data.item())
    return "exact" if data == math.inf else data
