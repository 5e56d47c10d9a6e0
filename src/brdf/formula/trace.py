"""Tracing: call a formula once with symbols and keep the graph it builds, under the names the formula uses."""

from __future__ import annotations

import ast
import functools
import inspect
import itertools
import sys
import textwrap
from collections.abc import Mapping
from dataclasses import dataclass
from types import CodeType, FrameType
from typing import Any

from ..errors import FormulaError
from .bound import UV, Bound
from .graph import Expr, Graph, TextureRef
from .vec import Vec

AXES = "xyz"


@dataclass(frozen=True)
class Program:
    """A traced formula: RGB outputs over direction components, parameter components and textures."""

    title: str
    outputs: tuple[Expr, ...]
    parameters: tuple[tuple[str, int], ...]
    """Full name and number of components, in the order in which their values are passed."""
    textures: tuple[TextureRef, ...]

    @property
    def graph(self) -> Graph:
        return self.outputs[0].graph


def component_names(name: str, size: int) -> list[str]:
    """The symbols of a parameter: its name, or one a component."""
    return [name] if size == 1 else [f"{name}_{axis}" for axis in "rgb"[:size]]


def trace(reflectance: Any) -> Program:
    """The program of a reflectance that has a formula. Raises FormulaError when it branches on a traced value."""
    graph = Graph()
    sizes = {name: 1 if isinstance(value, float) else len(value) for name, value in reflectance.values.items()}
    textures = {name: TextureRef(name, data.shape, graph=graph) for name, data in reflectance.textures.items()}

    def lookup(name: str) -> Any:
        if name == UV:
            return Vec(*(graph.symbol(f"{UV}_{axis}") for axis in AXES[:2]))
        if name in textures:
            return textures[name]
        symbols = [graph.symbol(n) for n in component_names(name, sizes[name])]
        return symbols[0] if sizes[name] == 1 else Vec(*symbols)

    wi, wo = (Vec(*(graph.symbol(f"{w}_{axis}") for axis in AXES)) for w in ("wi", "wo"))
    namer = graph.on_make = _Namer()
    rgb = Bound(reflectance, lookup).f(wi, wo)
    graph.on_make = None
    graph.names = namer.names()
    if not isinstance(rgb, Vec) or len(rgb) != 3:
        raise FormulaError(f"the formula of {type(reflectance).__name__} returns {rgb!r}, not three components")
    outputs = tuple(graph.constant(component) for component in rgb)
    return Program(type(reflectance).__name__, outputs, tuple(sizes.items()), tuple(textures.values()))


def parameter_values(values: Mapping[str, Any]) -> list[float]:
    """All parameter components in the program's order."""
    return [float(v) for value in values.values() for v in (value if not isinstance(value, float) else (value,))]


class _Namer:
    """Gives nodes the names of the local variables their formulas assign them to.

    While a node is made, the running instructions, innermost frame first, are looked up in the source: the first that
    lies in the right-hand side of an assignment is computing that variable. Of the nodes made on its behalf, those
    unused when the last of them is made are its value, one a component.
    """

    def __init__(self) -> None:
        self._made: dict[tuple[Any, ...], list[Expr]] = {}

    def __call__(self, node: Expr) -> None:
        frame: FrameType | None = sys._getframe(2)
        while frame is not None and frame.f_code is not trace.__code__:
            if frame.f_globals.get("__package__") != __package__:
                line, _, column, _ = next(itertools.islice(frame.f_code.co_positions(), frame.f_lasti // 2, None))
                for start, end, target in _assignments(frame.f_code):
                    if line is not None and column is not None and start <= (line, column) < end:
                        self._made.setdefault((target, frame, start), []).append(node)
                        return
            frame = frame.f_back

    def names(self) -> dict[Expr, str]:
        found: dict[Expr, str] = {}
        for (target, *_), nodes in self._made.items():
            last = max(node.index for node in nodes)
            used = {argument for node in nodes[0].graph.nodes[: last + 1] for argument in node.args}
            value = [n for n in dict.fromkeys(nodes) if n not in used and n.op not in ("constant", "symbol")]
            for node, suffix in zip(value, [""] if len(value) == 1 else ("_x", "_y", "_z"), strict=False):
                found.setdefault(node, target + suffix)
        return found


@functools.cache
def _assignments(code: CodeType) -> list[tuple[tuple[int, int], tuple[int, int], str]]:
    """The assignments in a function's source: start and end (line, column) of the right-hand side, target's name."""
    try:
        lines, first = inspect.getsourcelines(code)
        tree = ast.parse(textwrap.dedent("".join(lines)))
    except (OSError, SyntaxError, TypeError):
        return []
    indent = len(lines[0]) - len(lines[0].lstrip())
    found = []
    for statement in ast.walk(tree):
        if isinstance(statement, ast.Assign) and isinstance(statement.targets[0], ast.Name):
            value = statement.value
            start = (value.lineno + first - 1, value.col_offset + indent)
            end = ((value.end_lineno or value.lineno) + first - 1, (value.end_col_offset or 0) + indent)
            found.append((start, end, statement.targets[0].id))
    return found
