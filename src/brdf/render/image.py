"""The picture a renderer makes: linear light, with what it shows written beside it."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import __version__
from ..container import replacing
from ..errors import CorruptFileError, SceneError, UnknownFormatError
from .tone import developed

Floats = NDArray[np.float32]


@dataclass(frozen=True)
class Image:
    """Linear Rec. 709 radiance, top row first.

    `pixels` (H, W, 3), multiplied by the coverage; `alpha` (H, W) coverage in [0, 1], or None where all is covered;
    `metadata`: what is shown and how it was made. Raises SceneError for arrays that are no picture.
    """

    pixels: Floats
    alpha: Floats | None = None
    metadata: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        pixels = np.asarray(self.pixels, np.float32)
        if pixels.ndim != 3 or pixels.shape[2] != 3 or not pixels.size:
            raise SceneError(f"an image must have shape (height, width, 3), got {pixels.shape}")
        object.__setattr__(self, "pixels", pixels)
        if self.alpha is not None:
            alpha = np.asarray(self.alpha, np.float32)
            if alpha.shape != pixels.shape[:2]:
                raise SceneError(f"alpha of shape {alpha.shape} does not fit an image of shape {pixels.shape}")
            object.__setattr__(self, "alpha", alpha)

    @property
    def width(self) -> int:
        return int(self.pixels.shape[1])

    @property
    def height(self) -> int:
        return int(self.pixels.shape[0])

    def developed(self, tone: str = "filmic", exposure: float = 0.0) -> NDArray[np.uint8]:
        """8-bit sRGB, (H, W, 3), or (H, W, 4) with alpha (colours then not multiplied by it)."""
        pixels: NDArray[np.floating[Any]] = self.pixels
        if self.alpha is not None:
            pixels = pixels / np.maximum(self.alpha, np.float32(1e-6))[..., None]
        display = developed(pixels, tone, exposure)
        if self.alpha is not None:
            display = np.concatenate([display, np.clip(self.alpha, 0, 1)[..., None]], -1)
        return np.asarray(display * 255 + 0.5, np.uint8)

    def save(self, path: str | os.PathLike[str], tone: str = "filmic", exposure: float = 0.0) -> None:
        """Write a .png (8-bit sRGB after tone curve and exposure in stops) or an .exr (linear, untouched).

        The metadata goes along: text chunks of the PNG, string attributes of the EXR. The file is replaced whole or
        not at all. Raises UnknownFormatError, FileError, UnknownNameError.
        """
        suffix = Path(path).suffix.lower()
        if suffix not in WRITERS:
            raise UnknownFormatError(path, f"pictures are written as {' or '.join(WRITERS)}; choose one of them.")
        WRITERS[suffix](self, path, tone, exposure)

    def _repr_png_(self) -> bytes:
        """What a notebook shows."""
        import io

        buffer = io.BytesIO()
        _pil(self, "filmic", 0.0).save(buffer, "PNG")
        return buffer.getvalue()

    def notes(self) -> dict[str, str]:
        """The metadata with the software's name and version."""
        return {"Software": f"brdf {__version__}"} | {key: value for key, value in self.metadata.items() if value}


def _pil(image: Image, tone: str, exposure: float) -> Any:
    from PIL import Image as Pictures

    return Pictures.fromarray(image.developed(tone, exposure))


def _write_png(image: Image, path: str | os.PathLike[str], tone: str, exposure: float) -> None:
    from PIL.PngImagePlugin import PngInfo

    picture = _pil(image, tone, exposure)
    chunks = PngInfo()
    for key, value in {**image.notes(), "Tone curve": tone, "Exposure": f"{exposure:g} stops"}.items():
        chunks.add_itxt(key, value) if not value.isascii() else chunks.add_text(key, value)
    with replacing(path) as temporary:
        picture.save(temporary, "PNG", pnginfo=chunks)


def _write_exr(image: Image, path: str | os.PathLike[str], tone: str, exposure: float) -> None:
    import OpenEXR

    header: dict[str, Any] = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    header |= {key.lower().replace(" ", "_"): value for key, value in image.notes().items()}
    if image.alpha is None:
        channels = {"RGB": np.ascontiguousarray(image.pixels)}
    else:
        channels = {"RGBA": np.concatenate([image.pixels, image.alpha[..., None]], -1)}
    with replacing(path) as temporary:
        OpenEXR.File(header, channels).write(str(temporary))


WRITERS = {".png": _write_png, ".exr": _write_exr}


def read_exr(path: str | os.PathLike[str]) -> Floats:
    """(H, W, 3) linear RGB of an OpenEXR picture, top row first. Raises CorruptFileError."""
    import OpenEXR

    try:
        channels = OpenEXR.File(os.fspath(path)).channels()
    except Exception as error:  # the library raises several kinds for a broken file
        raise CorruptFileError(path, f"cannot be read as OpenEXR ({str(error).splitlines()[0]}).") from None
    for name in ("RGB", "RGBA"):
        if name in channels:
            return np.asarray(channels[name].pixels[..., :3], np.float32)
    if "Y" in channels:
        return np.repeat(np.asarray(channels["Y"].pixels, np.float32)[..., None], 3, -1)
    raise CorruptFileError(path, f"has no RGB channels, only {', '.join(sorted(channels)) or 'none'}.")
