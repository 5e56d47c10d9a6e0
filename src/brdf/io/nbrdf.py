"""Weights of neural BRDFs [Sztrajman2021]: NumPy archives of many materials, or the arrays of one.

An archive `.npz` holds fc1, b1, fc2, b2, fc3, b3, by themselves or under the name of each material
(`gold-paint/fc1`). The published single arrays are `NAME_fc1.npy` and five more beside it; any one of them stands for
all. Nothing is unpickled: the header of an array is checked against the only shapes there can be before its data is
read.
"""

from __future__ import annotations

import ast
import functools
import io
import re
import struct
import zipfile
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import CorruptFileError
from ..reflectance import Reflectance
from ..representations.neural import SHAPES, NeuralBRDF
from .registry import Format

_SIGNATURE = b"\x93NUMPY"
_LARGEST = 8192
"""Bytes of one array: 441 numbers of 8 bytes and a header."""
_MOST_ARRAYS = 6 * 10_000
_SINGLE = re.compile(r"(.+)_(fc[123]|b[123])")
_HEADER = re.compile(
    r"\{\s*'descr':\s*'([<>=|]?[a-z]\d{1,2})',\s*'fortran_order':\s*(True|False),"
    r"\s*'shape':\s*(\([\d, ]{0,40}\)),?\s*\}"
)


def recognises(head: bytes, size: int) -> bool:
    """A NumPy array, or an archive whose first member is one of these arrays."""
    if head.startswith(_SIGNATURE):
        return True
    name_length = int.from_bytes(head[26:28], "little")
    name = head[30 : 30 + name_length].decode("utf-8", "replace")
    return head.startswith(b"PK\x03\x04") and re.fullmatch(r"(.*/)?(fc[123]|b[123])\.npy", name) is not None


def members(path: Path) -> dict[str, Callable[[], Reflectance]]:
    """How each material of the file is made, by name. Raises CorruptFileError."""
    with path.open("rb") as file:
        is_array = file.read(len(_SIGNATURE)) == _SIGNATURE
    if is_array:
        match = _SINGLE.fullmatch(path.stem)
        if match is None:
            raise CorruptFileError(path, "is a NumPy array, but not called NAME_fc1.npy, as weights are.")
        return {match[1]: functools.partial(_from_arrays, path, match[1])}
    try:
        with zipfile.ZipFile(path) as archive:
            names = archive.namelist()
    except (zipfile.BadZipFile, NotImplementedError, ValueError, EOFError, struct.error) as error:
        raise CorruptFileError(path, f"is not a whole archive ({error}); fetch it again.") from None
    if len(names) > _MOST_ARRAYS:
        raise CorruptFileError(path, f"holds {len(names)} arrays; at most {_MOST_ARRAYS} are read.")
    prefixes = [name.removesuffix("fc1.npy") for name in names if re.fullmatch(r"(.*/)?fc1\.npy", name)]
    if not prefixes:
        raise CorruptFileError(path, "holds no weights called fc1.")
    return {p.rstrip("/") or path.stem: functools.partial(_from_archive, path, p) for p in prefixes}


def beside(path: Path) -> list[Path]:
    """The other arrays of the material that one is called after."""
    match = _SINGLE.fullmatch(path.stem)
    places = [path.with_name(f"{match[1]}_{name}.npy") for name in SHAPES] if match else []
    return [place for place in places if place != path and place.is_file()]


def _from_archive(path: Path, prefix: str) -> Reflectance:
    arrays = {}
    try:
        with zipfile.ZipFile(path) as archive:
            for name in SHAPES:
                entry = archive.getinfo(f"{prefix}{name}.npy")
                if entry.file_size > _LARGEST:
                    raise CorruptFileError(path, f"{entry.filename} claims {entry.file_size} bytes; fetch it again.")
                with archive.open(entry) as file:
                    arrays[name] = _array(path, entry.filename, file.read(_LARGEST))
    except KeyError:
        raise CorruptFileError(path, f"{prefix}{name} is missing.") from None
    except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, RuntimeError, ValueError, OSError) as error:
        raise CorruptFileError(path, f"cannot be unpacked ({error}); fetch it again.") from None
    return _made(path, prefix.rstrip("/") or path.stem, arrays)


def _from_arrays(path: Path, stem: str) -> Reflectance:
    arrays = {}
    for name in SHAPES:
        place = path.with_name(f"{stem}_{name}.npy")
        if not place.is_file():
            raise CorruptFileError(path, f"is one of six arrays, of which {place.name} is missing beside it.")
        with place.open("rb") as file:
            arrays[name] = _array(place, name, file.read(_LARGEST))
    return _made(path, stem, arrays)


def _made(path: Path, name: str, arrays: dict[str, NDArray[Any]]) -> Reflectance:
    try:
        return NeuralBRDF(arrays).named(name, f"neural BRDF of {path.name}")
    except ValueError as error:
        raise CorruptFileError(path, f"{name}: {error}.") from None


def _array(path: Path, name: str, data: bytes) -> NDArray[Any]:
    """The array in the bytes of an `.npy` file. Raises CorruptFileError."""
    file = io.BytesIO(data)
    if file.read(6) != _SIGNATURE or file.read(2) not in (b"\1\0", b"\2\0", b"\3\0"):
        raise CorruptFileError(path, f"{name} is no NumPy array.")
    width = 2 if data[6] == 1 else 4
    length = int.from_bytes(file.read(width), "little")
    match = _HEADER.fullmatch(file.read(length).decode("latin-1").strip())
    if match is None:
        raise CorruptFileError(path, f"{name} has a header that is not one of plain numbers.")
    wanted = SHAPES.get(name.rpartition("/")[2].removesuffix(".npy"), ())
    try:
        shape, dtype = ast.literal_eval(match[3]), np.dtype(match[1])
    except (ValueError, TypeError, SyntaxError) as error:
        raise CorruptFileError(path, f"{name} has a broken header ({error}).") from None
    body = data[8 + width + length :]
    if shape != wanted or dtype.kind != "f" or len(body) != dtype.itemsize * int(np.prod(wanted)):
        raise CorruptFileError(path, f"{name} must be {wanted} numbers, got {shape} of {match[1]}.")
    flat = np.frombuffer(body, dtype).astype(np.float64)
    return flat.reshape(wanted[::-1]).T if match[2] == "True" else flat.reshape(wanted)


FORMAT = Format(
    "NBRDF weights",
    (".npz", ".npy"),
    "neural BRDFs, 675 weights a material; take one with PATH@NAME",
    recognises,
    members=members,
    beside=beside,
)
