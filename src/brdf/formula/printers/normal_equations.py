"""A numba kernel that accumulates the normal equations of a least-squares fit, from residuals and their derivatives.

Each channel has rows: the derivatives of its residual with respect to the parameters that it depends on, then the
residual itself. The kernel adds up the products of all pairs of rows; from these Gram matrices come J^T J, J^T r and
the cost, and no Jacobian is ever stored. Sums within a block are of the kernel's numbers, those over blocks float64.
"""

from __future__ import annotations

from collections.abc import Sequence

from ..graph import BOOLEAN_OPS, Expr, reachable
from .numba_dialect import UNIFORM, VARYING
from .statements import Statements

BLOCK = 512
"""Samples a block: the rows of a typical model fit the second-level cache."""

_HEADER = '''"""{title}: generated normal equations, {real}."""

import numpy as np
from numba import njit, types
from brdf.formula.{math} import *
from brdf.formula import math64 as uniform
from brdf.formula.gram import add_products

real = np.{real}
number = types.{real}
ZERO, ONE = real(0), real(1)
ROWS, BLOCK = {rows}, {block}


@njit(
    types.void(
        types.Array(number, 2, "C", readonly=True), types.Array(types.float64, 1, "C", readonly=True),
        types.Array(types.float64, 3, "C"), types.int64, types.int64,
    ),
    nogil=True, cache=True, fastmath=FASTMATH, error_model="numpy",
)
def kernel(data, parameters, grams, start, stop):
    """Adds the products of the rows of samples start to stop to grams (channels, rows, rows), lower triangles."""
'''


def print_normal_equations(
    title: str,
    channels: Sequence[Sequence[Expr]],
    inputs: Sequence[Expr],
    parameters: Sequence[Expr],
    real: str,
) -> str:
    """Source of a module with `kernel(data, parameters, grams, start, stop)`.

    `channels`: the rows of each; `inputs`: symbols of a sample's numbers, in the order of the rows of `data`
    (len(inputs), N); `parameters`: symbols in the order of `parameters`.
    """
    outputs = [row for rows in channels for row in rows]
    needed = reachable(outputs)
    varying = {node for node in inputs if node in set(needed)}
    for node in needed:
        if any(argument in varying for argument in node.args):
            varying.add(node)
    names = inputs[0].graph.names
    uniform, known = _uniform(needed, outputs, varying, parameters, names)
    loads = [node for node in inputs if node in varying]
    statements = Statements(VARYING, names, known | {node: f"in_{k}" for k, node in enumerate(loads)})
    statements.add(outputs)
    lines = [*uniform, "work = np.empty(ROWS * BLOCK, real)", "for first in range(start, stop, BLOCK):"]
    lines += ["    count = min(BLOCK, stop - first)"]
    for row, node in enumerate(loads):
        lines += [
            "    for i in range(count):",
            f"        work[{row * BLOCK} + i] = data[{list(inputs).index(node)}, first + i]",
        ]
    lines += ["    for i in range(count):"]
    lines += [f"        in_{row} = work[{row * BLOCK} + i]" for row in range(len(loads))]
    lines += [f"        {name} = {text}" for name, text in statements.lines]
    base = len(loads)
    lines += [f"        work[{(base + row) * BLOCK} + i] = {statements.text(node)}" for row, node in enumerate(outputs)]
    for channel, rows in enumerate(channels):
        lines.append(f"    add_products(work, {base}, {len(rows)}, BLOCK, count, grams[{channel}])")
        base += len(rows)
    header = _HEADER.format(
        title=title, real=real, math="math32" if real == "float32" else "math64", rows=base, block=BLOCK
    )
    return header + "\n".join(f"    {line}" for line in lines) + "\n"


def _uniform(
    needed: Sequence[Expr],
    outputs: Sequence[Expr],
    varying: set[Expr],
    parameters: Sequence[Expr],
    names: dict[Expr, str],
) -> tuple[list[str], dict[Expr, str]]:
    """What depends on parameters alone, computed once a call in float64: lines, and the names of what the loop uses."""
    used = {node: f"parameter_{k}" for k, node in enumerate(parameters) if node in set(needed)}
    lines = [f"{name} = parameters[{name.removeprefix('parameter_')}]" for name in used.values()]
    edge = {argument for node in varying for argument in node.args} | set(outputs)
    wanted = sorted((n for n in edge if n not in varying and n.op != "constant"), key=lambda node: node.index)
    statements = Statements(UNIFORM, names, used)
    statements.add(wanted)
    lines += [f"{name} = {text}" for name, text in statements.lines]
    known: dict[Expr, str] = {}
    for node in wanted:
        known[node] = f"uniform_{len(known)}"
        text = statements.text(node)
        lines.append(f"{known[node]} = {text if node.op in BOOLEAN_OPS else f'real({text})'}")
    return lines, known
