"""Exact derivatives of a traced formula with respect to its parameters, as more nodes of the same graph.

Forward mode: each node's derivative follows from its operands'. Equal subexpressions stay shared, so that a kernel of
values and derivatives costs little more than the values.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

from ..errors import FormulaError
from .graph import BOOLEAN_OPS, Expr, reachable


def derivative(outputs: Sequence[Expr], symbol: Expr) -> tuple[Expr, ...]:
    """d outputs / d symbol. At a kink (minimum, maximum, abs, where) the side that is taken counts.
    A texture's slope is that of its linear interpolation.
    """
    graph = symbol.graph
    zero = graph.constant(0.0)
    of: dict[Expr, Expr] = {}
    for node in reachable(outputs):
        changes = [of[argument] for argument in node.args]
        if node is symbol:
            of[node] = graph.constant(1.0)
        elif all(change is zero for change in changes):
            of[node] = zero
        elif node.op == "texture":
            of[node] = node  # not a number itself: its channels have the derivatives
        elif node.op == "channel":
            fetch = node.args[0]
            of[node] = _of_channel(fetch, node.value, [of[coordinate] for coordinate in fetch.args])
        elif node.op in BOOLEAN_OPS or node.op in ("floor", "sign"):
            of[node] = zero
        else:
            of[node] = _RULES[node.op](node, node.args, changes)
    return tuple(of[output] for output in outputs)


def _of_channel(fetch: Expr, channel: int, changes: Sequence[Expr]) -> Expr:
    """The derivative of one channel of a linear lookup, from those of its coordinates."""
    if fetch.value.filter != "linear":
        raise FormulaError(f"a {fetch.value.filter} lookup has no derivative; read the texture linearly")
    total = fetch.graph.constant(0.0)
    for axis, change in enumerate(changes):
        size = float(fetch.value.shape[axis])
        below = fetch.graph.call("floor", fetch.args[axis] * size - 0.5)
        ends = []
        for centre in (0.5, 1.5):
            shifted = [(below + centre) / size if k == axis else u for k, u in enumerate(fetch.args)]
            ends.append(fetch.graph.texture(fetch.value, *shifted)[channel])
        total = total + change * ((ends[1] - ends[0]) * size)
    return total


def _choose(node: Expr, condition: Expr, x: Expr, y: Expr) -> Any:
    return node.graph.call("where", condition, x, y)


def _pow(node: Expr, args: Sequence[Expr], changes: Sequence[Expr]) -> Expr:
    x, y = args
    total: Expr = changes[0] * (y * node.graph.call("pow", x, y - 1.0))
    if not (changes[1].op == "constant" and changes[1].value == 0.0):
        positive = node.graph.call("maximum", x, 1e-37)  # 0^y stays 0 whatever y: its logarithm must stay finite
        total = total + changes[1] * (node * node.graph.call("log", positive))
    return total


_Rule = Callable[[Expr, Sequence[Expr], Sequence[Expr]], Expr]
_RULES: dict[str, _Rule] = {
    "add": lambda n, a, d: d[0] + d[1],
    "sub": lambda n, a, d: d[0] - d[1],
    "mul": lambda n, a, d: d[0] * a[1] + a[0] * d[1],
    "div": lambda n, a, d: (d[0] - n * d[1]) / a[1],
    "neg": lambda n, a, d: -d[0],
    "abs": lambda n, a, d: d[0] * n.graph.call("sign", a[0]),
    "sqrt": lambda n, a, d: d[0] / (2.0 * n),
    "exp": lambda n, a, d: d[0] * n,
    "log": lambda n, a, d: d[0] / a[0],
    "sin": lambda n, a, d: d[0] * n.graph.call("cos", a[0]),
    "cos": lambda n, a, d: -d[0] * n.graph.call("sin", a[0]),
    "tan": lambda n, a, d: d[0] * (1.0 + n * n),
    "asin": lambda n, a, d: d[0] / n.graph.call("sqrt", 1.0 - a[0] * a[0]),
    "acos": lambda n, a, d: -d[0] / n.graph.call("sqrt", 1.0 - a[0] * a[0]),
    "atan": lambda n, a, d: d[0] / (1.0 + a[0] * a[0]),
    "atan2": lambda n, a, d: (d[0] * a[1] - a[0] * d[1]) / (a[0] * a[0] + a[1] * a[1]),
    "erf": lambda n, a, d: d[0] * (2 / math.sqrt(math.pi)) * n.graph.call("exp", -(a[0] * a[0])),
    "pow": _pow,
    "minimum": lambda n, a, d: _choose(n, a[0] < a[1], d[0], d[1]),
    "maximum": lambda n, a, d: _choose(n, a[1] < a[0], d[0], d[1]),
    "where": lambda n, a, d: _choose(n, a[0], d[1], d[2]),
}
