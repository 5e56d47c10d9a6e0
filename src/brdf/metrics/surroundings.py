"""Pictures of a sphere lit from all around: soft lamps and a gradient, given by a formula.

The same protocol as under single lights: an orthographic view, radiance of what is reflected, a white diffuser about 1.
Light comes from `LIGHTS` directions spread evenly over the sphere.
"""

from __future__ import annotations

import functools
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..reflectance import Reflectance
from .sphere import sphere_frames

Array = NDArray[np.floating[Any]]

SIZE = 40
"""Pixels across the sphere's picture."""

LIGHTS = 3072
"""Directions of light: about 3.7 degrees from neighbour to neighbour."""

ABOVE, BELOW = (0.55, 0.6, 0.7), (0.2, 0.18, 0.16)
"""Radiance of the gradient straight up and straight down."""

LAMPS = (
    ((-0.65, 0.6, 0.47), 18.0, (9.0, 8.6, 8.0)),
    ((0.8, 0.25, 0.54), 40.0, (6.0, 6.4, 7.0)),
    ((0.2, 0.5, -0.84), 60.0, (8.0, 7.6, 7.0)),
)
"""Soft lamps: direction (x to the right, y up, z to the viewer), sharpness, radiance in the middle."""


def radiance_of_surroundings(directions: Array) -> Array:
    """(..., 3) radiance that arrives from unit directions (..., 3)."""
    up = directions[..., 1:2] / 2 + 0.5
    total = (1 - up) * np.array(BELOW) + up * np.array(ABOVE)
    for toward, sharpness, radiance in LAMPS:
        axis = np.array(toward) / np.linalg.norm(toward)
        total = total + np.exp(sharpness * (directions @ axis - 1))[..., None] * np.array(radiance)
    return np.asarray(total)


def lit_from_all_around(m: Reflectance, size: int = SIZE) -> Array:
    """(pixels, 3) radiance towards the viewer of the pixels of a sphere that is lit from all around.

    Pixels in the order of `sphere_frames`. Raises ParameterError for a size below 2.
    """
    wi, wo, weight, pixel, count = _pairs(size)
    reflected = m(wi, wo) * weight
    return np.stack([np.bincount(pixel, reflected[:, c], count) for c in range(3)], -1)


@functools.lru_cache(maxsize=2)
def _pairs(size: int) -> tuple[Array, Array, Array, NDArray[np.intp], int]:
    """Local directions of every pixel and light above its horizon, light times cosine times solid angle, the pixel."""
    frame = sphere_frames(size)
    number = np.arange(LIGHTS) + 0.5
    z, phi = 1 - 2 * number / LIGHTS, number * math.pi * (3 - math.sqrt(5))
    world = np.stack([np.sqrt(1 - z * z) * np.cos(phi), np.sqrt(1 - z * z) * np.sin(phi), z], -1)
    light = radiance_of_surroundings(world) * (4 * math.pi / LIGHTS)
    local = np.einsum("pij,lj->pli", frame, world)
    pixel, which = np.nonzero(local[..., 2] > 0)
    wi = local[pixel, which]
    return (
        wi.astype(np.float32),
        frame[pixel, :, 2].astype(np.float32),
        (light[which] * wi[:, 2:]).astype(np.float32),
        pixel,
        len(frame),
    )
