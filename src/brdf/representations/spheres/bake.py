"""Reflectance -> pictures of a sphere."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError, UnknownNameError
from ...reflectance import Reflectance
from ..baking.bake import require_isotropic

Array = NDArray[np.floating[Any]]

ANGLES: dict[str, tuple[float, ...]] = {"plastic": (0, 45, 90, 135), "metal": (0, 30, 60, 90, 120, 150)}
"""The paper's angles between light and viewer [degrees]."""

LIMB = 0.9999
"""Where dilated texels look: just inside the disc, whose very edge is seen at no angle."""

LARGEST_SIZE = 8192


def named_angles(angles: str | Sequence[float]) -> Sequence[float]:
    """The angles of a preset, or the given ones. Raises UnknownNameError."""
    if not isinstance(angles, str):
        return angles
    if angles not in ANGLES:
        raise UnknownNameError("set of light angles", angles, ANGLES)
    return ANGLES[angles]


def disc(size: int) -> tuple[Array, Array]:
    """x (rightwards) and y (upwards) in (-1, 1) of the texel centres, each (size, size), top row first.

    Raises ParameterError for a size that is no picture's.
    """
    if not 2 <= size <= LARGEST_SIZE:
        raise ParameterError(f"a picture is 2 to {LARGEST_SIZE} texels wide, got {size!r}")
    axis = (2 * np.arange(size) + 1) / size - 1
    x, y = np.meshgrid(axis, -axis)
    return x, y


def sphere_pictures(m: Reflectance, angles: Sequence[float], size: int, dilate: bool) -> NDArray[np.float32]:
    """(N, size, size, 3) radiance pi f cos(theta_i), one picture an angle [degrees].

    Around the disc black, or with `dilate` the radiance of the limb's nearest point. Raises ReflectanceError.
    """
    require_isotropic(m)
    x, y = disc(size)
    radius = np.hypot(x, y)
    drawn = np.ones_like(x, bool) if dilate else radius < 1
    scale = np.minimum(1.0, LIMB / np.maximum(radius, 1e-9))
    x, y = (x * scale)[drawn], (y * scale)[drawn]
    images = np.zeros((len(angles), size, size, 3), np.float32)
    for image, angle in zip(images, angles, strict=True):
        image[drawn] = sphere_radiance(m, x, y, math.radians(angle))
    return images


def sphere_radiance(m: Reflectance, x: Array, y: Array, phi: float) -> Array:
    """(n, 3) radiance pi f cos(theta_i) of the sphere's points (n,) x, y; viewer +z, light (sin phi, 0, cos phi)."""
    z = np.sqrt(np.maximum(1 - x * x - y * y, 0))
    r = np.hypot(x, y)
    at_pole = r < 1e-9  # where any azimuth will do
    toward_x = np.where(at_pole, 1, x / np.where(at_pole, 1, r))
    toward_y = np.where(at_pole, 0, y / np.where(at_pole, 1, r))
    sine, cosine = math.sin(phi), math.cos(phi)
    # the local frame whose tangent, (v - z n) / r, points towards the viewer
    wi = np.stack([r * cosine - z * toward_x * sine, toward_y * sine, x * sine + z * cosine], -1)
    wo = np.stack([r, np.zeros_like(r), z], -1)
    return np.asarray(math.pi * m.f_cos(wi, wo))
