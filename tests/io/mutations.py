"""Files broken at random, to read: what readers must refuse in one line."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from brdf import io
from brdf.errors import FileError
from brdf.io import alta, astm, gonio

NUMBERS = (b"nan", b"-inf", b"1e999", b"-1", b"0", b"99999999999999999999", b"1e-320", b"4294967295", b"0x10", b"")
WORDS = (
    b"\0",
    b"\xff" * 8,
    b"\x7f" * 4,
    b"\n",
    b"#",
    b"[",
    b"(" * 300,
    b"<a>",
    b"&x;",
    b"::begin",
    b"DataBegin\n",
    b",",
)

PARSERS: dict[str, Callable[[Path], Any]] = {
    "ALTA text": alta.read_samples,
    "ASTM E1392 text": astm.read_rows,
    "goniometer text": gonio.read_rows,
}
"""Of formats whose measurements are interpolated once they are read, which takes longer than reading them."""


def mutated(data: bytes, rng: np.random.Generator) -> bytes:
    """One to four changes of `data`."""
    for _ in range(rng.integers(1, 5)):
        data = CHANGES[rng.integers(len(CHANGES))](data, rng)
    return data


def _span(data: bytes, rng: np.random.Generator, most: int = 64) -> tuple[int, int]:
    start = int(rng.integers(len(data) + 1))
    return start, min(start + int(rng.integers(1, most)), len(data))


def _flip(data: bytes, rng: np.random.Generator) -> bytes:
    changed = bytearray(data)
    for place in rng.integers(max(len(data), 1), size=rng.integers(1, 8)):
        if changed:
            changed[place] = rng.integers(256)
    return bytes(changed)


def _cut(data: bytes, rng: np.random.Generator) -> bytes:
    start, end = _span(data, rng)
    return data[:start] + data[end:]


def _truncate(data: bytes, rng: np.random.Generator) -> bytes:
    return data[: rng.integers(len(data) + 1)]


def _repeat(data: bytes, rng: np.random.Generator) -> bytes:
    start, end = _span(data, rng, 400)
    return data[:end] + data[start:end] * int(rng.integers(1, 4)) + data[end:]


def _insert(data: bytes, rng: np.random.Generator) -> bytes:
    place = int(rng.integers(len(data) + 1))
    return data[:place] + WORDS[rng.integers(len(WORDS))] + data[place:]


def _number(data: bytes, rng: np.random.Generator) -> bytes:
    found = [match.span() for match in re.finditer(rb"[-+]?\d[\d.eE+-]*", data[:20000])]
    if not found:
        return _flip(data, rng)
    start, end = found[rng.integers(len(found))]
    return data[:start] + NUMBERS[rng.integers(len(NUMBERS))] + data[end:]


def _word(data: bytes, rng: np.random.Generator) -> bytes:
    """Four or eight bytes near the start, where headers are, become an extreme number."""
    width = int(rng.choice([2, 4, 8]))
    place = int(rng.integers(min(len(data), 600) + 1))
    value = (
        int(rng.choice([0, 1, 2**15, 2**16 - 1]))
        if width == 2
        else int(rng.choice([0, 1, 2**31 - 1, 2**31, 2**32 - 1]))
    )
    return data[:place] + value.to_bytes(width, "little") + data[place + width :]


CHANGES = (_flip, _cut, _truncate, _repeat, _insert, _number, _word)


def refused(name: str, path: Path) -> str | None:
    """Read a file of the named format; the message if it is refused. Every other exception is the reader's fault."""
    format_ = next(f for f in io.registry._all() if f.name == name)
    try:
        if name in PARSERS:
            PARSERS[name](path)
        elif format_.members is not None:
            for make in list(format_.members(path).values())[:3]:
                make()
        else:
            format_.reader(path)
    except FileError as error:
        return str(error)
    return None
