"""MERL's `.binary` files [Matusik2003]: isotropic BRDF tables over half and difference angles.

Layout: three int32 (little endian) 90, 90, 180, then the red, green and blue plane, float64 each. The index
within a plane is phi_d + 180 (theta_d + 90 theta_h); theta_h is binned over its square root. Stored values
times the factors (1, 1.15, 1.66) / 1500 are the BRDF in 1/sr; negative values mark invalid bins.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..container import replacing
from ..errors import CorruptFileError, ReflectanceError
from ..reflectance import Reflectance
from ..representations.tables.merl import BINS, MISSING, from_merl, to_merl
from .registry import Format

FACTORS = np.array([1.0, 1.15, 1.66]) / 1500.0
"""Stored value to BRDF [1/sr] for red, green, blue."""

_HEADER = np.dtype("<i4")
_VALUE = np.dtype("<f8")
_HEADER_BYTES = 3 * _HEADER.itemsize
_PLANE_BYTES = math.prod(BINS) * _VALUE.itemsize


def recognises(head: bytes, size: int) -> bool:
    """MERL files have no signature beside their dimensions."""
    return len(head) >= _HEADER_BYTES and _dimensions(head) == BINS


def _dimensions(head: bytes) -> tuple[int, ...]:
    return tuple(np.frombuffer(head[:_HEADER_BYTES], _HEADER).tolist())


def read(path: Path) -> Reflectance:
    """The file as a `Table`. Raises CorruptFileError."""
    try:
        return from_merl(read_values(path), path.stem, f"MERL file {path.name}")
    except ReflectanceError as error:
        raise CorruptFileError(path, f"{error}; fetch it again.") from None


def read_values(path: Path) -> NDArray[np.float32]:
    """The BRDF per bin [1/sr], float32 (90, 90, 180, 3); negative where invalid.

    The planes pass one by one, so that no more than one is in memory beside the result. Raises
    CorruptFileError for other dimensions, a wrong size, NaN and infinity.
    """
    with path.open("rb") as file:
        size = file.seek(0, 2)
        file.seek(0)
        head = file.read(_HEADER_BYTES)
        if len(head) < _HEADER_BYTES:
            raise CorruptFileError(path, f"has {size} bytes, too few for a MERL header ({_HEADER_BYTES}).")
        if (dimensions := _dimensions(head)) != BINS:
            given, known = (" x ".join(map(str, d)) for d in (dimensions, BINS))
            raise CorruptFileError(path, f"its MERL header says {given} bins; only {known} is read.")
        expected = _HEADER_BYTES + 3 * _PLANE_BYTES
        if size != expected:
            fault = "it is truncated" if size < expected else "something is appended"
            raise CorruptFileError(path, f"expected {expected} bytes, found {size}: {fault}; fetch it again.")
        values = np.empty((*BINS, 3), np.float32)
        plane = np.empty(BINS, _VALUE)
        for channel, factor in enumerate(FACTORS):
            file.readinto(plane.data)
            plane *= factor
            with np.errstate(over="ignore"):
                values[..., channel] = plane
            if not np.isfinite(values[..., channel]).all():
                colour = ("red", "green", "blue")[channel]
                raise CorruptFileError(path, f"its {colour} plane holds NaN or infinity; fetch it again.")
    return values


def write(reflectance: Reflectance, path: Path) -> None:
    """The reflectance at MERL's bins; bins below the horizon are marked invalid. Raises FileError."""
    write_values(to_merl(reflectance), path)


def write_values(values: NDArray[np.floating[Any]], path: Path) -> None:
    """(90, 90, 180, 3) values [1/sr], negative where invalid, as a MERL file. Raises FileError."""
    with replacing(path) as temporary, temporary.open("wb") as file:
        file.write(np.array(BINS, _HEADER).tobytes())
        for channel, factor in enumerate(FACTORS):
            plane = values[..., channel].astype(_VALUE)
            file.write(np.where(plane < 0, MISSING, plane / factor).tobytes())


FORMAT = Format(
    "MERL",
    (".binary",),
    "isotropic measured table, 90 x 90 x 180 bins of half and difference angles, RGB",
    recognises,
    read,
    write,
    has_signature=False,
)
