"""What checking a law gives, and the registry of laws."""

from __future__ import annotations

import io
import json
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any

from ..reflectance import Reflectance


@dataclass(frozen=True)
class LawResult:
    """One law, measured."""

    law: str
    passed: bool
    """Whether `value` keeps to `limit`."""
    value: float
    """What was measured; the law's docstring says what it is."""
    limit: float
    """The bound of `value` that the law sets."""
    where: str
    """The directions of the worst case, as (polar angle, azimuth); empty where there is none."""
    note: str = ""
    declared: str = ""
    """Why the reflectance is known to break this law; empty where it claims to obey."""

    @property
    def status(self) -> str:
        """`holds`, `declared` (breaks it, and says so) or `breaks`."""
        if self.passed:
            return "holds"
        return "declared" if self.declared else "breaks"


@dataclass(frozen=True)
class Report:
    """All laws of one reflectance; prints as a table."""

    name: str
    results: tuple[LawResult, ...]

    @property
    def passed(self) -> bool:
        """Whether no law is broken without being declared."""
        return all(result.status != "breaks" for result in self.results)

    def __getitem__(self, law: str) -> LawResult:
        """The result of one law by name. Raises KeyError."""
        return {result.law: result for result in self.results}[law]

    def to_json(self) -> str:
        """Name, verdict and all results with their fields and status, as JSON text."""
        results = [asdict(result) | {"status": result.status} for result in self.results]
        return json.dumps({"name": self.name, "passed": self.passed, "results": results}, indent=2)

    def __rich__(self) -> Any:
        from rich.table import Table
        from rich.text import Text

        table = Table("law", "verdict", "value", "limit", "where", "note", title=Text(self.name))
        colors = {"holds": "green", "declared": "yellow", "breaks": "bold red"}
        for result in self.results:
            verdict = Text(result.status, colors[result.status])
            reason = f"declared: {result.declared}" if result.status == "declared" else ""
            note = "; ".join(filter(None, (result.note, reason)))
            numbers = (f"{result.value:.3g}", f"{result.limit:.3g}")
            table.add_row(result.law, verdict, *numbers, Text(result.where), Text(note))
        return table

    def __str__(self) -> str:
        from rich.console import Console

        text = io.StringIO()
        Console(file=text, width=120).print(self)
        return text.getvalue().rstrip()


class Law:
    """A named check; calling it measures a reflectance and adds what the reflectance declares about this law."""

    def __init__(self, name: str, measure: Callable[[Reflectance], LawResult], excused_by: str = "") -> None:
        self.name, self.__doc__ = name, measure.__doc__
        self._measure, self._excuses = measure, (excused_by, name)

    def __call__(self, reflectance: Reflectance) -> LawResult:
        result = self._measure(reflectance)
        declared = declared_breaches(reflectance)
        return replace(result, declared=next((declared[name] for name in self._excuses if name in declared), ""))

    def __repr__(self) -> str:
        return f"<law {self.name}>"


REGISTRY: dict[str, Law] = {}
"""Every law by name; a law enters by being defined."""


def law(name: str, excused_by: str = "") -> Callable[[Callable[[Reflectance], LawResult]], Law]:
    """Register a function as the law `name`; a declared breach of `excused_by` counts for it, too."""

    def register(measure: Callable[[Reflectance], LawResult]) -> Law:
        REGISTRY[name] = Law(name, measure, excused_by)
        return REGISTRY[name]

    return register


def declared_breaches(reflectance: Reflectance) -> Mapping[str, str]:
    """Laws that a reflectance, or a part of it, declares to break, with the reasons."""
    breaches: dict[str, str] = {}
    for part in reflectance.children.values():
        breaches |= declared_breaches(part)
    return breaches | dict(reflectance.breaks)


def rests_on_data(reflectance: Reflectance) -> bool:
    """Whether values come from arrays (a measurement or a table) and not from a formula alone.

    Textures that a formula derives from its own parameters are part of the formula.
    """
    parts = reflectance.children.values()
    return (
        bool(getattr(reflectance, "given_textures", reflectance.textures))
        or not reflectance.has_formula
        or any(map(rests_on_data, parts))
    )
