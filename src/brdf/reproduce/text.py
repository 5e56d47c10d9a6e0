"""A report as text: Markdown for the documentation."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from .report import Claim, Figure, Report, Table


def markdown(report: Report) -> str:
    """Title, tables and claims; figures by their captions."""
    lines = [f"# {report.title}", "", report.source, "", setting(report), ""]
    for section in report.sections:
        lines += [f"## {section.title}", ""]
        lines += [section.text, ""] if section.text else []
        for item in section.items:
            lines += [*_LINES[type(item)](item), ""]
    return "\n".join(lines).rstrip() + "\n"


def setting(report: Report) -> str:
    """Version, machine and settings in one line."""
    found = report.results()
    machine = found["machine"]
    settings = ", ".join(f"{key.replace('_', ' ')} {_words(value)}" for key, value in (report.settings or {}).items())
    where = f"{machine['cores']} cores, {machine['processor']}, {machine['system']}"
    return f"brdf {found['brdf']}; {where}; {settings}."


def _words(value: object) -> str:
    return " ".join(map(str, value)) if isinstance(value, (list, tuple)) else "all" if value is None else str(value)


def _table(table: Table) -> list[str]:
    return [
        f"**{table.caption}** {table.how}".rstrip(),
        "",
        _row(table.flat_headings()),
        _row(["---:" if right else "---" for right in table.numeric()]),
        *map(_row, table.texts()),
        *(["", table.verdict] if table.verdict else []),
    ]


def _row(cells: list[str]) -> str:
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def _claim(claim: Claim) -> list[str]:
    checks = [f"- {'yes' if held else 'no'}: {text}" for text, held in claim.checks.items()]
    return [f"“{claim.statement}” **{claim.verdict.capitalize()}.**", "", *checks]


def _figure(figure: Figure) -> list[str]:
    first, *_, last = [*figure.files(), figure.files()[-1]]
    return [f"*{figure.caption}* ({first if first == last else f'{first} … {last}'})"]


_LINES: dict[type[Any], Callable[[Any], list[str]]] = {Table: _table, Claim: _claim, Figure: _figure}
