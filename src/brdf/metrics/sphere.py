"""Pictures of a lit sphere: the directions at their pixels, and how far two of them are apart."""

from __future__ import annotations

import functools
import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..color import ciede2000, rgb_to_lab, srgb_encode
from ..errors import ParameterError
from ..reflectance import Reflectance

Array = NDArray[np.floating[Any]]

LIGHT_ANGLES = tuple(range(0, 180, 5))
"""Degrees between the direction to the light and to the viewer."""

SPHERE_SIZE = 128
"""Pixels across the sphere's picture."""


class DeltaE(NamedTuple):
    """Colour differences over pixels, CIEDE2000: about 1 is just noticeable."""

    mean: float
    p95: float
    """what 95 % of the pixels do not exceed"""


def sphere_pairs(size: int = SPHERE_SIZE, angles: tuple[float, ...] = LIGHT_ANGLES) -> tuple[Array, Array]:
    """(wi, wo), each (N, 3) float32: the local directions of all lit pixels of `size` x `size` pictures, one a light.

    The sphere's tangent runs along its circles of latitude about the picture's vertical axis; the light turns in the
    horizontal plane. Raises ParameterError for a size below 2.
    """
    wi, wo, _ = _lit_pixels(size, angles)
    return wi, wo


def sphere_lights(size: int = SPHERE_SIZE, angles: tuple[float, ...] = LIGHT_ANGLES) -> NDArray[np.intp]:
    """(N,) for each pixel of `sphere_pairs` which of the lights it is lit by."""
    return _lit_pixels(size, angles)[2]


def sphere_frames(size: int) -> Array:
    """(pixels, 3, 3) tangent, bitangent and normal as rows, of the `size` x `size` pixels that show the sphere.

    Rows of pixels run upwards; the viewer looks along the picture's z axis. Raises ParameterError for a size below 2.
    """
    if size < 2:
        raise ParameterError(f"a sphere's picture needs at least 2 pixels, got {size}")
    axis = (2 * np.arange(size) + 1) / size - 1
    x, y = np.meshgrid(axis, axis)
    inside = x * x + y * y < 1
    x, y = x[inside], y[inside]
    normal = np.stack([x, y, np.sqrt(1 - x * x - y * y)], -1)
    tangent = np.stack([normal[:, 2], np.zeros_like(x), -x], -1)
    tangent /= np.linalg.norm(tangent, axis=-1, keepdims=True)
    return np.stack([tangent, np.cross(normal, tangent), normal], 1)


@functools.lru_cache(maxsize=4)
def _lit_pixels(size: int, angles: tuple[float, ...]) -> tuple[Array, Array, NDArray[np.intp]]:
    frame = sphere_frames(size)
    wo = frame[:, :, 2]
    lights, views, counts = [], [], []
    for phi in np.radians(angles):
        wi = frame @ np.array([np.sin(phi), 0.0, np.cos(phi)])
        lit = wi[:, 2] > 0
        lights.append(wi[lit])
        views.append(wo[lit])
        counts.append(int(lit.sum()))
    wi, wo = (np.concatenate(parts).astype(np.float32) for parts in (lights, views))
    return wi, wo, np.repeat(np.arange(len(angles)), counts)


def sphere_radiance(m: Reflectance, size: int = SPHERE_SIZE, angles: tuple[float, ...] = LIGHT_ANGLES) -> Array:
    """(N, 3) radiance pi f cos(theta_i) of the lit pixels of `sphere_pairs`."""
    return np.asarray(math.pi * m.f_cos(*sphere_pairs(size, angles)))


# ---- from radiances --------------------------------------------------------------------------------------------


def psnr_of(reference: Array, other: Array) -> float:
    """PSNR [dB] between radiances (any shape): sRGB of the values clamped to [0, 1], peak 1; inf when they agree."""
    return float(decibels(np.mean(squared_differences(reference, other))))


def psnr_by_light(reference: Array, other: Array, lights: NDArray[np.intp], count: int = len(LIGHT_ANGLES)) -> Array:
    """(count,) PSNR [dB] between radiances (N, 3), each light by itself; `lights` (N,) as `sphere_lights` gives them.
    inf where the pictures agree, and where no pixel is lit."""
    return decibels(mean_by_light(squared_differences(reference, other).mean(1), lights, count))


def mean_by_light(values: Array, lights: NDArray[np.intp], count: int = len(LIGHT_ANGLES)) -> Array:
    """(count,) means of the values (N,) of each light's pixels; 0 where no pixel is lit."""
    pixels = np.bincount(lights, minlength=count)
    return np.asarray(np.bincount(lights, values, minlength=count) / np.maximum(pixels, 1))


def relative_rmse_of(reference: Array, other: Array) -> float:
    """||reference - other|| / ||reference||, linear; 0 when both are 0 everywhere."""
    error = math.sqrt(float(np.sum(np.square(reference - other, dtype=np.float64))))
    norm = math.sqrt(float(np.sum(np.square(reference, dtype=np.float64))))
    return error / norm if norm else (0.0 if error == 0 else math.inf)


def colour_differences(reference: Array, other: Array) -> Array:
    """(...) CIEDE2000 between radiances (..., 3) clamped to [0, 1], under D65 with a white of radiance 1."""
    return ciede2000(*(rgb_to_lab(np.clip(radiance, 0, 1)) for radiance in (reference, other)))


def delta_e_of(reference: Array, other: Array) -> DeltaE:
    """Mean and 95th percentile of `colour_differences`."""
    return pooled(colour_differences(reference, other))


def pooled(differences: Array) -> DeltaE:
    """Mean and 95th percentile."""
    return DeltaE(float(np.mean(differences, dtype=np.float64)), float(np.percentile(differences, 95)))


def squared_differences(reference: Array, other: Array) -> Array:
    """(...) squared differences of the sRGB values of radiances (...) clamped to [0, 1]."""
    return np.square(srgb_encode(reference) - srgb_encode(other), dtype=np.float64)


def decibels(mean_square: Any) -> Array:
    """PSNR [dB] of mean squared differences; inf for 0."""
    with np.errstate(divide="ignore"):
        return np.asarray(-10 * np.log10(mean_square))


# ---- from reflectances -----------------------------------------------------------------------------------------


def psnr(reference: Reflectance, other: Reflectance, size: int = SPHERE_SIZE) -> float:
    """PSNR [dB] between pictures of a sphere, all lights pooled; inf when they are identical."""
    return psnr_of(sphere_radiance(reference, size), sphere_radiance(other, size))


def psnr_by_angle(reference: Reflectance, other: Reflectance, size: int = SPHERE_SIZE) -> Array:
    """PSNR [dB] between pictures of a sphere, one for each of `LIGHT_ANGLES`; inf when they are identical."""
    radiances = sphere_radiance(reference, size), sphere_radiance(other, size)
    return psnr_by_light(*radiances, sphere_lights(size))


def delta_e(reference: Reflectance, other: Reflectance, size: int = SPHERE_SIZE) -> DeltaE:
    """Mean and 95th percentile of CIEDE2000 over the lit pixels of pictures of a sphere, all lights pooled."""
    return delta_e_of(sphere_radiance(reference, size), sphere_radiance(other, size))


def relative_rmse(reference: Reflectance, other: Reflectance, size: int = SPHERE_SIZE) -> float:
    """Relative RMSE between pictures of a sphere, all lights pooled."""
    return relative_rmse_of(sphere_radiance(reference, size), sphere_radiance(other, size))
