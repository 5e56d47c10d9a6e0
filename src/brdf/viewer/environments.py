"""Environments as a page takes them: shared-exponent pixels; how they are sampled, the browser works out itself."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..render.environment import Environment, reduced
from .blob import Blob

WIDEST = 256
"""Pixels across, to which larger pictures are averaged down."""


def described(environment: Environment, blob: Blob) -> dict[str, Any]:
    """An environment's part of a page's description.

    `pixels`: a row of four bytes (r, g, b, e) a pixel, top row first; its radiance is (r, g, b) · 2^(e - 136).
    """
    pixels = environment.pixels
    while pixels.shape[1] > WIDEST and pixels.shape[0] % 2 == 0 and pixels.shape[1] % 2 == 0:
        pixels = reduced(pixels, 2)
    height, width = pixels.shape[:2]
    shared = shared_exponent(pixels).reshape(-1, 4)
    return {"name": environment.name, "width": width, "height": height, "pixels": blob.add_numbers(shared, 8)}


def shared_exponent(pixels: NDArray[np.float32]) -> NDArray[np.uint8]:
    """(..., 3) radiance -> (..., 4) bytes: what `brdf.render.radiance_file` reads back. Reference: Ward1991."""
    brightest = pixels.max(-1)
    _, exponent = np.frexp(brightest)
    carry = np.rint(np.ldexp(brightest, 8 - exponent)) > 255
    exponent = np.clip(exponent + carry, -127, 127)
    mantissas = np.rint(np.ldexp(pixels, 8 - exponent[..., None]))
    rgbe = np.concatenate([np.clip(mantissas, 0, 255), exponent[..., None] + 128], -1)
    return np.where(brightest[..., None] > 0, rgbe, 0).astype(np.uint8)
