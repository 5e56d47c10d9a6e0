"""The row filters of PNG, undone. Compiled: a byte depends on the one before it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numba

from ..formula.machine_code import kept_on_disk

_njit: Callable[..., Callable[[Callable[..., None]], Callable[..., None]]] = numba.njit


@_njit("void(u1[::1], u1[:,::1], i8)", cache=kept_on_disk(), nogil=True)
def unfilter(filters: Any, pixels: Any, step: int) -> None:
    """Undo the row filters in place: a byte is stored as its difference from its left, upper, or mixed neighbours."""
    height, width = pixels.shape
    for i in range(height):
        kind = filters[i]
        for j in range(width):
            left = int(pixels[i, j - step]) if j >= step else 0
            up = int(pixels[i - 1, j]) if i > 0 else 0
            corner = int(pixels[i - 1, j - step]) if i > 0 and j >= step else 0
            guess = 0
            if kind == 1:
                guess = left
            elif kind == 2:
                guess = up
            elif kind == 3:
                guess = (left + up) // 2
            elif kind == 4:
                whole = left + up - corner
                a, b, c = abs(whole - left), abs(whole - up), abs(whole - corner)
                guess = left if a <= b and a <= c else up if b <= c else corner
            pixels[i, j] = (int(pixels[i, j]) + guess) & 255
