"""Graph to statements: what every printer shares.

A node becomes a named variable when it is used more than once or the formula named it; otherwise it is written in
place, so that what is printed reads like what was written.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from ..graph import Expr, reachable

_LONGEST_INLINE = 100
"""Characters; longer expressions get a variable of their own."""

_OPERATORS = {"or": ("|", 1), "and": ("&", 2), "lt": ("<", 3), "le": ("<=", 3), "add": ("+", 4), "sub": ("-", 4),
              "mul": ("*", 5), "div": ("/", 5)}  # fmt: skip
"""Sign and binding strength."""

_ATOM = 9


@dataclass(frozen=True)
class Dialect:
    """How a language spells things."""

    constant: Callable[[float | bool], str]
    call: Callable[[str, list[str]], str]
    """Name of the operation, printed arguments -> text."""
    negation: Callable[[str], str]
    reserved: frozenset[str] = frozenset()
    declared: Callable[[Expr, str], str] = lambda node, name: name
    """A node and the name of its variable -> what stands to the left of the equals sign."""
    in_place: Callable[[Expr], bool] = lambda node: node.op == "constant"
    """Whether a node never gets a variable: it costs nothing."""
    doubled: bool = False
    """Whether `and` and `or` are spelt && and ||."""


class Statements:
    """Collects `name = expression` lines for the nodes that some outputs need."""

    def __init__(self, dialect: Dialect, names: dict[Expr, str], known: dict[Expr, str]) -> None:
        """`names`: preferred names; `known`: nodes that exist already under a name (symbols, earlier results)."""
        self._dialect = dialect
        self._preferred = names
        self._text: dict[Expr, tuple[str, int]] = {node: (name, _ATOM) for node, name in known.items()}
        self._taken = Counter(known.values())
        self.lines: list[tuple[str, str]] = []
        """(name, expression) in order."""

    def add(self, outputs: Iterable[Expr]) -> None:
        """Write what the outputs need."""
        outputs = list(outputs)
        needed = [node for node in reachable(outputs, stop=self._text) if node not in self._text]
        uses = Counter(argument for node in needed for argument in node.args)
        uses.update(outputs)
        for node in needed:
            text, level = self._expression(node)
            wants_name = node in self._preferred or uses[node] > 1 or len(text) > _LONGEST_INLINE
            if wants_name and not self._dialect.in_place(node):
                name = self._fresh(self._preferred.get(node, "t"))
                self.lines.append((self._dialect.declared(node, name), text))
                text, level = name, _ATOM
            self._text[node] = (text, level)

    def text(self, node: Expr) -> str:
        """The printed form of a node that was added."""
        return self._text[node][0]

    def _fresh(self, name: str) -> str:
        candidate, number = (name, 1) if name != "t" else ("t1", 1)
        while self._taken[candidate] or candidate in self._dialect.reserved:
            number += 1
            candidate = f"{name}{number}"
        self._taken[candidate] += 1
        return candidate

    def _argument(self, node: Expr, level: int) -> str:
        text, own = self._text[node]
        return text if own >= level else f"({text})"

    def _expression(self, node: Expr) -> tuple[str, int]:
        if node.op == "constant":
            text = self._dialect.constant(node.value)
            return text, _ATOM if not text.startswith("-") else 0
        if node.op in _OPERATORS:
            sign, level = _OPERATORS[node.op]
            left, right = node.args
            if node.op in ("and", "or"):  # languages differ in whether these bind more tightly than comparisons
                sign *= 1 + self._dialect.doubled
                return f"{self._argument(left, _ATOM)} {sign} {self._argument(right, _ATOM)}", level
            comparison = level == 3
            return (
                f"{self._argument(left, level + comparison)} {sign} {self._argument(right, level + 1)}",
                level,
            )
        if node.op == "neg":
            return f"-{self._argument(node.args[0], 6)}", 4
        if node.op == "not":
            return self._dialect.negation(self._argument(node.args[0], _ATOM)), _ATOM
        return self._dialect.call(node.op, [self._text[a][0] for a in node.args]), _ATOM
