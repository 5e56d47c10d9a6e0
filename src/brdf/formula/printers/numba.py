"""A numba kernel from a traced program.

The kernel walks (N, 3) inputs in blocks. Within a block everything lives in one work array, component by component, so
that each loop is plain arithmetic on contiguous rows of constant distance, which LLVM turns into SIMD code. Texture
lookups gather and therefore get a loop of their own: one loop computes their coordinates, one fetches, the last goes
on with the fetched channels. What depends on parameters alone is computed once a call, in float64.
"""

from __future__ import annotations

from ..graph import BOOLEAN_OPS, Expr, TextureRef, reachable
from ..trace import Program, component_names
from .numba_dialect import UNIFORM, VARYING
from .numba_lookup import lookup_loop
from .statements import Statements

BLOCK = 512
"""Pairs a block: the work array of a typical model fits the first-level cache."""

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
        self._rows: dict[str, str] = {}
        """What the work array holds: name -> the current pair's element."""
        self._needed = reachable(program.outputs)
        self._symbols = {node.value: node for node in self._needed if node.op == "symbol"}
        self._varying = {node for name, node in self._symbols.items() if name in self._inputs}
        for node in self._needed:
            if node.op == "texture" or any(argument in self._varying for argument in node.args):
                self._varying.add(node)
        self._known: dict[Expr, str] = {}
        """Nodes computed before the current loop -> the name they have in it."""

    def source(self) -> str:
        textures = self._program.textures
        uniform = self._uniform()
        start = self._block_start()
        fetches = [node for node in self._needed if node.op == "texture"]
        loops = [line for fetch in fetches for line in self._fetch(fetch)] + self._shade()
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
            rows=len(self._rows),
            block=BLOCK,
        )
        return header + "\n".join([*_indent(1, uniform), *_indent(1, start), *_indent(2, loops), "    return bad", ""])

    def _row(self, name: str) -> str:
        return self._rows.setdefault(name, f"work[{len(self._rows) * BLOCK} + i]")

    def _uniform(self) -> list[str]:
        """Parameters and what depends on them alone, cast to the kernel's numbers where the loops use it."""
        names = [n for name, size in self._program.parameters for n in component_names(name, size)]
        used = [(i, name) for i, name in enumerate(names) if name in self._symbols]
        lines = [f"{name} = parameters[{index}]" for index, name in used]
        edge = {a for node in self._varying for a in node.args} | set(self._program.outputs)
        edge = {node for node in edge if node not in self._varying and node.op != "constant"}
        statements = Statements(UNIFORM, self._program.graph.names, {self._symbols[name]: name for _, name in used})
        wanted = sorted(edge, key=lambda node: node.index)
        statements.add(wanted)
        lines += [f"{name} = {text}" for name, text in statements.lines]
        for node in wanted:
            text = statements.text(node)
            self._known[node] = f"p{len(self._known) + 1}"
            lines.append(f"{self._known[node]} = {text if node.op in BOOLEAN_OPS else f'real({text})'}")
        return lines

    def _block_start(self) -> list[str]:
        loads = [f"{self._row(name)} = {name[:2]}[first + i, {'xyz'.index(name[3])}]" for name in self._inputs]
        self._known |= {self._symbols[name]: name for name in self._inputs if name in self._symbols}
        return [
            "work = np.empty(ROWS * BLOCK, real)",
            "bad = -1",
            "for first in range(start, stop, BLOCK):",
            "    count = min(BLOCK, stop - first)",
            "    for i in range(count):",
            *_indent(2, loads),
            "    off = 0",
            *_indent(1, self._loop(_DIRECTIONS)),
            "        wi2 = wi_x * wi_x + wi_y * wi_y + wi_z * wi_z",
            "        wo2 = wo_x * wo_x + wo_y * wo_y + wo_z * wo_z",
            "        off += where((abs(wi2 - ONE) < TOLERANCE) & (abs(wo2 - ONE) < TOLERANCE), 0, 1)",
            "    if off > 0 and bad < 0:",
            "        bad = first",
        ]

    def _fetch(self, fetch: Expr) -> list[str]:
        """Two loops: the coordinates of one lookup, then the lookup itself; its channels become known."""
        texture: TextureRef = fetch.value
        lines, statements = self._computed(fetch.args)
        coordinates = [self._row(f"{texture.name}_u{axis}_{fetch.index}") for axis in range(texture.dimensions)]
        lines += [f"    {row} = {statements.text(u)}" for row, u in zip(coordinates, fetch.args, strict=True)]
        channels = [f"{texture.name}_{channel}_{fetch.index}" for channel in range(texture.channels)]
        lines += lookup_loop(texture, coordinates, [self._row(name) for name in channels])
        for node in self._needed:
            if node.op == "channel" and node.args[0] is fetch:
                self._known[node] = channels[node.value]
        return lines

    def _shade(self) -> list[str]:
        lines, statements = self._computed(self._program.outputs)
        if self._has_horizon:
            lines += [*self._loads(["wi_z", "wo_z"]), "    lit = (wi_z > ZERO) & (wo_z > ZERO)"]
        for channel, output in enumerate(self._program.outputs):
            text = statements.text(output)
            lines.append(f"    value = {f'where(lit, {text}, ZERO)' if self._has_horizon else text}")
            lines.append(f"    {self._row(f'out{channel}')} = where(clamp & (value < ZERO), ZERO, value)")
        lines.append("for i in range(count):")
        return lines + [f"    out[first + i, {channel}] = {self._row(f'out{channel}')}" for channel in range(3)]

    def _computed(self, outputs: tuple[Expr, ...]) -> tuple[list[str], Statements]:
        """The head of a loop that computes some nodes: loads, then statements."""
        statements = Statements(VARYING, self._program.graph.names, self._known)
        statements.add(outputs)
        needed = (self._known[node] for node in reachable(outputs, stop=self._known) if node in self._known)
        lines = self._loop([name for name in needed if name in self._rows])
        return lines + [f"    {name} = {text}" for name, text in statements.lines], statements

    def _loop(self, names: list[str]) -> list[str]:
        return ["for i in range(count):", *self._loads(names)]

    def _loads(self, names: list[str]) -> list[str]:
        return [f"    {name} = {self._rows[name]}" for name in names]


def _indent(levels: int, lines: list[str]) -> list[str]:
    return ["    " * levels + line for line in lines]
