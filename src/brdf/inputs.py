"""What a command has read, so that its results do not replace it: a measurement may exist only once."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from contextvars import ContextVar
from pathlib import Path

from .errors import FileError

_read: ContextVar[list[Path] | None] = ContextVar("read", default=None)


@contextlib.contextmanager
def kept() -> Iterator[None]:
    """Within the block nothing is written in the place of what was read in it, or in a block around it."""
    token = _read.set([*(_read.get() or ())])
    try:
        yield
    finally:
        _read.reset(token)


def note(path: str | os.PathLike[str]) -> None:
    """To be called by whatever reads a file, or a folder, that a user names."""
    files = _read.get()
    if files is not None:
        files.append(Path(os.path.realpath(path)))


def require_other(target: str | os.PathLike[str]) -> None:
    """Raises FileError where writing `target`, a file or a folder, would replace what was read, by whatever name."""
    place = Path(os.path.realpath(target))
    for file in _read.get() or ():
        if place in file.parents:
            raise FileError(target, f"holds the input {file.name}; choose another place.")
        if file == place or (file.exists() and place.exists() and os.path.samefile(file, place)):
            raise FileError(target, "is the input itself; choose another place.")
