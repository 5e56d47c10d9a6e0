"""The value of graph nodes on NumPy: for what is made from a formula's graph and not by calling the formula."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import ops
from .backends import backend_of
from .graph import Expr, reachable
from .textures import lookup

_OPERATORS: dict[str, Callable[..., Any]] = {
    "add": operator.add, "sub": operator.sub, "mul": operator.mul, "div": operator.truediv, "neg": operator.neg,
    "lt": operator.lt, "le": operator.le, "and": operator.and_, "or": operator.or_, "not": np.logical_not,
}  # fmt: skip


def evaluate(
    outputs: Sequence[Expr], symbols: Mapping[str, Any], textures: Mapping[str, NDArray[Any]]
) -> list[NDArray[np.float64]]:
    """The outputs for values of the symbols (numbers or (N,) arrays) and textures by name."""
    known: dict[Expr, Any] = {}
    for node in reachable(outputs):
        match node.op:
            case "constant":
                known[node] = np.float64(node.value) if not isinstance(node.value, bool) else node.value
            case "symbol":
                known[node] = np.asarray(symbols[node.value], np.float64)
            case "texture":
                coordinates = tuple(known[argument] for argument in node.args)
                known[node] = lookup(
                    textures[node.value.name], coordinates, backend_of(*coordinates), node.value.filter
                )
            case "channel":
                known[node] = known[node.args[0]][node.value]
            case _:
                function = _OPERATORS.get(node.op) or getattr(ops, node.op)
                with np.errstate(all="ignore"):  # the branch of a `where` that is not taken may be no number
                    known[node] = function(*(known[argument] for argument in node.args))
    return [np.asarray(known[output], np.float64) for output in outputs]
