"""Pictures of figures: radiance as a screen shows it, errors as colours with their scale, and their files."""

from __future__ import annotations

import io
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..color import srgb_encode
from ..container import replacing
from .report import Figure, Panel

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Chart

Floats = NDArray[np.floating[Any]]
Bytes = NDArray[np.uint8]

INK = "#010203"
"""Stands in charts for the colour of the text around them."""

GREY = 128
"""Of the scale below an error picture: legible on a white and on a black page."""


def developed(radiance: Floats, coverage: Floats | None = None) -> Bytes:
    """(H, W, 3) linear radiance, clipped to [0, 1] -> 8-bit sRGB; with `coverage` (H, W) the rest is transparent."""
    return _bytes(srgb_encode(radiance), coverage)


def error_picture(error: Floats, highest: float, coverage: Floats | None = None, unit: str = "sRGB") -> Bytes:
    """(H, W) errors as colours from 0 (black) to `highest` (yellow), with that scale below."""
    from matplotlib import colormaps

    colours = colormaps["inferno"]
    picture = _bytes(colours(np.clip(error / highest, 0, 1))[..., :3], coverage)
    if picture.shape[2] == 3:
        picture = np.concatenate([picture, np.full_like(picture[..., :1], 255)], -1)
    width = picture.shape[1]
    text = _words(width, "0", f"≥ {highest:.2g} {unit}")
    bar = np.full((max(4, width // 40), width, 4), 255, np.uint8)
    bar[..., :3] = np.rint(colours(np.linspace(0, 1, width))[:, :3] * 255)
    gap = np.zeros_like(bar)
    return np.concatenate([picture, gap, bar, text])


def _words(width: int, left: str, right: str) -> Bytes:
    """A transparent strip with words at its ends."""
    import matplotlib
    from PIL import Image, ImageDraw, ImageFont

    letters = Path(matplotlib.get_data_path()) / "fonts" / "ttf" / "DejaVuSans.ttf"
    font = ImageFont.truetype(letters, max(9, width // 18))
    strip = Image.new("L", (width, round(font.size * 1.5)), 0)
    draw = ImageDraw.Draw(strip)
    draw.text((1, strip.height / 2), left, 255, font, anchor="lm")
    draw.text((width - 1, strip.height / 2), right, 255, font, anchor="rm")
    ink = np.asarray(strip)
    return np.stack([np.full_like(ink, GREY)] * 3 + [ink], -1)


def disc(size: int) -> Floats:
    """(size, size) coverage of the disc inscribed in a picture, soft by a pixel at its rim."""
    axis = (2 * np.arange(size) + 1) / size - 1
    radius = np.hypot(*np.meshgrid(axis, axis))
    return np.asarray(np.clip((1 - radius) * size / 2 + 0.5, 0, 1))


def _bytes(display: Floats, coverage: Floats | None) -> Bytes:
    if coverage is not None:
        display = np.concatenate([display, np.clip(coverage, 0, 1)[..., None]], -1)
    return np.asarray(display * 255 + 0.5, np.uint8)


def png(panel: Panel) -> bytes:
    """A panel as a PNG file."""
    from PIL import Image

    buffer = io.BytesIO()
    Image.fromarray(panel.pixels).save(buffer, "PNG", optimize=True)
    return buffer.getvalue()


def svg(chart: Chart) -> str:
    """A chart as an <svg> element without a date, its text as text."""
    import matplotlib

    buffer = io.StringIO()
    with matplotlib.rc_context({"svg.hashsalt": "brdf", "svg.fonttype": "none"}):
        chart.savefig(buffer, format="svg", metadata={"Date": None}, transparent=True)
    drawn = buffer.getvalue()
    return drawn[drawn.index("<svg") :]


def write_figure(figure: Figure, folder: Path) -> None:
    """The files of a figure, see `Figure.files`."""
    if figure.chart is None:
        contents = [
            (file, png(panel))
            for files, (_, panels) in zip(figure.panel_files(), figure.rows, strict=True)
            for file, panel in zip(files, panels, strict=True)
        ]
    else:
        raster = io.BytesIO()
        figure.chart.savefig(raster, format="png", dpi=200, facecolor="white", metadata={"Software": None})
        head = '<?xml version="1.0" encoding="utf-8"?>\n'
        contents = [
            (f"{figure.name}.svg", (head + svg(figure.chart).replace(INK, "#222222")).encode()),
            (f"{figure.name}.png", raster.getvalue()),
        ]
    for name, content in contents:
        with replacing(folder / name) as temporary:
            temporary.write_bytes(content)
