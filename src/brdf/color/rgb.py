"""Linear RGB, CIE XYZ, and the sRGB transfer curve."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.floating[Any]]

LUMINANCE = np.array([0.2126390058715103, 0.7151686787677560, 0.0721923153607337])
"""Relative luminance of the Rec. 709 primaries: the second row of `RGB_TO_XYZ`."""

_PRIMARIES = np.array([[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]])
"""Chromaticities (x, y) of red, green, blue [ITU709]."""
D65 = np.array([0.3127, 0.3290])
"""Chromaticity of the white point [ITU709]."""


def xyz_of_chromaticity(xy: NDArray[np.float64]) -> NDArray[np.float64]:
    """(..., 2) chromaticities -> (..., 3) XYZ of luminance 1."""
    x, y = xy[..., 0], xy[..., 1]
    return np.stack([x / y, np.ones_like(x), (1 - x - y) / y], axis=-1)


def _rgb_to_xyz_matrix() -> NDArray[np.float64]:
    primaries = xyz_of_chromaticity(_PRIMARIES).T
    return np.asarray(primaries * np.linalg.solve(primaries, xyz_of_chromaticity(D65)))


RGB_TO_XYZ = _rgb_to_xyz_matrix()
"""Linear Rec. 709 RGB to CIE XYZ; white (1, 1, 1) has Y = 1."""
XYZ_TO_RGB = np.linalg.inv(RGB_TO_XYZ)


def rgb_to_xyz(rgb: ArrayLike) -> Floats:
    """(..., 3) linear RGB -> (..., 3) XYZ, white at Y = 1."""
    return _apply(RGB_TO_XYZ, rgb)


def xyz_to_rgb(xyz: ArrayLike) -> Floats:
    """(..., 3) XYZ -> (..., 3) linear RGB; negative outside the gamut."""
    return _apply(XYZ_TO_RGB, xyz)


def luminance(rgb: ArrayLike) -> Floats:
    """(..., 3) linear RGB -> (...) relative luminance Y; white is 1."""
    rgb = floats(rgb)
    return np.asarray(rgb @ LUMINANCE.astype(rgb.dtype))


def srgb_encode(linear: ArrayLike) -> Floats:
    """Linear values -> sRGB values, element by element, clipped to [0, 1] [IEC61966]."""
    linear = np.clip(floats(linear), 0, 1)
    power = 1.055 * np.maximum(linear, 0.0031308) ** (1 / 2.4) - 0.055
    return np.where(linear <= 0.0031308, 12.92 * linear, power).astype(linear.dtype, copy=False)


def srgb_decode(encoded: ArrayLike) -> Floats:
    """sRGB values in [0, 1] -> linear values, element by element, the inverse of `srgb_encode`."""
    encoded = np.clip(floats(encoded), 0, 1)
    power = ((np.maximum(encoded, 0.04045) + 0.055) / 1.055) ** 2.4
    return np.where(encoded <= 0.04045, encoded / 12.92, power).astype(encoded.dtype, copy=False)


def floats(values: ArrayLike) -> Floats:
    array = np.asarray(values)
    return array if np.issubdtype(array.dtype, np.floating) else array.astype(np.float64)


def _apply(matrix: Floats, values: ArrayLike) -> Floats:
    array = floats(values)
    return np.asarray(array @ matrix.T.astype(array.dtype))
