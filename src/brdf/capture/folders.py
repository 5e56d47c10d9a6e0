"""Folders of results that appear whole or not at all."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from pathlib import Path

from ..container import replacing_folder
from ..errors import FileError


def require_free(target: Path, marker: str, overwrite: bool) -> None:
    """Raises FileError where a result may not go: on what is there already, or in a folder that cannot be written.

    `marker`: a file by which an earlier result is known, which alone may be replaced.
    """
    if target.exists() and not overwrite:
        raise FileError(target, "exists; choose another folder with -o, or replace it with --overwrite.")
    if target.exists() and not (target / marker).is_file() and (not target.is_dir() or any(target.iterdir())):
        raise FileError(target, "is no result of a capture; it is not replaced. Choose another folder with -o.")
    parent = target.absolute().parent
    if not parent.is_dir() or not os.access(parent, os.W_OK):
        raise FileError(target, "cannot be written; choose another place with -o.")


@contextlib.contextmanager
def new_folder(folder: str | os.PathLike[str], marker: str, overwrite: bool) -> Iterator[Path]:
    """A temporary folder that becomes `folder` when the block ends well and is removed when it does not.

    Raises FileError, see `require_free`.
    """
    require_free(Path(folder), marker, overwrite)
    with replacing_folder(folder) as temporary:
        yield temporary
