"""Which formats there are, which one a file is in, reading and writing by it.

A module of this folder enters its format by defining `FORMAT`. A file is recognised by its content; its
extension decides only between formats that both accept the content, and for formats without a signature of
their own.
"""

from __future__ import annotations

import functools
import importlib
import os
import pkgutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from .. import inputs
from ..errors import CorruptFileError, FileError, UnknownFormatError, UnknownNameError
from ..reflectance import Reflectance

HEAD_BYTES = 8192
"""How much of a file the formats may look at to recognise it."""


@dataclass(frozen=True)
class Format:
    """One file format: how it is recognised, read and written."""

    name: str
    extensions: tuple[str, ...]
    """Lower case, with the dot; the first is the usual one."""
    doc: str
    """One line."""
    recognises: Callable[[bytes, int], bool]
    """(the first bytes, size of the file) -> whether the content is in this format."""
    reader: Callable[[Path], Reflectance] | None = None
    writer: Callable[[Reflectance, Path], None] | None = None
    has_signature: bool = True
    """Without one, a file that nothing recognises is still read by its extension, so that the error names the fault."""
    folder_file: str | None = None
    """The file by which a folder is recognised, for a format that may be one."""
    members: Callable[[Path], Mapping[str, Callable[[], Reflectance]]] | None = None
    """For files that hold several materials: how each is made, by name, in the place of `reader`."""
    beside: Callable[[Path], list[Path]] = lambda path: []
    """The files beside one that are read with it, by its name."""

    @property
    def reads(self) -> bool:
        return self.reader is not None or self.members is not None


class FormatInfo(NamedTuple):
    """What `formats` lists."""

    name: str
    extensions: tuple[str, ...]
    reads: bool
    writes: bool
    doc: str


@functools.cache
def _all() -> tuple[Format, ...]:
    package = importlib.import_module(__package__)
    modules = [importlib.import_module(f"{__package__}.{m.name}") for m in pkgutil.iter_modules(package.__path__)]
    found = [module.FORMAT for module in modules if hasattr(module, "FORMAT")]
    return tuple(sorted(found, key=lambda f: f.name))


def formats() -> list[FormatInfo]:
    """Every format, by name."""
    return [FormatInfo(f.name, f.extensions, f.reads, f.writer is not None, f.doc) for f in _all()]


def read(path: str | os.PathLike[str], member: str | None = None) -> Reflectance:
    """The reflectance in a file of any known format; of several in one file, the one called `member`.

    Its `name` is the file's stem unless the file holds one, its `source` says which file it was. Raises
    FileError (missing, a folder, not readable), UnknownFormatError (content of no known format),
    CorruptFileError (broken content), UnknownNameError for a member that is not there.
    """
    path = Path(path)
    inputs.note(path)
    format_ = format_of(path)
    try:
        if format_.members is not None:
            return _member(path, format_.members(path), member)
        if member is not None:
            raise FileError(path, f"holds one material, none called {member!r}; leave @{member} out.")
        assert format_.reader is not None
        return format_.reader(path)
    except OSError as error:
        raise FileError(path, f"cannot be read ({error.strerror or error}).") from None


def files_with(path: Path) -> list[Path]:
    """What is read where a file is named: the folder that it describes, or it and those beside it that belong to it."""
    if path.name in [f.folder_file for f in _all()]:
        return [path.parent]
    return [path, *(other for f in _all() for other in f.beside(path))]


def members(path: str | os.PathLike[str]) -> list[str]:
    """The names of the materials in a file that holds several, [] for every other. Raises as `read`."""
    format_ = format_of(path)
    return [] if format_.members is None else list(format_.members(Path(path)))


def _member(path: Path, made: Mapping[str, Callable[[], Reflectance]], name: str | None) -> Reflectance:
    if name is None:
        if len(made) > 1:
            first, *_, last = made
            choice = f"choose one as in {path.name}@{first}"
            raise FileError(path, f"holds {len(made)} materials, {first} to {last}; {choice}.")
        name = next(iter(made))
    if name not in made:
        raise UnknownNameError(f"material in {path}", name, made)
    return made[name]()


def write(reflectance: Reflectance, path: str | os.PathLike[str], format: str | None = None) -> None:
    """Write in the format of the path's extension, or the one that is named; the file is replaced whole or not at all.

    A path that ends in a slash, or an existing folder, is written as a folder. Raises UnknownFormatError for an
    extension that no format writes, UnknownNameError for a name that no format has that is written, FileError when the
    place cannot be written, ReflectanceError when the format cannot hold this reflectance.
    """
    if format is not None:
        return _written(format)(reflectance, Path(path))
    is_folder = os.fspath(path).endswith(("/", os.sep)) or os.path.isdir(path)
    path = Path(path)
    extension = path.suffix.lower()
    writers = [f for f in _all() if f.writer is not None]
    for format_ in writers:
        fits = format_.folder_file is not None if is_folder else extension in format_.extensions
        if fits and format_.writer is not None:
            return format_.writer(reflectance, path)
    given = f"no format is written with the extension {extension!r}" if extension else "the name has no extension"
    known = ", ".join(f"{f.extensions[0]} ({f.name})" for f in writers)
    raise UnknownFormatError(path, f"{given}; written: {known}.")


def slug(name: str) -> str:
    """A format's name as it is typed: lower case, with hyphens."""
    return name.lower().replace(" ", "-")


def _written(name: str) -> Callable[[Reflectance, Path], None]:
    writers = {slug(f.name): f.writer for f in _all() if f.writer is not None}
    if slug(name) not in writers:
        raise UnknownNameError("format that is written", name, writers)
    return writers[slug(name)]


def format_of(path: str | os.PathLike[str]) -> Format:
    """The format that reads the file, by its content. Raises as `read`."""
    path = Path(path)
    if path.is_dir():
        return _format_of_folder(path)
    if not path.exists():
        raise FileError(path, "no such file; check the path.")
    if not path.is_file():
        raise FileError(path, "is not a regular file; copy its content to one first.")
    try:
        size = path.stat().st_size
        with path.open("rb") as file:
            head = file.read(HEAD_BYTES)
    except OSError as error:
        raise FileError(path, f"cannot be read ({error.strerror}).") from None
    if not head:
        raise CorruptFileError(path, "is empty (0 bytes); fetch or write it again.")

    readers = [f for f in _all() if f.reads]
    by_content = [f for f in readers if f.recognises(head, size)]
    by_extension = [f for f in readers if path.suffix.lower() in f.extensions]
    for format_ in by_content:
        if len(by_content) == 1 or format_ in by_extension:
            return format_
    if by_content:
        return by_content[0]
    for format_ in by_extension:
        if not format_.has_signature:
            return format_
    known = ", ".join(f"{f.name} ({' '.join(f.extensions)})" for f in readers)
    raise UnknownFormatError(path, f"its content is of no known format; read: {known}.")


def _format_of_folder(path: Path) -> Format:
    folders = [f for f in _all() if f.reader is not None and f.folder_file is not None]
    for format_ in folders:
        if (path / str(format_.folder_file)).is_file():
            return format_
    known = ", ".join(f"{f.folder_file} ({f.name})" for f in folders)
    raise FileError(path, f"is a folder without {known}; give a file.")
