"""Colour: spectra to linear RGB, RGB and XYZ, the sRGB transfer curve, CIELAB and colour differences.

RGB is linear with Rec. 709 primaries and the D65 white throughout the package. A reflectance spectrum becomes
RGB as it looks under illuminant E (equal energy), adapted to D65 (Bradford), so that a constant reflectance r
is (r, r, r); saturated colours differ from those under D65 itself by up to 0.03.
"""

from .difference import ciede2000, rgb_to_lab, xyz_to_lab
from .rgb import LUMINANCE, RGB_TO_XYZ, XYZ_TO_RGB, luminance, rgb_to_xyz, srgb_decode, srgb_encode, xyz_to_rgb
from .spectra import matching_functions, rgb_weights, spectrum_to_rgb

__all__ = [
    "LUMINANCE", "RGB_TO_XYZ", "XYZ_TO_RGB", "ciede2000", "luminance", "matching_functions", "rgb_to_lab", "rgb_to_xyz",
    "rgb_weights", "spectrum_to_rgb", "srgb_decode", "srgb_encode", "xyz_to_lab", "xyz_to_rgb",
]  # fmt: skip
