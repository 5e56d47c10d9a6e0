"""Colour against published values: primaries, the sRGB curve, matching functions, spectra of known colours."""

from __future__ import annotations

import numpy as np
import pytest

from brdf import color
from brdf.errors import ParameterError

# IEC 61966-2-1 and Lindbloom: linear sRGB to XYZ (D65), to the digits published there.
PUBLISHED_RGB_TO_XYZ = [
    [0.4124564, 0.3575761, 0.1804375],
    [0.2126729, 0.7151522, 0.0721750],
    [0.0193339, 0.1191920, 0.9503041],
]
# CIE 1931 2-degree observer, 5 nm table (CIE 15): x, y, z at some wavelengths.
PUBLISHED_MATCHING = {
    450: (0.3362, 0.0380, 1.77211),
    500: (0.0049, 0.3230, 0.2720),
    550: (0.43345, 0.99495, 0.00875),
    600: (1.0622, 0.6310, 0.0008),
    650: (0.2835, 0.1070, 0.0),
}


def test_matrix_is_the_published_one():
    np.testing.assert_allclose(color.RGB_TO_XYZ, PUBLISHED_RGB_TO_XYZ, atol=3e-4)


def test_white_is_d65():
    x, y, z = color.rgb_to_xyz([1.0, 1.0, 1.0])
    np.testing.assert_allclose((x / (x + y + z), y / (x + y + z), y), (0.3127, 0.3290, 1), rtol=1e-12)


def test_xyz_and_rgb_are_inverse():
    rgb = np.random.default_rng(1).random((50, 3))
    np.testing.assert_allclose(color.xyz_to_rgb(color.rgb_to_xyz(rgb)), rgb, atol=1e-14)


def test_luminance_is_y():
    rgb = np.random.default_rng(2).random((4, 5, 3))
    np.testing.assert_allclose(color.luminance(rgb), color.rgb_to_xyz(rgb)[..., 1], rtol=1e-12)


@pytest.mark.parametrize(
    ("linear", "encoded"), [(0.0, 0.0), (1.0, 1.0), (0.2140411, 0.5), (0.0031308, 0.0404499), (0.18, 0.4613561)]
)
def test_srgb_curve(linear, encoded):
    assert color.srgb_encode(linear) == pytest.approx(encoded, abs=1e-6)
    assert color.srgb_decode(encoded) == pytest.approx(linear, abs=1e-6)


def test_srgb_round_trip_and_clipping():
    values = np.linspace(0, 1, 1001)
    np.testing.assert_allclose(color.srgb_decode(color.srgb_encode(values)), values, atol=1e-7)
    np.testing.assert_allclose(color.srgb_encode([-1.0, 7.0]), [0, 1], atol=1e-15)


@pytest.mark.parametrize("function", [color.srgb_encode, color.srgb_decode, color.luminance, color.rgb_to_xyz])
def test_float32_stays_float32(function):
    assert function(np.full((2, 3), 0.5, np.float32)).dtype == np.float32


@pytest.mark.parametrize("nm", PUBLISHED_MATCHING)
def test_matching_functions(nm):
    departure = np.abs(color.matching_functions(nm) - PUBLISHED_MATCHING[nm])
    assert np.all(departure < (0.016, 0.011, 0.036)), departure


@pytest.mark.parametrize("wavelengths", [np.arange(400, 701, 10.0), np.arange(360, 831, 5.0), [550.0], [450.0, 611.0]])
def test_a_constant_spectrum_is_grey(wavelengths):
    spectrum = np.full((2, len(wavelengths)), 0.37)
    np.testing.assert_allclose(color.spectrum_to_rgb(spectrum, wavelengths), 0.37, rtol=1e-12)


def test_sampling_does_not_matter_to_a_smooth_spectrum():
    fine, coarse = np.arange(360.0, 831), np.arange(360, 831, 10.0)
    smooth = [0.5 + 0.3 * np.sin(nm / 60) for nm in (fine, coarse)]
    rgb = [color.spectrum_to_rgb(s, nm) for s, nm in zip(smooth, (fine, coarse), strict=True)]
    np.testing.assert_allclose(rgb[0], rgb[1], atol=2e-3)


@pytest.mark.parametrize(("low", "high", "channel"), [(600, 700, 0), (510, 570, 1), (400, 480, 2)])
def test_band_has_its_hue(low, high, channel):
    nm = np.arange(400, 701, 5.0)
    rgb = color.spectrum_to_rgb(((nm >= low) & (nm <= high)).astype(float), nm)
    assert np.argmax(rgb) == channel


@pytest.mark.parametrize(
    ("spectrum", "under_d65"),
    [
        (lambda nm: 0.1 + 0.6 / (1 + np.exp(-(nm - 590) / 12)), (0.6909, 0.1248, 0.0851)),
        (lambda nm: 0.1 + 0.5 * np.exp(-(((nm - 530) / 30) ** 2)), (-0.0293, 0.4203, 0.0905)),
        (lambda nm: 0.05 + 0.5 * np.exp(-(((nm - 450) / 30) ** 2)), (0.0573, 0.0311, 0.4413)),
        (lambda nm: 0.05 + 0.7 / (1 + np.exp(-(nm - 510) / 15)), (0.8511, 0.6290, 0.0149)),
    ],
    ids=["red", "green", "blue", "yellow"],
)
def test_close_to_the_colour_under_d65(spectrum, under_d65):
    """The values under D65 were made with the tabulated matching functions and illuminant of Mitsuba 3.9."""
    nm = np.arange(400, 701, 10.0)
    np.testing.assert_allclose(color.spectrum_to_rgb(spectrum(nm), nm), under_d65, atol=0.033)


@pytest.mark.parametrize("bad", [[], [500.0, 400.0], [400.0, 400.0], [np.nan], [-1.0, 5.0], [[400.0]]])
def test_refuses_broken_wavelengths(bad):
    with pytest.raises(ParameterError, match="positive numbers \\(nm\\) that increase"):
        color.rgb_weights(bad)


def test_refuses_a_spectrum_of_another_length():
    with pytest.raises(ParameterError, match=r"shape \(\.\.\., 2\), got \(3,\)"):
        color.spectrum_to_rgb([1.0, 1.0, 1.0], [400.0, 500.0])
