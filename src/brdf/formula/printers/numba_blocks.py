"""The body of a generated numba kernel: a graph evaluated block by block.

Within a block everything lives in one work array, component by component, so that each loop is plain arithmetic on
contiguous rows of constant distance, which LLVM turns into SIMD code. Texture lookups gather and therefore get a loop
of their own: one loop computes their coordinates, one fetches, the last goes on with the fetched channels. What depends
on parameters alone is computed once a call, in float64.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from ..graph import BOOLEAN_OPS, Expr, TextureRef, reachable
from .numba_dialect import UNIFORM, VARYING
from .numba_lookup import lookup_loop
from .statements import Statements

BLOCK = 512
"""Pairs a block: the work array of a typical model fits the first-level cache, its derivatives the second."""


class Blocks:
    """Lines of a kernel that computes `outputs` from `inputs`, which are numbers of each pair, and parameters."""

    def __init__(self, outputs: Sequence[Expr], inputs: Sequence[Expr]) -> None:
        self._outputs = tuple(outputs)
        self._names = self._outputs[0].graph.names
        self._needed = reachable(self._outputs)
        self._varying = set(inputs)
        for node in self._needed:
            if node.op == "texture" or any(argument in self._varying for argument in node.args):
                self._varying.add(node)
        self._rows: dict[str, str] = {}
        """What the work array holds: name -> the current pair's element."""
        self._known: dict[Expr, str] = {}
        """Nodes computed before the current loop -> the name they have in it."""

    @property
    def rows(self) -> int:
        """How many the work array has."""
        return len(self._rows)

    def row(self, name: str) -> str:
        """The current pair's element of a row of the work array; rows lie in the order they are first asked for."""
        return self._rows.setdefault(name, f"work[{len(self._rows) * BLOCK} + i]")

    def uses(self, node: Expr) -> bool:
        """Whether the outputs depend on it."""
        return node in self._needed

    def is_given(self, node: Expr, name: str) -> None:
        """An input that loops find in the row `name`."""
        self._known[node] = name

    def uniform(self, parameters: Mapping[Expr, str]) -> list[str]:
        """Parameters under the names given, in the order of their values, and what follows from them alone."""
        needed = set(self._needed)
        used = {node: name for node, name in parameters.items() if node in needed}
        places = {node: index for index, node in enumerate(parameters)}
        lines = [f"{name} = parameters[{places[node]}]" for node, name in used.items()]
        edge = {argument for node in self._varying & needed for argument in node.args} | set(self._outputs)
        wanted = [n for n in edge if n not in self._varying and n.op != "constant"]
        wanted.sort(key=lambda node: node.index)
        statements = Statements(UNIFORM, self._names, used)
        statements.add(wanted)
        lines += [f"{name} = {text}" for name, text in statements.lines]
        for number, node in enumerate(wanted):
            text, self._known[node] = statements.text(node), f"p{number + 1}"
            lines.append(f"p{number + 1} = {text if node.op in BOOLEAN_OPS else f'real({text})'}")
        return lines

    def fetches(self) -> list[str]:
        """Two loops a lookup: its coordinates, then the lookup itself; its channels become known."""
        lines = []
        for fetch in (node for node in self._needed if node.op == "texture"):
            texture: TextureRef = fetch.value
            own, statements = self.computed(fetch.args)
            coordinates = [self.row(f"{texture.name}_u{axis}_{fetch.index}") for axis in range(texture.dimensions)]
            own += [f"    {row} = {statements.text(u)}" for row, u in zip(coordinates, fetch.args, strict=True)]
            channels = [f"{texture.name}_{channel}_{fetch.index}" for channel in range(texture.channels)]
            own += lookup_loop(texture, coordinates, [self.row(name) for name in channels])
            lines += _renamed(own, f"_{fetch.index}")
            for node in self._needed:
                if node.op == "channel" and node.args[0] is fetch:
                    self._known[node] = channels[node.value]
        return lines

    def computed(self, outputs: Sequence[Expr]) -> tuple[list[str], Statements]:
        """The head of a loop that computes some nodes: loads, then statements."""
        statements = Statements(VARYING, self._names, self._known)
        statements.add(outputs)
        needed = (self._known[node] for node in reachable(outputs, stop=self._known) if node in self._known)
        lines = self.loop([name for name in needed if name in self._rows])
        return lines + [f"    {name} = {text}" for name, text in statements.lines], statements

    def loop(self, names: Sequence[str]) -> list[str]:
        """The head of a loop over a block, with some rows loaded."""
        return ["for i in range(count):", *self.loads(names)]

    def loads(self, names: Sequence[str]) -> list[str]:
        return [f"    {name} = {self._rows[name]}" for name in names]


def _renamed(lines: Sequence[str], suffix: str) -> list[str]:
    """With a suffix to all names that they assign: numba takes minutes where many loops assign the same ones."""
    text = "\n".join(lines)
    names = set(re.findall(r"^\s*(\w+) \+?= ", text, re.MULTILINE))
    return re.sub(r"\b[A-Za-z_]\w*\b", lambda m: m[0] + suffix if m[0] in names else m[0], text).split("\n")


def indented(levels: int, lines: Sequence[str]) -> list[str]:
    return ["    " * levels + line for line in lines]
