"""The picture that stands in a page before the viewer runs, and where it cannot."""

from __future__ import annotations

import io
from collections.abc import Sequence
from typing import Any

from ..reflectance import Reflectance
from ..render import render, render_halves
from .page import PICTURE_SIZE
from .payload import View

SAMPLES = 16

LARGEST = 15_000
"""Bytes."""

QUALITIES = (90, 80, 70, 55, 40, 25, 10, 1)
"""The best first; the first that is small enough is taken."""


def picture(shown: Sequence[Reflectance], view: View) -> bytes:
    """WebP of the first material, in its right half the second if there is one."""
    scene: dict[str, Any] = {
        "mesh": view.chosen_mesh,
        "lights": view.chosen_lights or None,
        "env": view.chosen_env,
        "size": PICTURE_SIZE,
        "samples": SAMPLES,
        "shadows": view.shadows,
    }
    image = render_halves(shown[0], shown[1], **scene) if len(shown) > 1 else render(shown[0], **scene)
    developed = image.developed(view.tone, view.exposure)
    data = b""
    for quality in QUALITIES:
        data = _webp(developed, quality)
        if len(data) <= LARGEST:
            break
    return data


def _webp(developed: Any, quality: int) -> bytes:
    from PIL import Image as Pictures

    buffer = io.BytesIO()
    Pictures.fromarray(developed).save(buffer, "WEBP", quality=quality, method=6)
    return buffer.getvalue()
