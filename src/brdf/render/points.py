"""Sample points: one scrambled Sobol sequence, dealt out to the pixels along a space-filling curve.

Neighbouring pixels so get neighbouring stretches of one well-spread sequence, and what error remains is spread like
blue noise over the picture [Ahmed2020]; the scrambling is Owen's by hashing [Burley2020]. No state: a point depends on
seed, pixel and index alone.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .compiled import helper, kernel


@helper
def hashed(x: Any) -> Any:
    """A 32-bit integer hash."""
    x = np.uint32(x)
    x = np.uint32((x ^ (x >> np.uint32(16))) * np.uint32(0x7FEB352D))
    x = np.uint32((x ^ (x >> np.uint32(15))) * np.uint32(0x846CA68B))
    return np.uint32(x ^ (x >> np.uint32(16)))


@helper
def _reversed(x: Any) -> Any:
    """The 32 bits in reverse order."""
    x = np.uint32(x)
    x = np.uint32((x >> np.uint32(16)) | (x << np.uint32(16)))
    x = np.uint32(((x & np.uint32(0xFF00FF00)) >> np.uint32(8)) | ((x & np.uint32(0x00FF00FF)) << np.uint32(8)))
    x = np.uint32(((x & np.uint32(0xF0F0F0F0)) >> np.uint32(4)) | ((x & np.uint32(0x0F0F0F0F)) << np.uint32(4)))
    x = np.uint32(((x & np.uint32(0xCCCCCCCC)) >> np.uint32(2)) | ((x & np.uint32(0x33333333)) << np.uint32(2)))
    return np.uint32(((x & np.uint32(0xAAAAAAAA)) >> np.uint32(1)) | ((x & np.uint32(0x55555555)) << np.uint32(1)))


@helper
def _scrambled_reverse(x: Any, seed: Any) -> Any:
    """Owen's nested scrambling of a number whose bits are given in reverse order [Burley2020, section 3.2]."""
    x = np.uint32(x + seed)
    x = np.uint32(x ^ np.uint32(x * np.uint32(0x6C50B47C)))
    x = np.uint32(x ^ np.uint32(x * np.uint32(0xB82F1E52)))
    x = np.uint32(x ^ np.uint32(x * np.uint32(0xC7AFE638)))
    return np.uint32(x ^ np.uint32(x * np.uint32(0x8D22F6E6)))


@helper
def _sobol_second(index: Any) -> Any:
    """The second coordinate of Sobol's sequence, 32 bits."""
    result, column = np.uint32(0), np.uint32(0x80000000)
    index = np.uint32(index)
    while index:
        if index & np.uint32(1):
            result ^= column
        column ^= column >> np.uint32(1)
        index >>= np.uint32(1)
    return result


@helper
def _curve_position(x: Any, y: Any, seed: Any) -> Any:
    """Where pixel (x, y) comes along the curve: its digits in base 4, each level shuffled by a hash of those above."""
    position = np.uint32(0)
    for bit in range(12, -1, -1):
        digit = np.uint32(((x >> bit) & 1) | (((y >> bit) & 1) << 1))
        shuffle = hashed(position ^ np.uint32(seed + 0x9E3779B9 * (bit + 1)))
        position = np.uint32((position << np.uint32(2)) | (digit ^ (shuffle & np.uint32(3))))
    return position


@kernel("void(i8, i8, i4[::1], i4, u4, u4[::1])")
def along_curve(start: int, stop: int, pixels: Any, width: Any, seed: Any, positions: Any) -> None:
    """Where each of the `pixels` (numbers row * width + column) comes along the curve."""
    for n in range(start, stop):
        positions[n] = _curve_position(pixels[n] % width, pixels[n] // width, seed)


@kernel("void(i8, i8, u4[::1], i4[::1], i4, i4, i4, u4, f4[:,::1])")
def fill(
    start: int, stop: int, positions: Any, ranks: Any, rounds: Any, round_number: Any, per_pixel: Any, seed: Any,
    u: Any,
) -> None:  # fmt: skip
    """Points (N, 2) in [0, 1): of the `per_pixel` ones of a pixel, number `ranks[n] * rounds + round_number`."""
    seed_x, seed_y = hashed(seed), hashed(seed + np.uint32(0x68BC21EB))
    for n in range(start, stop):
        at = np.uint32(positions[n] * np.uint32(per_pixel) + np.uint32(ranks[n] * rounds + round_number))
        # The radical inverse of an index is its bits reversed; the scrambling wants them reversed once more.
        first = _reversed(_scrambled_reverse(at, seed_x))
        second = _reversed(_scrambled_reverse(_reversed(_sobol_second(at)), seed_y))
        u[n, 0] = np.float32(first >> np.uint32(8)) * np.float32(2.0**-24)
        u[n, 1] = np.float32(second >> np.uint32(8)) * np.float32(2.0**-24)
