"""A numba kernel from a traced program. It walks (N, 3) inputs in blocks: see `numba_blocks`."""

from __future__ import annotations

from ..trace import Program, component_names
from .numba_blocks import BLOCK, Blocks, indented

_HEADER = '''"""{title}: generated kernel, {real}."""

import numpy as np
from numba import njit, types
from brdf.formula.{math} import *
from brdf.formula import math64 as uniform

real = np.{real}
number = types.{real}
ZERO, ONE, TOLERANCE = real(0), real(1), real(2e-3)
ROWS, BLOCK = {rows}, {block}


def array(dtype, dimensions, layout):
    return types.Array(dtype, dimensions, layout, readonly=True)


@njit(
    types.int64({signature}),
    nogil=True, cache=True, fastmath=FASTMATH, error_model="numpy",
)
def kernel({arguments}):
    """Fills out[start:stop]; returns the start of the first block with a direction not of unit length, or -1."""
'''


_DIRECTIONS = [f"{w}_{axis}" for w in ("wi", "wo") for axis in "xyz"]
_PLACE = ["uv_x", "uv_y"]


def print_kernel(program: Program, real: str, has_horizon: bool, varies: bool = False) -> str:
    """Source of a module with `kernel(wi, wo, parameters, textures…, out, start, stop, clamp)` for `real` numbers.

    What varies in space has `uv` after `wo`.
    """
    return _KernelPrinter(program, real, has_horizon, varies).source()


class _KernelPrinter:
    def __init__(self, program: Program, real: str, has_horizon: bool, varies: bool) -> None:
        self._program, self._real, self._has_horizon = program, real, has_horizon
        self._inputs = [*_DIRECTIONS, *(_PLACE if varies else [])]
        graph = program.graph
        self._blocks = Blocks(program.outputs, [graph.symbol(name) for name in self._inputs])

    def source(self) -> str:
        graph, textures = self._program.graph, self._program.textures
        names = [n for name, size in self._program.parameters for n in component_names(name, size)]
        uniform = self._blocks.uniform({graph.symbol(name): name for name in names})
        start = self._block_start()
        loops = self._blocks.fetches() + self._shade()
        header = _HEADER.format(
            title=self._program.title,
            real=self._real,
            math="math32" if self._real == "float32" else "math64",
            signature=", ".join(
                ["array(number, 2, 'A')"] * len({name[:2] for name in self._inputs})
                + ["array(types.float64, 1, 'C')"]
                + [f"array(types.float32, {t.dimensions + 1}, 'C')" for t in textures]
                + ["types.Array(number, 2, 'C')", "types.int64", "types.int64", "types.boolean"]
            ),
            arguments=", ".join(
                [
                    *dict.fromkeys(name[:2] for name in self._inputs),
                    "parameters",
                    *(t.name for t in textures),
                    "out",
                    "start",
                    "stop",
                    "clamp",
                ]
            ),
            rows=self._blocks.rows,
            block=BLOCK,
        )
        lines = [*indented(1, uniform), *indented(1, start), *indented(2, loops), "    return bad", ""]
        return header + "\n".join(lines)

    def _block_start(self) -> list[str]:
        row = self._blocks.row
        loads = [f"{row(name)} = {name[:2]}[first + i, {'xyz'.index(name[3])}]" for name in self._inputs]
        for name in self._inputs:
            self._blocks.is_given(self._program.graph.symbol(name), name)
        return [
            "work = np.empty(ROWS * BLOCK, real)",
            "bad = -1",
            "for first in range(start, stop, BLOCK):",
            "    count = min(BLOCK, stop - first)",
            "    for i in range(count):",
            *indented(2, loads),
            "    off = 0",
            *indented(1, self._blocks.loop(_DIRECTIONS)),
            "        wi2 = wi_x * wi_x + wi_y * wi_y + wi_z * wi_z",
            "        wo2 = wo_x * wo_x + wo_y * wo_y + wo_z * wo_z",
            "        off += where((abs(wi2 - ONE) < TOLERANCE) & (abs(wo2 - ONE) < TOLERANCE), 0, 1)",
            "    if off > 0 and bad < 0:",
            "        bad = first",
        ]

    def _shade(self) -> list[str]:
        lines, statements = self._blocks.computed(self._program.outputs)
        if self._has_horizon:
            lines += [*self._blocks.loads(["wi_z", "wo_z"]), "    lit = (wi_z > ZERO) & (wo_z > ZERO)"]
        for channel, output in enumerate(self._program.outputs):
            text = statements.text(output)
            lines.append(f"    value = {f'where(lit, {text}, ZERO)' if self._has_horizon else text}")
            lines.append(f"    {self._blocks.row(f'out{channel}')} = where(clamp & (value < ZERO), ZERO, value)")
        lines.append("for i in range(count):")
        return lines + [f"    out[first + i, {channel}] = {self._blocks.row(f'out{channel}')}" for channel in range(3)]
