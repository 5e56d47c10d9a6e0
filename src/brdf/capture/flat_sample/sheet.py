"""All pictures of a sample on one sheet."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...color import luminance, srgb_encode
from .rectify import area_averaged

THUMBNAIL, COLUMNS, LINE = 240, 5, 24
"""Pixels across a picture, pictures in a row, pixels of the line below."""
WHITE_SHARE = 0.995
"""Share of the brightest picture's pixels that is shown without clipping."""


def save_sheet(path: Path, images: NDArray[Any], elevations: NDArray[Any], averages: NDArray[Any]) -> None:
    """Write the pictures (M, H, W, 3), all exposed alike, each with its angle and average, as a PNG."""
    from PIL import Image, ImageDraw, ImageFont

    height, width = images.shape[1:3]
    scale = THUMBNAIL / max(height, width)
    larger = max(1, int(scale))  # small pictures are shown with visible pixels
    shape = (max(1, round(height * min(scale, 1))), max(1, round(width * min(scale, 1))))
    columns = min(COLUMNS, len(images))
    rows = math.ceil(len(images) / columns)
    cell = (larger * shape[0] + LINE, max(larger * shape[1], 150) + 4)
    sheet = Image.new("RGB", (columns * cell[1], rows * cell[0]), (255, 255, 255))
    draw = ImageDraw.Draw(sheet)
    font = ImageFont.load_default(14)
    brightest = max(float(np.quantile(luminance(images[int(np.argmax(averages))]), WHITE_SHARE)), 1e-9)
    for number, image in enumerate(images):
        x, y = number % columns * cell[1], number // columns * cell[0]
        shown = srgb_encode(area_averaged(image, shape) / brightest).repeat(larger, 0).repeat(larger, 1)
        sheet.paste(Image.fromarray((shown * 255 + 0.5).astype(np.uint8)), (x, y))
        draw.text(
            (x + 2, y + cell[0] - LINE + 2), f"{elevations[number]:.1f}°  a = {averages[number]:.4f}", (0, 0, 0), font
        )
    sheet.save(path, "PNG")
