"""RGL's `.bsdf` tensor files: measurements on adaptive grids [Dupuy2018].

A tensor file is the signature "tensor_file\\0", two version bytes (1, 0), the number of fields (uint32), and
for each field the length of its name (uint16), the name, the number of axes (uint16), the type (uint8), the
offset of its data in the file (uint64) and its length along each axis (uint64); everything little endian.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..container import replacing
from ..errors import CorruptFileError
from ..reflectance import Reflectance
from ..representations.adaptive import Adaptive
from ..representations.baking.adaptive_grid import bake_adaptive
from .registry import Format

SIGNATURE = b"tensor_file\0"
_TYPES = ("u1", "i1", "<u2", "<i2", "<u4", "<i4", "<u8", "<i8", "<f2", "<f4", "<f8")
"""NumPy's name of each type; their codes in the file start at 1."""
_MOST_FIELDS = 64
_MOST_AXES = 8
_ALIGNMENT = 8
"""Where the data of a field that we write may start, bytes."""


def recognises(head: bytes, size: int) -> bool:
    """By the signature."""
    return head.startswith(SIGNATURE)


def read(path: Path) -> Reflectance:
    """The file as an `Adaptive`. Raises CorruptFileError."""
    tensors = read_tensors(path)
    described = tensors.pop("description", np.zeros(0, np.uint8)).tobytes()
    description = described.decode("utf-8", "replace").strip("\0 \n")
    try:
        made = Adaptive(tensors, description)
    except ValueError as error:
        raise CorruptFileError(path, f"is not a whole RGL measurement: {error}.") from None
    return made.named(path.stem, f"RGL file {path.name}")


class _Cursor:
    """Reads numbers from the table of contents; running off the end of the file is a CorruptFileError."""

    def __init__(self, path: Path) -> None:
        self.path, self.file = path, path.open("rb")
        self.size = path.stat().st_size

    def take(self, count: int) -> bytes:
        data = self.file.read(count)
        if len(data) < count:
            raise CorruptFileError(self.path, f"its table of contents ends at byte {self.size}; fetch it again.")
        return data

    def numbers(self, layout: str) -> tuple[int, ...]:
        return struct.unpack("<" + layout, self.take(struct.calcsize("<" + layout)))


def read_tensors(path: Path) -> dict[str, NDArray[Any]]:
    """Every field of a tensor file by name. Sizes are checked against the file before memory is taken.

    Raises CorruptFileError.
    """
    cursor = _Cursor(path)
    with cursor.file:
        if cursor.take(len(SIGNATURE)) != SIGNATURE or cursor.numbers("BB") != (1, 0):
            raise CorruptFileError(path, "is not a tensor file of version 1.0.")
        (count,) = cursor.numbers("I")
        if count > _MOST_FIELDS:
            raise CorruptFileError(path, f"claims {count} fields; at most {_MOST_FIELDS} are read.")
        contents = dict(_entry(cursor) for _ in range(count))
        end_of_contents = cursor.file.tell()
        tensors = {}
        for name, (dtype, offset, shape) in contents.items():
            nbytes = math.prod(shape) * dtype.itemsize
            if offset < end_of_contents or offset + nbytes > cursor.size or max(shape, default=0) > cursor.size:
                place = f"bytes {offset} to {offset + nbytes} of a file of {cursor.size}"
                raise CorruptFileError(path, f"field {name!r} claims {place}; fetch it again.")
            cursor.file.seek(offset)
            tensors[name] = np.frombuffer(cursor.take(nbytes), dtype).reshape(shape)
    return tensors


def _entry(cursor: _Cursor) -> tuple[str, tuple[np.dtype[Any], int, tuple[int, ...]]]:
    """Name, type, offset and shape of the next field."""
    (length,) = cursor.numbers("H")
    name = cursor.take(length).decode("utf-8", "replace")
    axes, code, offset = cursor.numbers("HBQ")
    if not 1 <= code <= len(_TYPES):
        raise CorruptFileError(cursor.path, f"field {name!r} is of the unknown type {code}.")
    if axes > _MOST_AXES:
        raise CorruptFileError(cursor.path, f"field {name!r} claims {axes} axes; at most {_MOST_AXES} are read.")
    return name, (np.dtype(_TYPES[code - 1]), offset, cursor.numbers(f"{axes}Q"))


def write(reflectance: Reflectance, path: Path) -> None:
    """An `Adaptive` as it is, any other reflectance resampled to adaptive grids (`bake_adaptive`).

    Raises ReflectanceError for what transmits or mirrors, FileError.
    """
    measured = reflectance if isinstance(reflectance, Adaptive) else bake_adaptive(reflectance)
    description = np.frombuffer(measured.description.encode(), np.uint8)
    write_tensors({"description": description, **measured.tensors}, path)


def write_tensors(tensors: Mapping[str, NDArray[Any]], path: Path) -> None:
    """Arrays by name as a tensor file. Raises FileError."""
    arrays = {name: np.ascontiguousarray(array) for name, array in tensors.items()}
    entries = [(name.encode(), array) for name, array in arrays.items()]
    offset = len(SIGNATURE) + 6 + sum(13 + len(name) + 8 * array.ndim for name, array in entries)
    contents, padding = [SIGNATURE, struct.pack("<BBI", 1, 0, len(entries))], []
    for name, array in entries:
        gap = -offset % _ALIGNMENT
        padding.append(gap)
        offset += gap
        code = _TYPES.index(array.dtype.newbyteorder("<").str.lstrip("|")) + 1
        contents.append(struct.pack("<H", len(name)) + name)
        contents.append(struct.pack(f"<HBQ{array.ndim}Q", array.ndim, code, offset, *array.shape))
        offset += array.nbytes
    with replacing(path) as temporary, temporary.open("wb") as file:
        file.writelines(contents)
        for gap, (_, array) in zip(padding, entries, strict=True):
            file.write(bytes(gap))
            file.write(array.astype(array.dtype.newbyteorder("<"), copy=False).tobytes())


FORMAT = Format(
    "RGL",
    (".bsdf",),
    "goniometer measurement on an adaptive grid, isotropic or anisotropic, RGB or spectral",
    recognises,
    read,
    write,
)
