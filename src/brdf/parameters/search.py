"""How a parameter is declared, wherever in a tree of parameterised objects it stands."""

from __future__ import annotations

from typing import Any

from .declared import Parameter
from .parameterised import Parameterised


def declaration(m: Any, name: str) -> Parameter | None:
    """How the parameter of that full name is declared; None for numbers that are not declared, such as a table's."""
    if isinstance(m, Parameterised) and name in m.declarations():
        return m.declarations()[name]
    inner = (declaration(child, name.removeprefix(f"{key}_")) for key, child in m.children.items()
             if name.startswith(f"{key}_"))  # fmt: skip
    return next((found for found in inner if found), None)
