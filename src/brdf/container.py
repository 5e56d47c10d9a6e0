"""The file every reflectance saves to: safetensors with a JSON header.

Arrays are stored as they are; the header (under the key "brdf") holds the schema version, the kind of each
reflectance and its numbers. Nothing is ever unpickled, and a file is replaced whole or not at all.
"""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import CorruptFileError, FileError
from .inputs import require_other

SCHEMA = 1
"""Raised when a file written by this version cannot be read by earlier ones."""


@contextlib.contextmanager
def replacing(path: str | os.PathLike[str]) -> Iterator[Path]:
    """A temporary path beside `path`, renamed to it when the block ends well, removed when it does not.

    Of a symbolic link, what it points to is replaced.

    Raises FileError when the folder cannot be written, or `path` is an input (see `inputs`).
    """
    target = Path(path)
    require_other(target)
    try:
        place = Path(os.path.realpath(target))
        if target.is_dir():
            raise FileError(target, "is a folder; give a file name.")
        handle, name = tempfile.mkstemp(prefix=".brdf-", suffix=target.suffix, dir=place.parent)
    except OSError as error:
        raise FileError(target, f"cannot be written ({error.strerror}); choose another place.") from None
    os.close(handle)
    temporary = Path(name)
    try:
        yield temporary
        umask = os.umask(0)
        os.umask(umask)
        temporary.chmod(0o666 & ~umask)
        temporary.replace(place)
    finally:
        temporary.unlink(missing_ok=True)


@contextlib.contextmanager
def replacing_folder(path: str | os.PathLike[str]) -> Iterator[Path]:
    """A temporary folder beside `path`, renamed to it when the block ends well, removed when it does not.

    What was there goes only once the new one is in place; whether it may go is for the caller to say. Raises FileError
    when the parent folder cannot be written, or an input is in there (see `inputs`).
    """
    target = Path(path)
    require_other(target)
    try:
        temporary = Path(tempfile.mkdtemp(prefix=".brdf-", dir=target.absolute().parent))
    except OSError as error:
        raise FileError(target, f"cannot be written ({error.strerror}); choose another place.") from None
    new, old = temporary / "new", temporary / "old"
    new.mkdir()
    try:
        yield new
        if target.exists():
            target.rename(old)
        try:
            new.rename(target)
        except OSError:
            if old.exists():
                old.rename(target)
            raise
    finally:
        shutil.rmtree(temporary, ignore_errors=True)


def save(path: str | os.PathLike[str], header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> None:
    """Write header and arrays as one safetensors file."""
    from safetensors.numpy import save_file

    metadata = {"brdf": json.dumps({"schema": SCHEMA, **header}, allow_nan=False)}
    contiguous = {name: np.ascontiguousarray(array) for name, array in arrays.items()}
    with replacing(path) as temporary:
        save_file(contiguous, temporary, metadata)


def load(path: str | os.PathLike[str]) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """Header and arrays of a file written by `save`. Raises CorruptFileError when it is not one, FileError."""
    from safetensors import SafetensorError, safe_open

    try:
        with safe_open(path, framework="numpy") as file:
            metadata = file.metadata() or {}
            arrays = {name: file.get_tensor(name) for name in file.keys()}  # noqa: SIM118  (not a mapping)
    except SafetensorError as error:
        raise CorruptFileError(path, f"not a whole safetensors file ({error}).") from None
    except OSError as error:
        raise FileError(path, f"cannot be read ({error.strerror or error}).") from None
    try:
        header = json.loads(metadata["brdf"])
        schema = int(header["schema"])
    except (KeyError, TypeError, ValueError, OverflowError, RecursionError):
        raise CorruptFileError(path, "a safetensors file, but not one of brdf's (its header is missing).") from None
    if schema > SCHEMA:
        raise CorruptFileError(path, f"written by a newer brdf (schema {schema}, known {SCHEMA}); upgrade brdf.")
    return header, arrays
