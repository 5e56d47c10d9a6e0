"""A numba kernel that accumulates the normal equations of a least-squares fit, from residuals and their derivatives.

Each channel has rows: the derivatives of its residual with respect to the parameters that it depends on, then the
residual itself. The kernel adds up the products of all pairs of rows; from these Gram matrices come J^T J, J^T r and
the cost, and no Jacobian is ever stored. Sums within a block are of the kernel's numbers, those over blocks float64.
"""

from __future__ import annotations

from collections.abc import Sequence

from ..graph import Expr, TextureRef
from .numba_blocks import BLOCK, Blocks, indented

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
        types.Array(number, 2, "C", readonly=True), types.Array(types.float64, 1, "C", readonly=True),{textures}
        types.Array(types.float64, 3, "C"), types.int64, types.int64,
    ),
    nogil=True, cache=True, fastmath=FASTMATH, error_model="numpy",
)
def kernel(data, parameters{arguments}, grams, start, stop):
    """Adds the products of the rows of samples start to stop to grams (channels, rows, rows), lower triangles."""
'''


def print_normal_equations(
    title: str,
    channels: Sequence[Sequence[Expr]],
    inputs: Sequence[Expr],
    parameters: Sequence[Expr],
    textures: Sequence[TextureRef],
    real: str,
) -> str:
    """Source of a module with `kernel(data, parameters, textures…, grams, start, stop)`.

    `channels`: the rows of each; `inputs`: symbols of a sample's numbers, in the order of the rows of `data`
    (len(inputs), N); `parameters`: symbols in the order of `parameters`.
    """
    outputs = [row for rows in channels for row in rows]
    blocks = Blocks(outputs, inputs)
    lines = blocks.uniform({node: f"parameter_{k}" for k, node in enumerate(parameters)})
    results = [blocks.row(f"out_{k}") for k in range(len(outputs))]  # first, and so next to each other
    body = ["count = min(BLOCK, stop - first)"]
    for k, node in enumerate(inputs):
        if blocks.uses(node):
            blocks.is_given(node, f"in_{k}")
            body += ["for i in range(count):", f"    {blocks.row(f'in_{k}')} = data[{k}, first + i]"]
    body += blocks.fetches()
    computed, statements = blocks.computed(outputs)
    body += [*computed, *(f"    {row} = {statements.text(node)}" for row, node in zip(results, outputs, strict=True))]
    base = 0
    for channel, rows in enumerate(channels):
        body.append(f"add_products(work, {base}, {len(rows)}, BLOCK, count, grams[{channel}])")
        base += len(rows)
    lines += ["work = np.empty(ROWS * BLOCK, real)", "for first in range(start, stop, BLOCK):", *indented(1, body)]
    header = _HEADER.format(
        title=title, real=real, math="math32" if real == "float32" else "math64", rows=blocks.rows, block=BLOCK,
        textures="".join(f' types.Array(types.float32, {t.dimensions + 1}, "C", readonly=True),' for t in textures),
        arguments="".join(f", {t.name}" for t in textures),
    )  # fmt: skip
    return header + "\n".join(indented(1, lines)) + "\n"
