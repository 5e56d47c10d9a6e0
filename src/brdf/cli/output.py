"""What the verbs print: tables for people, JSON for scripts, a sign of life while something takes its time."""

from __future__ import annotations

import contextlib
import json
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from typing import Any


def print_json(data: Any) -> None:
    """`data` as JSON on standard output; infinities are written as null, since JSON has none."""
    print(json.dumps(_plain(data), indent=2, ensure_ascii=False, allow_nan=False))


def _plain(data: Any) -> Any:
    if isinstance(data, dict):
        return {str(key): _plain(value) for key, value in data.items()}
    if isinstance(data, (list, tuple)):
        return [_plain(value) for value in data]
    if hasattr(data, "tolist"):
        return _plain(data.tolist())
    if isinstance(data, float) and not abs(data) < float("inf"):
        return None
    return data


def print_table(header: Sequence[str], rows: Sequence[Sequence[str]], indent: str = "") -> None:
    """A table on standard output: the first column to the left, the others to the right where they are numbers."""
    columns = list(zip(header, *rows, strict=True))
    widths = [max(len(cell) for cell in column) for column in columns]
    numeric = [i > 0 and all(_is_number(cell) for cell in column[1:]) for i, column in enumerate(columns)]
    for row in (header, ["─" * width for width in widths], *rows):
        cells = (
            cell.rjust(width) if right else cell.ljust(width)
            for cell, width, right in zip(row, widths, numeric, strict=True)
        )
        print(indent + "  ".join(cells).rstrip())


def _is_number(cell: str) -> bool:
    return not cell or cell.lstrip("-")[:1].isdigit()


def format_bytes(count: int) -> str:
    """`16,384 B`, and in KB or MB (of 1024) beside it when that is easier to read."""
    for size, unit in ((1 << 20, "MB"), (1 << 10, "KB")):
        if count >= size:
            return f"{count:,} B ({count / size:.3g} {unit})"
    return f"{count:,} B"


def note(message: str) -> None:
    """A remark for a person, kept out of standard output."""
    print(f"brdf: {message}", file=sys.stderr)


@contextlib.contextmanager
def working(what: str) -> Iterator[Callable[[str], None]]:
    """Shows that something is under way, when standard error is a terminal; gives a function that says what now."""
    if not sys.stderr.isatty():
        yield lambda text: None
        return
    from rich.console import Console

    with Console(stderr=True).status(what) as status:
        yield status.update


class _ProbedError(Exception):
    """Ends a trial write."""


def require_writable(path: str | os.PathLike[str]) -> None:
    """Fail before the work rather than after it. Raises FileError for a path that cannot be written."""
    from ..container import replacing

    with contextlib.suppress(_ProbedError), replacing(path):
        raise _ProbedError
