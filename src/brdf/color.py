"""Colour: spectra to linear RGB, RGB and XYZ, the sRGB transfer curve.

RGB is linear with Rec. 709 primaries and the D65 white throughout the package. A reflectance spectrum becomes
RGB as it looks under illuminant E (equal energy), adapted to D65 (Bradford), so that a constant reflectance r
is (r, r, r); saturated colours differ from those under D65 itself by up to 0.03.

The CIE 1931 2-degree matching functions are the multi-lobe fit of Wyman2013. It departs from the tabulated
functions by at most 0.015 for x, 0.010 for y and 0.035 for z (their maxima are 1.06, 1.00 and 1.78).
"""

from __future__ import annotations

import functools
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import ParameterError

Floats = NDArray[np.floating[Any]]

LUMINANCE = np.array([0.2126390058715103, 0.7151686787677560, 0.0721923153607337])
"""Relative luminance of the Rec. 709 primaries: the second row of `RGB_TO_XYZ`."""

_PRIMARIES = np.array([[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]])
"""Chromaticities (x, y) of red, green, blue [ITU709]."""
_D65 = np.array([0.3127, 0.3290])
"""Chromaticity of the white point [ITU709]."""
_BRADFORD = np.array([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]])
"""XYZ to sharpened cone responses [Lam1985]."""

_FIRST, _LAST = 360, 830
"""The visible range, nm: where the matching functions are integrated."""


def _xyz_of_chromaticity(xy: NDArray[np.float64]) -> NDArray[np.float64]:
    """(..., 2) chromaticities -> (..., 3) XYZ of luminance 1."""
    x, y = xy[..., 0], xy[..., 1]
    return np.stack([x / y, np.ones_like(x), (1 - x - y) / y], axis=-1)


def _rgb_to_xyz_matrix() -> NDArray[np.float64]:
    primaries = _xyz_of_chromaticity(_PRIMARIES).T
    return np.asarray(primaries * np.linalg.solve(primaries, _xyz_of_chromaticity(_D65)))


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
    rgb = _floats(rgb)
    return np.asarray(rgb @ LUMINANCE.astype(rgb.dtype))


def srgb_encode(linear: ArrayLike) -> Floats:
    """Linear values -> sRGB values, element by element, clipped to [0, 1] [IEC61966]."""
    linear = np.clip(_floats(linear), 0, 1)
    power = 1.055 * np.maximum(linear, 0.0031308) ** (1 / 2.4) - 0.055
    return np.where(linear <= 0.0031308, 12.92 * linear, power).astype(linear.dtype, copy=False)


def srgb_decode(encoded: ArrayLike) -> Floats:
    """sRGB values in [0, 1] -> linear values, element by element, the inverse of `srgb_encode`."""
    encoded = np.clip(_floats(encoded), 0, 1)
    power = ((np.maximum(encoded, 0.04045) + 0.055) / 1.055) ** 2.4
    return np.where(encoded <= 0.04045, encoded / 12.92, power).astype(encoded.dtype, copy=False)


def matching_functions(wavelengths: ArrayLike) -> NDArray[np.float64]:
    """CIE 1931 2-degree x, y, z at wavelengths in nm: (..., ) -> (..., 3). Source: Wyman2013, equation 4."""
    nm = np.asarray(wavelengths, np.float64)

    def lobe(height: float, peak: float, below: float, above: float) -> Any:
        return height * np.exp(-0.5 * ((nm - peak) / np.where(nm < peak, below, above)) ** 2)

    x = lobe(1.056, 599.8, 37.9, 31.0) + lobe(0.362, 442.0, 16.0, 26.7) + lobe(-0.065, 501.1, 20.4, 26.2)
    y = lobe(0.821, 568.8, 46.9, 40.5) + lobe(0.286, 530.9, 16.3, 31.1)
    z = lobe(1.217, 437.0, 11.8, 36.0) + lobe(0.681, 459.0, 26.0, 13.8)
    return np.stack([x, y, z], axis=-1)


def spectrum_to_rgb(spectrum: ArrayLike, wavelengths: ArrayLike) -> Floats:
    """A reflectance spectrum (..., W) at `wavelengths` (W,) in nm -> linear RGB (..., 3).

    The spectrum is linear between its samples and constant beyond them [CIE15]. Colours outside the Rec. 709
    gamut get negative components. Raises ParameterError when the wavelengths are not positive, finite and
    increasing, or do not fit the spectrum.
    """
    spectrum = _floats(spectrum)
    weights = rgb_weights(wavelengths)
    if spectrum.ndim == 0 or spectrum.shape[-1] != len(weights):
        raise ParameterError(f"spectrum must have shape (..., {len(weights)}), got {spectrum.shape}")
    return np.asarray(spectrum @ weights.astype(spectrum.dtype))


def rgb_weights(wavelengths: ArrayLike) -> NDArray[np.float64]:
    """(W, 3) weights that turn a spectrum at `wavelengths` (W,) in nm into RGB; each column sums to 1.

    Raises ParameterError as `spectrum_to_rgb`.
    """
    nm = np.asarray(wavelengths, np.float64)
    if nm.ndim != 1 or nm.size == 0 or not np.all(np.isfinite(nm)) or nm[0] <= 0 or np.any(np.diff(nm) <= 0):
        raise ParameterError("wavelengths must be a list of positive numbers (nm) that increase")
    return _weights(tuple(nm.tolist()))


@functools.lru_cache(maxsize=32)
def _weights(wavelengths: tuple[float, ...]) -> NDArray[np.float64]:
    grid = np.arange(_FIRST, _LAST + 1.0)
    matching = matching_functions(grid)
    hats = np.stack([np.interp(grid, wavelengths, row) for row in np.eye(len(wavelengths))])
    white = matching.sum(0) / matching[:, 1].sum()
    weights = (hats @ matching / matching[:, 1].sum()) @ (XYZ_TO_RGB @ _adaptation(white)).T
    weights.flags.writeable = False
    return np.asarray(weights)


def _adaptation(white: NDArray[np.float64]) -> NDArray[np.float64]:
    """XYZ under `white` to XYZ under D65: cone responses scaled one by one (von Kries)."""
    gains = (_BRADFORD @ _xyz_of_chromaticity(_D65)) / (_BRADFORD @ white)
    return np.asarray(np.linalg.solve(_BRADFORD, gains[:, None] * _BRADFORD))


def _floats(values: ArrayLike) -> Floats:
    array = np.asarray(values)
    return array if np.issubdtype(array.dtype, np.floating) else array.astype(np.float64)


def _apply(matrix: Floats, values: ArrayLike) -> Floats:
    array = _floats(values)
    return np.asarray(array @ matrix.T.astype(array.dtype))
