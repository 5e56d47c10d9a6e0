"""Pixels and notes of the pictures that `sphere_images` is made of: OpenEXR (linear) and PNG (8-bit sRGB)."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import inputs
from ..color import srgb_decode, srgb_encode
from ..container import replacing
from ..errors import CorruptFileError
from .native import messages_hidden

LARGEST = 1 << 15
"""Pixels along a side of the largest picture that is read."""

NOTE = "brdf-sphere-images"
"""The PNG text chunk, and the EXR attribute, that says what the pictures of a sheet are."""


def write(path: Path, pixels: NDArray[Any], note: str | None = None) -> None:
    """(H, W, 3) linear pixels as .png or .exr (half precision for float16 pixels), replaced whole or not at all.

    Raises FileError.
    """
    with replacing(path) as temporary:
        _WRITERS[path.suffix.lower()](temporary, pixels, {} if note is None else {NOTE: note})


def read(path: Path) -> tuple[NDArray[np.float32], str | None]:
    """(H, W, 3) linear pixels, and the note. Raises CorruptFileError, OSError."""
    inputs.note(path)
    if path.suffix.lower() not in _READERS:
        raise CorruptFileError(path, f"pictures are {' or '.join(_READERS)}; convert it first.")
    try:
        return _READERS[path.suffix.lower()](path)
    except (CorruptFileError, FileNotFoundError, PermissionError):
        raise
    except Exception as error:  # the libraries raise many kinds for a broken file
        raise CorruptFileError(path, f"is not a whole picture ({_first_line(error)}).") from None


def _write_png(path: Path, pixels: NDArray[Any], notes: Mapping[str, str]) -> None:
    from PIL import Image
    from PIL.PngImagePlugin import PngInfo

    chunks = PngInfo()
    for key, value in notes.items():
        chunks.add_text(key, value)
    coded = np.rint(srgb_encode(np.asarray(pixels, np.float32)) * 255).astype(np.uint8)
    Image.fromarray(coded).save(path, "PNG", pnginfo=chunks)


def _write_exr(path: Path, pixels: NDArray[Any], notes: Mapping[str, str]) -> None:
    import OpenEXR

    header: dict[str, Any] = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    OpenEXR.File(header | dict(notes), {"RGB": np.ascontiguousarray(pixels)}).write(str(path))


def _read_png(path: Path) -> tuple[NDArray[np.float32], str | None]:
    from PIL import Image

    with Image.open(path, formats=["PNG"]) as picture:
        _check_size(path, picture.width, picture.height)
        picture.load()
        if picture.mode not in ("RGB", "RGBA", "L", "P"):
            raise CorruptFileError(path, f"holds {picture.mode} pixels; pictures are 8-bit sRGB PNG or linear EXR.")
        coded = np.asarray(picture.convert("RGB"))
        return np.asarray(srgb_decode(np.arange(256) / 255), np.float32)[coded], picture.info.get(NOTE)


def _read_exr(path: Path) -> tuple[NDArray[np.float32], str | None]:
    import OpenEXR

    with messages_hidden(), OpenEXR.File(os.fspath(path), header_only=True) as file:
        header = file.header()
        note = header.get(NOTE)
        low, high = header["dataWindow"]
        _check_size(path, *(int(b) - int(a) + 1 for a, b in zip(low, high, strict=True)))
    with messages_hidden(), OpenEXR.File(os.fspath(path)) as file:
        channels = file.channels()
        name = next((name for name in ("RGB", "RGBA") if name in channels), None)
        if name is None:
            raise CorruptFileError(path, f"has no RGB channels, only {', '.join(sorted(channels)) or 'none'}.")
        return np.array(channels[name].pixels[..., :3], np.float32), note


def _check_size(path: Path, width: int, height: int) -> None:
    if not (0 < width <= LARGEST and 0 < height <= LARGEST):
        raise CorruptFileError(path, f"claims {width} x {height} pixels; at most {LARGEST} a side are read.")


def _first_line(error: Exception) -> str:
    return (str(error).splitlines() or [type(error).__name__])[0]


_WRITERS = {".png": _write_png, ".exr": _write_exr}
_READERS = {".png": _read_png, ".exr": _read_exr}
