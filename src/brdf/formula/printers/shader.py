"""What the two shading languages share: inputs, statements, and the helper functions that a program needs."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources

import numpy as np

from ...errors import FormulaError
from ..bound import UV
from ..graph import Expr, TextureRef, reachable
from ..trace import Program
from .lanes import Lanes, group_names
from .statements import Dialect, Statements

DIRECTIONS = ("wi", "wo")


@dataclass(frozen=True)
class Uniform:
    """A parameter that the formula uses, as a shader has it."""

    parameter: str
    """Full name."""
    name: str
    """In the shader: another where the language has taken the parameter's."""
    size: int


@dataclass(frozen=True)
class Sampled:
    """A texture that the formula uses, as a shader has it."""

    texture: TextureRef
    names: dict[int, str]
    """In the shader: number of a group of channels -> the texture that holds it."""

    @property
    def axes(self) -> int:
        """Of the graphics card's textures: a row of texels is a picture of one row."""
        return max(self.texture.dimensions, 2)


@dataclass(frozen=True)
class Body:
    """A printed formula: its statements and the colour it returns."""

    statements: list[tuple[str, str]]
    """(declared variable, expression) in order."""
    value: str
    uniforms: tuple[Uniform, ...]
    textures: tuple[Sampled, ...]

    @property
    def text(self) -> str:
        return "\n".join([*(text for _, text in self.statements), self.value])


def body(program: Program, dialect: Callable[[Mapping[Expr, str]], Dialect], prefix: str = "") -> Body:
    """The program in a dialect, which is made of the kinds of its nodes; `prefix` stands before its parameters."""
    vectors = [*DIRECTIONS, UV, *(name for name, size in program.parameters if size > 1)]
    lanes = Lanes(program, vectors)
    made = dialect(lanes.kinds)
    symbols = {node.value: node for node in reachable([lanes.outputs]) if node.op == "symbol"}
    names = {name: f"{name}_" if name in made.reserved else name for name in symbols}
    uniforms = tuple(Uniform(name, names[name], size) for name, size in program.parameters if name in symbols)
    known = {node: names[name] for name, node in symbols.items()}
    known |= {symbols[u.parameter]: prefix + u.name for u in uniforms}
    statements = Statements(made, lanes.graph.names, known)
    statements.add([lanes.outputs])
    sampled = (
        Sampled(texture, {group: names[name] for group, name in enumerate(group_names(texture)) if name in names})
        for texture in program.textures
    )
    used = tuple(texture for texture in sampled if texture.names)
    return Body(statements.lines, statements.text(lanes.outputs), uniforms, used)


def literal(value: float | bool) -> str:
    """A constant with the digits that single precision has. Raises FormulaError for what it cannot hold."""
    if isinstance(value, bool):
        return str(value).lower()
    with np.errstate(over="ignore"):
        single = np.float32(value)
    if not np.isfinite(single) or 0 < abs(value) < np.finfo(np.float32).tiny:
        raise FormulaError(f"the formula holds the constant {value:g}, which a shader's numbers cannot; rescale it")
    return str(single)


def in_place(node: Expr) -> bool:
    """Constants, vectors of one constant, and components."""
    is_constant = node.op == "vec3" and len(node.args) == 1 and node.args[0].op == "constant"
    return node.op == "constant" or is_constant or node.op.startswith(".")


def swizzled(op: str, argument: str) -> str:
    """`.x` and the like behind a name, or behind what gets parentheses."""
    return f"{argument}{op}" if re.fullmatch(r"[\w.]+|\w+\([^()]*\)", argument) else f"({argument}){op}"


def helpers(language: str, text: str) -> str:
    """The functions of `library.LANGUAGE` that the text calls, and those that they call, in the library's order."""
    found: set[int] = set()
    blocks = _library(language)
    pending = [text]
    while pending:
        called = set(re.findall(r"(\w+)\(", pending.pop()))
        for number, (name, source) in enumerate(blocks):
            if name in called and number not in found:
                found.add(number)
                pending.append(source)
    return "\n\n".join(blocks[number][1] for number in sorted(found))


def helper_names(language: str) -> frozenset[str]:
    """Every function of the library."""
    return frozenset(name for name, _ in _library(language))


@cache
def _library(language: str) -> list[tuple[str, str]]:
    """(name, source) of each function; functions stand apart by a blank line."""
    text = resources.files(__package__).joinpath(f"library.{language}").read_text("utf-8")
    blocks = [block.strip() for block in text.split("\n\n")]
    return [(re.search(r"^(?:fn )?(?:\w+ )?(\w+)\(", block, re.M)[1], block) for block in blocks]  # type: ignore[index]
