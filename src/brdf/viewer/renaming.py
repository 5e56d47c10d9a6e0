"""Short names for what a script declares for itself, and declarations in a row joined; what it does stays the same.

Names are given scope by scope, the outer ones first: a declaration gets the first short name that no other of its scope
has, nor anything from outside that is used within it. Properties keep their names. The syntax is that of the viewer's
modules, whose types are checked: statements end in semicolons; no labels, no `var`, no `eval`.
"""

from __future__ import annotations

import string
from bisect import bisect_right
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import product

from .compact import template_parts, tokens

WORDS = """
    arguments as async await break case catch class const constructor continue debugger default delete do else enum
    export extends false finally for from function get if import in instanceof let new null of return set static super
    switch this throw true try typeof undefined void while with yield
"""
RESERVED = frozenset(WORDS.split())

BEFORE_OBJECTS = frozenset("(,=:[?&|!.") | {"return", "const", "let", "default"}
"""Tokens after which a brace opens an object or a pattern, not a block."""

BEFORE_KEYS = frozenset("{,*") | {"get", "set", "async"}
BEFORE_MEMBERS = frozenset("{};*") | {"get", "set", "async", "static"}

LETTERS = "etnaoirslcdupmfhgvbxywkjqz" + string.ascii_uppercase


@dataclass(eq=False)
class Scope:
    """Tokens `start` to `end`, between which names are declared that nothing else sees."""

    start: int
    end: int
    parent: Scope | None = None
    names: dict[str, str] = field(default_factory=dict)
    """Short names of what it declares; empty ones while they are not given."""
    uses: Counter[str] = field(default_factory=Counter)
    """How often what it declares is used."""
    foreign: set[tuple[str, Scope | None]] = field(default_factory=set)
    """What is used within and declared outside, with the scope that does; None for what the browser has."""

    def declaring(self, name: str) -> Scope | None:
        scope: Scope | None = self
        while scope is not None and name not in scope.names:
            scope = scope.parent
        return scope


def renamed(text: str) -> str:
    """A module, or a function around it, with short names."""
    return _Module(text).renamed()


class _Module:
    """Tokens but space and comments, by number: their text, their kind, what they stand in, a bracket's other end."""

    def __init__(self, text: str) -> None:
        self._all = list(_split(text))
        self._places = [i for i, (kind, _) in enumerate(self._all) if kind not in ("comment", "space")]
        self._kinds = [self._all[i][0] for i in self._places]
        self._texts = [self._all[i][1] for i in self._places]
        self._other: dict[int, int] = {}
        self._inside: list[str] = []
        self._match()
        self._roles = [self._role(n) for n in range(len(self._texts))]
        self._scopes = self._nested()
        self._lists: list[tuple[int, int]] = []
        self._declare()

    def _text(self, n: int) -> str:
        return self._texts[n] if 0 <= n < len(self._texts) else ""

    # ---- brackets and words ------------------------------------------------------------------------------------

    def _match(self) -> None:
        open_ = [("block", -1)]
        for n, (kind, text) in enumerate(zip(self._kinds, self._texts, strict=True)):
            if kind == "close" or (kind == "mark" and text in "}])"):
                _, start = open_.pop()
                self._other |= {n: start, start: n}
            self._inside.append(open_[-1][0])
            if kind == "open" or (kind == "mark" and text in "(["):
                open_.append(("list", n))
            elif kind == "mark" and text == "{":
                is_class = self._text(n - 2) in ("class", "extends")
                is_object = self._text(n - 1) in BEFORE_OBJECTS
                open_.append(("class" if is_class else "object" if is_object else "block", n))

    def _role(self, n: int) -> str:
        """Of a word: "name"; "short" for one that is property and name at once; "" for properties and reserved ones."""
        word, before, after, inside = self._texts[n], self._text(n - 1), self._text(n + 1), self._inside[n]
        if self._kinds[n] != "word" or word[0].isdigit() or word in RESERVED:
            return ""
        if before == "." and self._text(n - 2) != ".":
            return ""
        if inside == "object" and before in BEFORE_KEYS and after in (":", "("):
            return ""
        if inside == "class" and before in BEFORE_MEMBERS and after in ("(", "=", ";"):
            return ""
        return "short" if inside == "object" and before in ("{", ",") and after in (",", "}", "=") else "name"

    # ---- scopes ------------------------------------------------------------------------------------------------

    def _nested(self) -> list[Scope]:
        """All scopes, outer ones first."""
        spans = {(0, len(self._texts))}
        for n, text in enumerate(self._texts):
            if text == "=>":
                start = self._other[n - 1] if self._text(n - 1) == ")" else n - 1
                spans.add((start, self._expression_end(n + 1)))
            elif text == "(" and self._text(n - 1) == "for":
                spans.add((n, self._statement_end(self._other[n] + 1)))
            elif text == "{" and self._kinds[n] == "mark" and self._is_block(n):
                head = self._other[n - 1] if self._text(n - 1) == ")" else n
                spans.add((head, self._other[n]))
        scopes: list[Scope] = []
        for start, end in sorted(spans, key=lambda span: (span[0], -span[1])):
            parent = next((scope for scope in reversed(scopes) if scope.end >= end and scope.start <= start), None)
            scopes.append(Scope(start, end, parent))
        return scopes

    def _is_block(self, n: int) -> bool:
        """Whether a brace opens a block of its own, which a function's behind an arrow is not."""
        is_class = self._text(n - 2) in ("class", "extends")
        return not is_class and self._text(n - 1) not in BEFORE_OBJECTS and self._text(n - 1) != "=>"

    def _expression_end(self, n: int) -> int:
        """The last token of what is right of an arrow."""
        if self._text(n) == "{":
            return self._other[n]
        while self._text(n) not in (",", ";", ")", "]", "}", "") and self._kinds[n] != "close":
            n = self._other.get(n, n) + 1
        return n - 1

    def _statement_end(self, n: int) -> int:
        if self._text(n) == "{":
            return self._other[n]
        if self._text(n) in ("for", "if", "while"):
            end = self._statement_end(self._other[n + 1] + 1)
            return self._statement_end(end + 2) if self._text(end + 1) == "else" else end
        while self._text(n) != ";":
            n = self._other.get(n, n) + 1
        return n

    def _scope_at(self, n: int) -> Scope:
        """The innermost scope of a token."""
        last = bisect_right(self._scopes, n, key=lambda scope: scope.start) - 1
        scope = self._scopes[last]
        while scope.end < n:
            assert scope.parent is not None
            scope = scope.parent
        return scope

    # ---- declarations ------------------------------------------------------------------------------------------

    def _declare(self) -> None:
        for n, text in enumerate(self._texts):
            if text in ("const", "let") and self._kinds[n] == "word" and self._text(n - 1) != ".":
                self._lists.append((n, self._declare_list(n + 1)))
            elif text in ("function", "class") and self._kinds[n] == "word":
                self._declare_one(n + 1 + (self._text(n + 1) == "*"))
            elif text == "=>":
                if self._text(n - 1) == ")":
                    self._declare_pattern(self._other[n - 1])
                else:
                    self._declare_one(n - 1)
            elif text == ")" and self._text(n + 1) == "{" and self._takes_parameters(self._other[n]):
                self._declare_pattern(self._other[n])

    def _takes_parameters(self, n: int) -> bool:
        return self._text(n - 1) not in ("if", "for", "while", "switch")

    def _declare_list(self, n: int) -> int:
        """What `const` or `let` declares: `a = 1, { b } = c`; gives the token behind it."""
        while True:
            n = self._declare_one(n)
            while self._text(n) not in (",", ";", "of", "in", ")"):
                n = self._other.get(n, n) + 1
            if self._text(n) != ",":
                return n
            n += 1

    def _declare_one(self, n: int) -> int:
        """A name or a pattern; gives the token behind it."""
        if self._text(n) in ("{", "["):
            self._declare_pattern(n)
            return self._other[n] + 1
        if self._roles[n]:
            self._scope_at(n).names[self._texts[n]] = ""
        return n + 1

    def _declare_pattern(self, start: int) -> None:
        """Everything that the bracket's parts bind, not what their defaults use."""
        n, end = start + 1, self._other[start]
        while n < end:
            if self._text(n + 1) == ":" and not self._roles[n]:
                n += 2
            elif self._text(n) in (",", "."):
                n += 1
            else:
                n = self._declare_one(n)
                while n < end and self._text(n) != ",":  # its default
                    n = self._other.get(n, n) + 1

    # ---- names -------------------------------------------------------------------------------------------------

    def renamed(self) -> str:
        owners = [self._use(n) if role else None for n, role in enumerate(self._roles)]
        for scope in self._scopes:
            taken = {name if owner is None else owner.names[name] for name, owner in scope.foreign}
            fresh = (name for name in _short_names() if name not in taken)
            for name, _ in scope.uses.most_common():
                scope.names[name] = next(fresh)
        texts = [text for _, text in self._all]
        for n, owner in enumerate(owners):
            if owner is not None:
                word = self._texts[n]
                short = owner.names[word]
                texts[self._places[n]] = f"{word}:{short}" if self._roles[n] == "short" else short
        for n, text in enumerate(self._texts):
            if text == ";" and self._text(n + 1) == "}" and not self._is_empty(n):
                texts[self._places[n]] = ""
        followed = {start for start, _ in self._lists}
        for start, end in self._lists:
            texts[self._places[start]] = texts[self._places[start]] and "let"
            if self._text(end) == ";" and end + 1 in followed:
                texts[self._places[end]], texts[self._places[end + 1]] = ",", ""
        return "".join(texts)

    def _is_empty(self, n: int) -> bool:
        """Whether a semicolon is a statement, all that a loop does."""
        return self._text(n - 1) == ")" and self._text(self._other[n - 1] - 1) in ("for", "while", "if")

    def _use(self, n: int) -> Scope | None:
        """The scope that declares a name, which learns of its use; so do those that it is foreign to."""
        name = self._texts[n]
        scope: Scope | None = self._scope_at(n)
        assert scope is not None
        owner = scope.declaring(name)
        if owner is not None:
            owner.uses[name] += 1
        while scope is not owner and scope is not None:
            scope.foreign.add((name, owner))
            scope = scope.parent
        return owner


def _short_names() -> Iterator[str]:
    for length in (1, 2, 3):
        for letters in product(LETTERS, repeat=length):
            name = "".join(letters)
            if name not in RESERVED:
                yield name


def _split(text: str) -> Iterator[tuple[str, str]]:
    """Kind and text of each token; what stands in a template's braces becomes tokens between "open" and "close"."""
    for kind, token in tokens(text):
        if token[0] != "`":
            yield kind, token
            continue
        for is_text, part in template_parts(token):
            if is_text:
                yield ("open" if part.endswith("${") else "text"), part
            else:
                yield from _split(part)
                yield "close", ""
