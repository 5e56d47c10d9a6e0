"""Words on a picture: a strip below it, and labels on its halves."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..color import LUMINANCE
from .image import Image

PAPER, INK = 0.012, 0.75
"""Radiance of the strip and of the letters on it."""
BRIGHT = 0.17
"""Luminance from which on letters stand out more in the strip's colour than in their own."""


def captioned(image: Image, caption: str, labels: tuple[str, str] | None = None) -> Image:
    """`image` with a strip below it that says `caption` (one or more lines), and `labels` at its halves' feet.

    Lines that are too long are broken between words. The result is linear light and is saved like any picture.
    """
    size = max(9, round(image.height / 32))
    font = _font(size)
    lines = [part for line in caption.split("\n") for part in _broken(line, font, image.width * 0.96)]
    step = round(font.size * 1.45)
    strip = np.full((step * len(lines) + round(font.size * 0.9), image.width), PAPER, np.float32)
    for number, line in enumerate(lines):
        middle = round(font.size * 0.45) + step * number + step / 2
        _write(strip, line, font, (image.width / 2, middle), "mm")
    pixels, alpha = image.pixels.copy(), image.alpha
    if labels is not None:
        font = _fitting(labels, size, image.width * 0.45)
        for label, across, anchor in ((labels[0], 0.02, "ls"), (labels[1], 0.98, "rs")):
            ink = _letters(pixels.shape[:2], label, font, (image.width * across, image.height * 0.97), anchor)
            around = float((pixels @ LUMINANCE * ink).sum() / max(ink.sum(), 1e-6))
            pixels += ink[..., None] * ((INK if around < BRIGHT else PAPER) - pixels)
            alpha = None if alpha is None else alpha + ink * (1 - alpha)
    below = np.repeat(strip[..., None], 3, -1)
    alpha = None if alpha is None else np.concatenate([alpha, np.ones_like(strip)])
    return replace(
        image,
        pixels=np.concatenate([pixels, below]),
        alpha=alpha,
        metadata={**image.metadata, "Description": caption},
    )


def _broken(line: str, font: Any, width: float) -> list[str]:
    """The words of `line` in lines at most `width` pixels long (a longer word stands alone)."""
    lines: list[str] = [""]
    for word in line.split(" "):
        longer = f"{lines[-1]} {word}" if lines[-1] else word
        if lines[-1] and font.getlength(longer) > width:
            lines.append(word)
        else:
            lines[-1] = longer
    return lines


def _fitting(labels: tuple[str, str], size: int, width: float) -> Any:
    """The largest font up to `size` in which both labels are at most `width` pixels long."""
    widest = max(_font(size).getlength(label) for label in labels)
    return _font(size if widest <= width else max(6, int(size * width / widest)))


@cache
def _font(size: int) -> Any:
    from PIL import ImageFont

    matplotlib = find_spec("matplotlib")  # the font lies in its data; importing it would take half a second
    folder = Path(str(matplotlib.origin)).parent if matplotlib else Path()
    return ImageFont.truetype(folder / "mpl-data" / "fonts" / "ttf" / "DejaVuSans.ttf", size)


def _letters(shape: tuple[int, ...], text: str, font: Any, at: tuple[float, float], anchor: str) -> NDArray[np.float32]:
    """How much of each pixel the letters cover, (H, W)."""
    from PIL import Image as Pictures
    from PIL import ImageDraw

    mask = Pictures.new("L", (shape[1], shape[0]))
    ImageDraw.Draw(mask).text(at, text, fill=255, font=font, anchor=anchor)
    return np.asarray(mask, np.float32) / np.float32(255)


def _write(strip: NDArray[np.float32], text: str, font: Any, at: tuple[float, float], anchor: str) -> None:
    strip += _letters(strip.shape, text, font, at, anchor) * (INK - strip)
