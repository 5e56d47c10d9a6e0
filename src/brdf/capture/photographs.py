"""Photographs as arrays: reading them, their camera's response, the dark frame, the files of a folder."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .. import inputs
from ..color import srgb_decode
from ..errors import BrdfError, CorruptFileError, FileError, ParameterError, UnknownFormatError
from ..io.native import messages_hidden
from . import png

Array = NDArray[np.floating[Any]]

EXTENSIONS = (".png", ".tga", ".tif", ".tiff", ".jpg", ".jpeg", ".exr", ".bmp", ".ppm")
"""Of what counts as a photograph in a folder."""

CLIPPED = 0.9999
"""Share of the largest value that a file's numbers can take from which on a pixel counts as saturated."""


class Photograph(NamedTuple):
    """One picture as its file holds it."""

    pixels: NDArray[np.float32]
    """(H, W, 3), top row first, in units of `largest`: 0 to 1 for integers, as they are for floats"""
    largest: float
    """largest number its file can hold (255, 65535), infinity for floats"""

    @property
    def deep(self) -> bool:
        """Whether it has more than 8 bits."""
        return self.largest > 255

    def saturated(self) -> NDArray[np.bool_]:
        """(H, W): whether any channel is at its end."""
        if not np.isfinite(self.largest):
            return np.zeros(self.pixels.shape[:2], np.bool_)
        return np.asarray((self.pixels >= CLIPPED).any(-1))


def read_photograph(path: str | os.PathLike[str]) -> Photograph:
    """A photograph: PNG and TIFF of 8 or 16 bits, TGA, JPEG, BMP, PPM, or EXR. Gray becomes RGB, alpha is dropped.

    Raises FileError, CorruptFileError, UnknownFormatError.
    """
    path = Path(path)
    inputs.note(path)
    if not path.is_file():
        raise FileError(path, "no such file; check the path.")
    if path.stat().st_size == 0:
        raise CorruptFileError(path, "is empty (0 bytes); copy it again or leave it out.")
    reader = _reader(path)
    try:
        pixels = np.asarray(reader(path))
    except BrdfError:
        raise
    except Exception as error:  # the libraries raise several kinds for a broken file
        text = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise CorruptFileError(path, f"cannot be read as a picture ({text}); copy it again or leave it out.") from None
    return _uniform(path, pixels)


def _reader(path: Path) -> Callable[[Path], Any]:
    extension = path.suffix.lower()
    if extension not in EXTENSIONS:
        raise UnknownFormatError(path, f"is no picture by its extension; read: {' '.join(EXTENSIONS)}.")
    if extension == ".exr":
        return _read_exr
    if extension in (".tif", ".tiff"):
        return _read_tiff
    return png.read_deep if png.is_deep(path) else _read_shallow


def _read_shallow(path: Path) -> Any:
    from PIL import Image

    with Image.open(path) as picture:
        if picture.mode not in ("L", "RGB", "I;16", "I;16B"):
            return np.asarray(picture.convert("RGB"))
        return np.asarray(picture)


def _read_tiff(path: Path) -> Any:
    import tifffile

    with tifffile.TiffFile(path) as file:
        page = file.pages.first
        # ImageJ and cameras store planes one after the other, or samples side by side
        pixels = page.asarray()
        return np.moveaxis(pixels, 0, -1) if pixels.ndim == 3 and page.planarconfig == 2 else pixels


def _read_exr(path: Path) -> Any:
    import OpenEXR

    with messages_hidden():
        channels = OpenEXR.File(os.fspath(path)).channels()
    for name in ("RGB", "RGBA", "Y"):
        if name in channels:
            return np.asarray(channels[name].pixels, np.float32)
    raise CorruptFileError(path, f"has no RGB channels, only {', '.join(sorted(channels)) or 'none'}.")


def _uniform(path: Path, pixels: NDArray[Any]) -> Photograph:
    """As (H, W, 3) in units of the largest number."""
    if pixels.ndim == 2:
        pixels = pixels[..., None]
    if pixels.ndim != 3 or not pixels.size or pixels.shape[2] not in (1, 2, 3, 4):
        raise CorruptFileError(path, f"is no picture of gray or RGB, its numbers have shape {pixels.shape}.")
    colours = pixels[..., :1] if pixels.shape[2] < 3 else pixels[..., :3]
    if pixels.dtype.kind == "f":
        largest, scaled = float("inf"), colours.astype(np.float32)
        if not np.isfinite(scaled).all():
            raise CorruptFileError(path, "holds NaN or infinity; leave it out.")
    elif pixels.dtype in (np.uint8, np.uint16):
        largest = float(np.iinfo(pixels.dtype).max)
        scaled = (colours / largest).astype(np.float32)
    else:
        raise CorruptFileError(path, f"holds numbers of type {pixels.dtype}; save it with 8 or 16 bits a channel.")
    return Photograph(np.repeat(scaled, 3, -1) if scaled.shape[2] == 1 else scaled, largest)


# ---- response ------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Response:
    """How a camera turned light into numbers: "linear", "srgb", or a gamma (number = light^(1 / gamma))."""

    name: str
    gamma: float = 1.0

    def linear(self, pixels: Array) -> Array:
        """Numbers (any shape, 1 is the largest) as light."""
        if self.name == "srgb":
            return srgb_decode(pixels)
        return pixels if self.gamma == 1 else np.maximum(pixels, 0) ** np.float32(self.gamma)


def response_of(given: str | float | None, deep: bool) -> Response:
    """The response of that name or gamma; None: linear for more than 8 bits, sRGB for 8. Raises ParameterError."""
    if given is None:
        given = "linear" if deep else "srgb"
    if given in ("linear", "srgb"):
        return Response(str(given))
    try:
        gamma = float(given)
    except ValueError:
        gamma = 0.0
    if not 0.1 <= gamma <= 10:
        raise ParameterError(f"response must be linear, srgb, or a gamma between 0.1 and 10 as 2.2; got {given!r}")
    return Response(f"gamma {gamma:g}", gamma)


# ---- folders -------------------------------------------------------------------------------------------------------


def natural(name: str) -> list[tuple[int, int | str]]:
    """A sort key that puts 2 before 10."""
    return [(0, int(part)) if part.isdecimal() else (1, part.lower()) for part in re.split(r"(\d+)", name) if part]


def pictures_in(folder: Path, without: Iterable[Path] = ()) -> tuple[list[Path], list[Path]]:
    """The photographs of a folder, and its pictures named `*mask*`.

    The photographs come in the order of `filenames.txt` where there is one, else sorted with numbers by their value.
    Those in `without` and those named `*dark*` are left out. Raises FileError.
    """
    if not folder.is_dir():
        raise FileError(folder, "no such folder; give the folder of the photographs.")
    skipped = {path.resolve() for path in without}
    found = [path for path in folder.iterdir() if path.suffix.lower() in EXTENSIONS and path.resolve() not in skipped]
    found.sort(key=lambda path: (natural(path.stem), path.suffix))
    masks = [path for path in found if "mask" in path.stem.lower()]
    photographs = [path for path in found if path not in masks and "dark" not in path.stem.lower()]
    names = folder / "filenames.txt"
    if names.is_file():
        listed = names.read_text("utf-8", errors="replace").split("\n")
        photographs = [folder / line.strip() for line in listed if line.strip()]
        for path in photographs:
            if path.parent != folder or not path.is_file():
                raise FileError(names, f"names {path.name}, which is not in the folder; correct the list or remove it.")
    return photographs, masks
