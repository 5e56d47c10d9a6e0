"""A parameterised object as a formula sees it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from .vec import Vec

UV = "uv"
"""What a formula's lookup calls the surface coordinates."""


class Bound:
    """A parameterised object as its formula sees it: parameters are symbols or arrays, everything else as it is.

    `lookup(path)` gives the value of a parameter or texture by full name; the object's formulas run with a `Bound` as
    their `self`, so that one text serves every backend.
    """

    def __init__(self, target: Any, lookup: Any, prefix: str = "") -> None:
        self._target, self._lookup, self._prefix = target, lookup, prefix

    def bound_child(self, child: str, values: Mapping[str, Any]) -> Bound:
        """A child some of whose parameters are what the formula made of them: `values` by the child's full names."""
        prefix = f"{self._prefix}{child}_"

        def lookup(path: str) -> Any:
            name = path.removeprefix(prefix)
            return values[name] if name in values else self._lookup(path)

        return Bound(self._target.children[child], lookup, prefix)

    @property
    def uv(self) -> Any:
        """The surface coordinates, a `Vec` of two: only for what varies in space."""
        return self._lookup(UV)

    def __getattr__(self, name: str) -> Any:
        target = self._target
        parts = getattr(target, "_parts", {})
        if name in parts:
            return Bound(parts[name], self._lookup, self._prefix)
        all_declared = getattr(type(target), "_declared", {})
        declared = all_declared.get(name)
        if declared is not None:
            if name not in target._values and declared.follows is not None:
                name = declared.follows
            return self._lookup(self._prefix + name)
        if name in getattr(target, "textures", {}) or name in getattr(target, "values", {}):
            return self._lookup(self._prefix + name)
        children = getattr(target, "children", {})
        if name in children:
            return Bound(children[name], self._lookup, f"{self._prefix}{name}_")
        attribute = getattr(type(target), name, None)
        if callable(attribute) and hasattr(attribute, "__get__"):
            return attribute.__get__(self)  # a method of the formula: it runs with the bound self, too
        for part in parts.values():
            if name in part.declarations():
                return getattr(Bound(part, self._lookup, self._prefix), name)
        return getattr(target, name)


def bound_value(value: Any, number_type: Any) -> Any:
    """A parameter's value as a formula takes it: a scalar of the wanted type, or a `Vec` of them."""
    if isinstance(value, float):
        return number_type(value)
    return Vec(*map(number_type, value))
