"""CIELAB under D65, and CIEDE2000: how far apart two colours look."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .rgb import RGB_TO_XYZ, Floats, floats, rgb_to_xyz

WHITE = RGB_TO_XYZ.sum(1)
"""XYZ of RGB (1, 1, 1): D65."""

_KNEE = 6 / 29
"""Where the cube root of CIELAB goes over into a straight line [CIE15]."""


def xyz_to_lab(xyz: ArrayLike) -> Floats:
    """(..., 3) XYZ, white at Y = 1 -> (..., 3) CIELAB under D65: L in [0, 100], a, b. Reference: CIE15."""
    ratio = floats(xyz)
    ratio = ratio / WHITE.astype(ratio.dtype)
    root = np.where(ratio > _KNEE**3, np.cbrt(ratio), ratio / (3 * _KNEE**2) + 4 / 29)
    x, y, z = np.moveaxis(root, -1, 0)
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], -1).astype(ratio.dtype, copy=False)


def rgb_to_lab(rgb: ArrayLike) -> Floats:
    """(..., 3) linear RGB -> (..., 3) CIELAB under D65; white (1, 1, 1) is (100, 0, 0)."""
    return xyz_to_lab(rgb_to_xyz(rgb))


def ciede2000(first: ArrayLike, second: ArrayLike) -> Floats:
    """The difference (...) of two colours (..., 3) in CIELAB, which broadcast; about 1 is just noticeable.

    Weights kL = kC = kH = 1. The formula jumps where the hues are opposite; opposite but for rounding counts as
    opposite. Reference: Sharma2005, equations 2 to 22.
    """
    lightness_1, a_1, b_1 = np.moveaxis(floats(first), -1, 0)
    lightness_2, a_2, b_2 = np.moveaxis(floats(second), -1, 0)
    stretch = 1.5 - 0.5 * _share_of_25((np.hypot(a_1, b_1) + np.hypot(a_2, b_2)) / 2)
    chroma_1, hue_1 = _polar(stretch * a_1, b_1)
    chroma_2, hue_2 = _polar(stretch * a_2, b_2)

    lightness, chroma = (lightness_1 + lightness_2) / 2, (chroma_1 + chroma_2) / 2
    turn, hue = _turn_and_mean(hue_1, hue_2, (chroma_1 == 0) | (chroma_2 == 0))
    distance = (lightness - 50) ** 2
    t = (
        1
        - 0.17 * np.cos(hue - math.radians(30))
        + 0.24 * np.cos(2 * hue)
        + 0.32 * np.cos(3 * hue + math.radians(6))
        - 0.20 * np.cos(4 * hue - math.radians(63))
    )
    by_lightness = (lightness_2 - lightness_1) / (1 + 0.015 * distance / np.sqrt(20 + distance))
    by_chroma = (chroma_2 - chroma_1) / (1 + 0.045 * chroma)
    by_hue = 2 * np.sqrt(chroma_1 * chroma_2) * np.sin(turn / 2) / (1 + 0.015 * chroma * t)
    # blue hues, around 275 degrees, have ellipses that point off the grey axis
    bend = math.radians(60) * np.exp(-(((np.degrees(hue) - 275) / 25) ** 2))
    rotation = -2 * _share_of_25(chroma) * np.sin(bend)
    squared = by_lightness**2 + by_chroma**2 + by_hue**2 + rotation * by_chroma * by_hue
    return np.asarray(np.sqrt(np.maximum(squared, 0)))


def _share_of_25(chroma: Floats) -> Floats:
    """sqrt(C^7 / (C^7 + 25^7)): from 0 for greys to 1 for vivid colours."""
    power = (chroma / 25) ** 7
    return np.asarray(np.sqrt(power / (power + 1)))


def _polar(a: Floats, b: Floats) -> tuple[Floats, Floats]:
    """Chroma, and hue in [0, 2 pi); the hue of grey is 0."""
    hue = np.arctan2(b, a)
    return np.hypot(a, b), np.where(hue < 0, hue + 2 * np.pi, hue)


def _turn_and_mean(hue_1: Floats, hue_2: Floats, is_grey: NDArray[np.bool_]) -> tuple[Floats, Floats]:
    """The turn from one hue to the other the short way round, and the hue halfway; of a grey the other's hue."""
    turn, total = hue_2 - hue_1, hue_1 + hue_2
    opposite = np.pi * (1 + 16 * np.finfo(turn.dtype).eps)
    wraps = np.abs(turn) > opposite
    turn = np.where(wraps, turn - np.copysign(2 * np.pi, turn), turn)
    halfway = np.where(wraps, total / 2 - np.copysign(np.pi, total - 2 * np.pi), total / 2)
    return np.where(is_grey, 0, turn), np.where(is_grey, total, halfway)
