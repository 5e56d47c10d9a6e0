"""A traced formula: a graph of scalar operations in which equal expressions are one node.

Calling a formula once with symbolic directions and parameters (`trace.trace`) builds the graph; the printers turn it
into code, `derivative` into another graph. Nodes are made by their `Graph` alone, which folds constants, drops what
does nothing (x + 0, 1 * x) and returns the existing node when the same operation was asked for before.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Container, Iterable
from dataclasses import dataclass, field, replace
from typing import Any, NoReturn

from ..errors import FormulaError
from .vec import Vec


@dataclass(frozen=True)
class TextureRef:
    """A texture as a traced formula sees it: an argument with a name, not data."""

    name: str
    shape: tuple[int, ...]
    filter: str = "linear"
    """How a lookup reads it, see `textures`."""
    graph: Graph | None = field(default=None, compare=False, repr=False)
    """Where a lookup at a constant place becomes a node."""

    @property
    def channels(self) -> int:
        return self.shape[-1]

    @property
    def dimensions(self) -> int:
        return len(self.shape) - 1


class Expr:
    """One node: an operation on other nodes. Compare by identity (equal expressions of one graph are identical)."""

    __slots__ = ("args", "graph", "index", "op", "value")

    def __init__(self, graph: Graph, op: str, args: tuple[Expr, ...], value: Any, index: int) -> None:
        self.graph = graph
        self.op = op
        self.args = args
        self.value = value
        self.index = index

    def __repr__(self) -> str:
        inside = repr(self.value) if self.value is not None else ", ".join(map(repr, self.args))
        return f"{self.op}({inside})"

    def __bool__(self) -> NoReturn:
        raise FormulaError("a formula branches on a traced value; use where(condition, a, b) instead of `if`")

    def __float__(self) -> NoReturn:
        raise FormulaError("a formula turns a traced value into a number; call the functions of brdf.formula instead")

    def _binary(self, op: str, other: Any, swap: bool = False) -> Any:
        if isinstance(other, Vec):
            return NotImplemented
        return self.graph.call(op, other, self) if swap else self.graph.call(op, self, other)

    def __add__(self, other: Any) -> Any:
        return self._binary("add", other)

    def __radd__(self, other: Any) -> Any:
        return self._binary("add", other, swap=True)

    def __sub__(self, other: Any) -> Any:
        return self._binary("sub", other)

    def __rsub__(self, other: Any) -> Any:
        return self._binary("sub", other, swap=True)

    def __mul__(self, other: Any) -> Any:
        return self._binary("mul", other)

    def __rmul__(self, other: Any) -> Any:
        return self._binary("mul", other, swap=True)

    def __truediv__(self, other: Any) -> Any:
        return self._binary("div", other)

    def __rtruediv__(self, other: Any) -> Any:
        return self._binary("div", other, swap=True)

    def __pow__(self, exponent: Any) -> Any:
        return self._binary("power", exponent)

    def __neg__(self) -> Expr:
        return self.graph.call("neg", self)

    def __lt__(self, other: Any) -> Any:
        return self._binary("lt", other)

    def __le__(self, other: Any) -> Any:
        return self._binary("le", other)

    def __gt__(self, other: Any) -> Any:
        return self._binary("lt", other, swap=True)

    def __ge__(self, other: Any) -> Any:
        return self._binary("le", other, swap=True)

    def __and__(self, other: Any) -> Any:
        return self._binary("and", other)

    def __or__(self, other: Any) -> Any:
        return self._binary("or", other)

    def __invert__(self) -> Expr:
        return self.graph.call("not", self)


_FOLD: dict[str, Callable[..., float | bool]] = {
    "add": lambda a, b: a + b,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "div": lambda a, b: a / b,
    "neg": lambda a: -a,
    "abs": abs,
    "sqrt": math.sqrt,
    "exp": math.exp,
    "log": math.log,
    "sin": math.sin,
    "cos": math.cos,
    "tan": math.tan,
    "asin": math.asin,
    "acos": math.acos,
    "atan": math.atan,
    "atan2": math.atan2,
    "erf": math.erf,
    "floor": math.floor,
    "sign": lambda a: (a > 0) - (a < 0),
    "pow": lambda a, b: a**b,
    "minimum": min,
    "maximum": max,
    "lt": lambda a, b: a < b,
    "le": lambda a, b: a <= b,
    "and": lambda a, b: a and b,
    "or": lambda a, b: a or b,
    "not": lambda a: not a,
    "where": lambda c, a, b: a if c else b,
}
"""Every operation a graph may hold, with its value on constants."""

BOOLEAN_OPS = frozenset({"lt", "le", "and", "or", "not"})


@dataclass
class Graph:
    """The nodes of one traced formula, in the order they were made (operands come first)."""

    nodes: list[Expr] = field(default_factory=list)
    names: dict[Expr, str] = field(default_factory=dict)
    """What the formula called a value: kept so that printed code reads like the formula."""
    on_make: Callable[[Expr], None] | None = None
    _known: dict[tuple[Any, ...], Expr] = field(default_factory=dict)

    def make(self, op: str, args: tuple[Expr, ...] = (), value: Any = None) -> Expr:
        """The node as it stands, not simplified; the one that exists if there is one."""
        key = (op, *(a.index for a in args), value, type(value))
        node = self._known.get(key)
        if node is None:
            node = self._known[key] = Expr(self, op, args, value, len(self.nodes))
            self.nodes.append(node)
        return node

    def constant(self, value: Any) -> Expr:
        if isinstance(value, Expr):
            return value
        try:
            if isinstance(value, str):  # float() would read "1" as a number
                raise TypeError
            return self.make("constant", value=bool(value) if isinstance(value, bool) else float(value))
        except (TypeError, ValueError) as error:
            raise FormulaError(f"a formula mixes traced values with {type(value).__name__}") from error

    def symbol(self, name: str) -> Expr:
        """An input: a component of a direction or of a parameter."""
        return self.make("symbol", value=name)

    def texture(self, texture: TextureRef, *coordinates: Any, filter: str = "linear") -> Vec:
        if not isinstance(texture, TextureRef) or texture.dimensions != len(coordinates):
            raise FormulaError(f"a texture lookup wants a declared texture and one coordinate an axis, got {texture!r}")
        fetch = self.make("texture", tuple(map(self.constant, coordinates)), replace(texture, filter=filter))
        return Vec(*(self.make("channel", (fetch,), channel) for channel in range(texture.channels)))

    def call(self, op: str, *arguments: Any) -> Expr:
        """The node of `op` on the arguments, simplified."""
        node = self._simplify(op, tuple(map(self.constant, arguments)))
        if self.on_make is not None:
            self.on_make(node)
        return node

    def _simplify(self, op: str, args: tuple[Expr, ...]) -> Expr:
        if op == "power":
            return self._power(*args)
        if op not in _FOLD:
            raise FormulaError(f"{op!r} is not a function a formula may call")
        if all(a.op == "constant" for a in args):
            return self.constant(_FOLD[op](*(a.value for a in args)))
        same = self._identity(op, args)
        if same is not None:
            return same
        if op in ("add", "mul") and args[0].index > args[1].index:
            args = (args[1], args[0])  # one node for a + b and b + a
        return self.make(op, args)

    def _identity(self, op: str, args: tuple[Expr, ...]) -> Expr | None:
        """The operand that the operation leaves as it is, if it does."""
        values = [a.value if a.op == "constant" else None for a in args]
        match op:
            case "add" if values[0] == 0.0:
                return args[1]
            case "add" | "sub" if values[1] == 0.0:
                return args[0]
            case "mul" if values[0] == 1.0:
                return args[1]
            case "mul" | "div" if values[1] == 1.0:
                return args[0]
            case "mul" if 0.0 in (values[0], values[1]):
                return self.constant(0.0)
            case "neg" if args[0].op == "neg":
                return args[0].args[0]
            case "where" if values[0] is not None:
                return args[1] if values[0] else args[2]
            case "where" if args[1] is args[2]:
                return args[1]
        return None

    def _power(self, base: Expr, exponent: Expr) -> Expr:
        """Whole exponents up to 32 become products (a shader's pow is undefined for a negative base)."""
        value = exponent.value if exponent.op == "constant" else None
        if value is None or value != int(value) or abs(value) > 32:
            return self.call("pow", base, exponent)
        if value < 0:
            return self.call("div", 1.0, self._power(base, self.constant(-value)))
        result, square, bits = self.constant(1.0), base, int(value)
        while bits:
            if bits & 1:
                result = self.call("mul", result, square)
            bits >>= 1
            if bits:
                square = self.call("mul", square, square)
        return result


def reachable(outputs: Iterable[Expr], stop: Container[Expr] = ()) -> list[Expr]:
    """The nodes the outputs depend on, operands first, without looking behind those in `stop`."""
    wanted: dict[int, Expr] = {}
    stack = list(outputs)
    while stack:
        node = stack.pop()
        if node.index not in wanted:
            wanted[node.index] = node
            if node not in stop:
                stack.extend(node.args)
    return [wanted[index] for index in sorted(wanted)]
