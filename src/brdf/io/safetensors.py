"""The package's own files: safetensors with a JSON header, as `Reflectance.save` writes them."""

from __future__ import annotations

import importlib
import pkgutil
from pathlib import Path

from .. import representations
from ..errors import CorruptFileError
from ..reflectance import Reflectance
from .registry import Format

_LARGEST_HEADER = 100_000_000
"""The bound on the header's length that the safetensors format sets, bytes."""


def recognises(head: bytes, size: int) -> bool:
    """A safetensors file starts with the length of its JSON header (8 bytes, little endian), then the header."""
    return int.from_bytes(head[:8], "little") <= _LARGEST_HEADER and head[8:9] == b"{"


def read(path: Path) -> Reflectance:
    """The reflectance saved in the file. Raises CorruptFileError."""
    try:
        return Reflectance.restore(path)
    except CorruptFileError:
        # a kind is known once its module is imported, which is left until a file asks for it
        for module in pkgutil.walk_packages(representations.__path__, f"{representations.__name__}."):
            importlib.import_module(module.name)
        return Reflectance.restore(path)


def write(reflectance: Reflectance, path: Path) -> None:
    """Save it. Raises FileError."""
    reflectance.save(path)


FORMAT = Format("safetensors", (".safetensors",), "any reflectance of this package, complete", recognises, read, write)
