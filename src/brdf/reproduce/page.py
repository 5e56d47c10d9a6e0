"""A report as one page that needs no other file: pictures and charts are in it."""

from __future__ import annotations

import base64
import re
from collections.abc import Callable, Iterable
from html import escape
from importlib import resources
from string import Template
from typing import Any

from .pictures import INK, png, svg
from .report import Claim, Figure, Panel, Report, Table
from .text import setting

SIGNS = {"holds": "✓", "holds in part": "◐", "does not hold": "✗"}

TYPEFACE = "system-ui, sans-serif"


def page(report: Report) -> str:
    """The page as HTML."""
    template = Template(resources.files(__package__).joinpath("page.html").read_text("utf-8"))
    sections, contents = [], []
    for number, section in enumerate(report.sections):
        title, text = escape(section.title), f"<p>{escape(section.text)}</p>" if section.text else ""
        items = "".join(_HTML[type(item)](item) for item in section.items)
        contents.append(f'<li><a href="#s{number}">{title}</a></li>')
        sections.append(f'<section id="s{number}"><h2>{title}</h2>{text}{items}</section>\n')
    return template.substitute(
        title=escape(report.title), source=escape(report.source), setting=escape(setting(report)),
        typeface=TYPEFACE, contents="".join(contents), summary=_summary(report), sections="".join(sections),
    )  # fmt: skip


def _summary(report: Report) -> str:
    """The claims, one a line, with their verdicts."""
    lines = (
        f'<li class="{_kind(claim)}">{_verdict(claim)} “{escape(claim.statement)}”</li>' for claim in report.claims
    )
    return f'<ul class="summary">{"".join(lines)}</ul>' if report.claims else ""


def _kind(claim: Claim) -> str:
    return claim.verdict.replace(" ", "-")


def _verdict(claim: Claim) -> str:
    return f"<b>{SIGNS[claim.verdict]} {claim.verdict}</b>"


def _claim(claim: Claim) -> str:
    checks = "".join(f"<li>{'✓' if held else '✗'} {escape(text)}</li>" for text, held in claim.checks.items())
    statement = f"<p>“{escape(claim.statement)}” {_verdict(claim)}</p>"
    return f'<div class="claim {_kind(claim)}">{statement}<ul>{checks}</ul></div>'


def _table(table: Table) -> str:
    kinds = [
        " ".join(filter(None, ["number" if numeric else "", column.whose]))
        for numeric, column in zip(table.numeric(), table.columns, strict=True)
    ]
    headings = [escape(title) + "".join(map(_small, parts)) for title, *parts in table.headings()]
    head = _row("th", kinds, headings, ' scope="col"')
    rows = "".join(_row("td", kinds, map(escape, row)) for row in table.texts())
    cells = f'<div class="scroll" tabindex="0"><table><thead>{head}</thead><tbody>{rows}</tbody></table></div>'
    if table.is_long:
        cells = f"<details><summary>{len(table.rows)} rows</summary>{cells}</details>"
    how = f" <span>{escape(table.how)}</span>" if table.how else ""
    verdict = f'<p class="verdict">{escape(table.verdict)}</p>' if table.verdict else ""
    return f'<div class="table"><p class="caption">{escape(table.caption)}{how}</p>{cells}{verdict}</div>'


def _row(tag: str, kinds: Iterable[str], cells: Iterable[str], attributes: str = "") -> str:
    marked = zip(kinds, cells, strict=True)
    return f"<tr>{''.join(f'<{tag}{attributes} class={kind!r}>{cell}</{tag}>' for kind, cell in marked)}</tr>"


def _small(text: str) -> str:
    return f"<small>{escape(text)}</small>"


def _figure(figure: Figure) -> str:
    caption = f"<figcaption>{escape(figure.caption)}</figcaption>"
    if figure.chart is not None:
        return f'<figure class="chart">{_chart(svg(figure.chart), figure.caption)}{caption}</figure>'
    widest = max(len(panels) for _, panels in figure.rows)
    rows = []
    for title, panels in figure.rows:
        heading = f"<h3>{escape(title)}</h3>" if title else ""
        pictures = "".join(_panel(panel, title or figure.caption) for panel in panels)
        rows.append(f'{heading}<div class="row" style="--columns:{widest}">{pictures}</div>')
    return f"<figure>{''.join(rows)}{caption}</figure>"


def _panel(panel: Panel, about: str) -> str:
    height, width = panel.pixels.shape[:2]
    source = "data:image/png;base64," + base64.b64encode(png(panel)).decode()
    described = escape(f"{about}: {panel.label}" if panel.label else about)
    words = f"<span>{escape(panel.label)}</span>" if panel.label else ""
    return f'<div><img src="{source}" width="{width}" height="{height}" alt="{described}">{words}</div>'


def _chart(drawn: str, about: str) -> str:
    """The chart in the page's typeface and colours, as wide as its column."""
    drawn = re.sub(r'(<svg[^>]*?) width="[^"]*"', r"\1", drawn, count=1)
    drawn = re.sub(r'(<svg[^>]*?) height="[^"]*"', rf'\1 role="img" aria-label="{escape(about)}"', drawn, count=1)
    drawn = re.sub(r"(font: [^;\"]*?\d+px )[^;\"]*", rf"\g<1>{TYPEFACE}", drawn)
    return drawn.replace(INK, "currentColor")


_HTML: dict[type[Any], Callable[[Any], str]] = {Table: _table, Claim: _claim, Figure: _figure}
