"""Reflectance spectra to linear RGB.

The CIE 1931 2-degree matching functions are the multi-lobe fit of Wyman2013. It departs from the tabulated
functions by at most 0.015 for x, 0.010 for y and 0.035 for z (their maxima are 1.06, 1.00 and 1.78).
"""

from __future__ import annotations

import functools
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import ParameterError
from .rgb import D65, XYZ_TO_RGB, Floats, floats, xyz_of_chromaticity

_BRADFORD = np.array([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]])
"""XYZ to sharpened cone responses [Lam1985]."""

_FIRST, _LAST = 360, 830
"""The visible range, nm: where the matching functions are integrated."""


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
    spectrum = floats(spectrum)
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
    gains = (_BRADFORD @ xyz_of_chromaticity(D65)) / (_BRADFORD @ white)
    return np.asarray(np.linalg.solve(_BRADFORD, gains[:, None] * _BRADFORD))
