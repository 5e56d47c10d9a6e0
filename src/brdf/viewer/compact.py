"""Scripts without comments and needless space, for pages that are sent around; what they do stays the same."""

from __future__ import annotations

import re
from collections.abc import Iterator

PLAIN = re.compile(
    r"""(?P<comment>//[^\n]*|/\*.*?\*/)
    |(?P<space>\s+)
    |(?P<text>"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*')
    |(?P<word>[\w$]+)
    |(?P<mark>=>|\+\+|--|[^\w\s])""",
    re.S | re.X,
)
REGULAR = re.compile(r"/(?:\\.|\[(?:\\.|[^\]\\\n])*\]|[^/\\\[\n])+/[a-z]*")

SHADER = "/* glsl */"
"""Before a template literal whose text is a shader without preprocessor lines."""

BEFORE_VALUES = frozenset({"return", "typeof", "case", "of", "in", "do", "else", "void", "delete", "await", "yield"})
"""Words after which a slash begins a regular expression; after other words it divides."""

OPEN_ENDED = frozenset("{([,;=&|?:<>*%!~^.}") | {"=>"}
"""Marks after which no statement ends at the end of a line, or has ended anyway: those that end in a brace are blocks,
for others have a semicolon behind it."""

CONTINUING = frozenset("})],;=&|?:<>*%.") | {"=>"}
"""Marks before which none does."""


def compacted(text: str) -> str:
    """The script in fewer characters. Line ends at which a statement may end are kept."""
    out: list[str] = []
    last, gap, is_shader = "", "", False
    for kind, token in tokens(text):
        if kind in ("comment", "space"):
            gap = "\n" if "\n" in token or gap == "\n" else " "
            is_shader |= token == SHADER
            continue
        if is_shader:
            token, is_shader = _compacted_shader(token), False
        if gap == "\n" and last and last not in OPEN_ENDED and token not in CONTINUING:
            out.append("\n")
        elif gap and (_joins(last[-1:], token[0])):
            out.append(" ")
        out.append(token)
        last, gap = token, ""
    return "".join(out) + "\n"


def _compacted_shader(template: str) -> str:
    """A template literal of GLSL in fewer characters; its expressions stay as they are."""
    parts = []
    for is_text, part in template_parts(template):
        if is_text:
            plain = re.sub(r"\s+", " ", re.sub(r"//[^\n]*", "", part))
            part = re.sub(r" ?([=*/<>?:,;(){}&|!`]) ?", r"\1", plain)
        parts.append(part)
    return "".join(parts)


def compacted_style(text: str) -> str:
    """A style sheet in fewer characters."""
    parts = re.split(r'("[^"]*")', re.sub(r"/\*.*?\*/", "", text, flags=re.S))
    for i in range(0, len(parts), 2):  # every second one is a string
        short = re.sub(r"\s+", " ", re.sub(r"\s*([{};,>])\s*", r"\1", parts[i]))
        parts[i] = re.sub(r":\s+", ":", short).replace(";}", "}")
    return "".join(parts).strip() + "\n"


def _joins(left: str, right: str) -> bool:
    """Whether two characters mean something else without space between them."""
    word = re.compile(r"[\w$]")
    return bool(word.match(left) and word.match(right)) or (left == right and left in "+-")


def tokens(text: str) -> Iterator[tuple[str, str]]:
    """Kind and text of each token. Raises ValueError for a template without end."""
    at, last = 0, ""
    while at < len(text):
        if text[at] == "`":
            end = _template_end(text, at)
            kind, token = "text", text[at:end]
        elif text[at] == "/" and text[at + 1 : at + 2] not in ("/", "*") and _expects_value(last):
            kind, token = "text", REGULAR.match(text, at)[0]  # type: ignore[index]
        else:
            match = PLAIN.match(text, at)
            assert match is not None
            kind, token = str(match.lastgroup), match[0]
        yield kind, token
        at += len(token)
        if kind not in ("comment", "space"):
            last = token


def _expects_value(last: str) -> bool:
    if re.fullmatch(r"[\w$]+", last):
        return last in BEFORE_VALUES
    return last not in (")", "]", "}", "++", "--") and last[:1] not in ("'", '"', "`")


def _template_end(text: str, start: int) -> int:
    """Behind the template literal that begins at `start`."""
    return start + sum(len(part) for _, part in template_parts(text[start:]))


def template_parts(text: str) -> Iterator[tuple[bool, str]]:
    """The template literal that `text` begins with: whether a part is text, which has the braces around expressions, or
    an expression, and what it says. Raises ValueError for one without end."""
    start, at = 0, 1
    while at < len(text):
        if text[at] == "\\":
            at += 2
        elif text[at] == "`":
            yield True, text[start : at + 1]
            return
        elif text.startswith("${", at):
            yield True, text[start : at + 2]
            start = at + 2
            at = _expression_end(text, start)
            yield False, text[start:at]
            start = at
        else:
            at += 1
    raise ValueError("a template literal has no end")


def _expression_end(text: str, at: int) -> int:
    """The brace that ends the expression within a template which begins at `at`."""
    depth = 1
    for kind, token in tokens(text[at:]):
        depth += (token == "{") - (token == "}") if kind == "mark" else 0
        if not depth:
            return at
        at += len(token)
    raise ValueError("a template literal has no end")
