"""The paper's own form of its method: a picture of normals, the viewer's direction taken as +z at every pixel.

Right for distant viewers only; kept to draw the paper's figures and to measure what the per-pixel frame of
`SphereImages` is worth. The light's azimuth gamma is taken out by turning the normals by -gamma about the view axis.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import ParameterError, UnknownNameError
from ...formula import Vec, texture3d
from ...formula.bound import Bound, bound_value
from ...geometry.directions import normalized
from .bake import disc
from .formula import Fetch
from .sphere_images import SphereImages

Array = NDArray[np.floating[Any]]
Pyramid = list[NDArray[np.float32]]


def sphere_normals(size: int) -> Array:
    """(size, size, 3) view-space normals of a sphere that fills the picture, top row first; 0 around it."""
    x, y = disc(size)
    inside = x * x + y * y < 1
    z = np.sqrt(np.where(inside, 1 - x * x - y * y, 0))
    return np.where(inside[..., None], np.stack([x, y, z], -1), 0)


def fixed_view(images: SphereImages, normals: ArrayLike, light: ArrayLike, filter: str = "bilinear") -> Array:
    """The picture (H, W, 3) of radiance pi f cos(theta_i) of a surface under one directional light.

    `normals` (H, W, 3): unit vectors in view space (x right, y up, z toward the viewer), 0 where there is no surface,
    which stays black; those facing away are treated as facing the viewer edge-on. `light` (3,): toward the light,
    same space. `filter`: "bilinear", or "trilinear" between levels of detail, which differences between neighbouring
    pixels choose as GPUs do. Where the normal turns away from the light the picture is black if the blend's `mask`
    says so. Raises ParameterError for other shapes, UnknownNameError for the filter.
    """
    n: Array = np.asarray(normals, np.float64)
    toward: Array = np.asarray(light, np.float64)
    if n.ndim != 3 or n.shape[2] != 3 or toward.shape != (3,) or not np.linalg.norm(toward) > 0:
        raise ParameterError(f"normals must be (H, W, 3) and light (3,) and not zero, got {n.shape} and {light!r}")
    if filter not in FILTERS:
        raise UnknownNameError("texture filter", filter, FILTERS)
    toward = normalized(toward)
    gamma = math.atan2(toward[1], toward[0])
    x = math.cos(gamma) * n[..., 0] + math.sin(gamma) * n[..., 1]
    y = math.cos(gamma) * n[..., 1] - math.sin(gamma) * n[..., 0]
    z = np.maximum(n[..., 2], 0)
    surface = np.linalg.norm(n, axis=-1) > 0.5
    phi = np.full_like(x, math.atan2(math.hypot(toward[0], toward[1]), toward[2]))
    fetch = FILTERS[filter](images, surface)
    radiance = np.stack(_bound(images).radiance(x, y, z, phi, fetch).components, -1)
    if images.options["mask"]:
        surface &= n @ toward > 0
    return np.where(surface[..., None], radiance, 0)


def _bound(images: SphereImages) -> Any:
    """The images as their formula sees them, with plain arrays."""

    def lookup(name: str) -> Any:
        return bound_value(images.values[name], float) if name in images.values else images.textures[name]

    return Bound(images, lookup)


def _bilinear(images: SphereImages, surface: NDArray[np.bool_]) -> Fetch:
    fetch: Fetch = _bound(images).fetch
    return fetch


def _trilinear(images: SphereImages, surface: NDArray[np.bool_]) -> Fetch:
    """Level of detail log2 of the pixel's longer side in texels, from 2 x 2 quads of pixels on the surface."""
    pyramid = mip_pyramid(images.texels)

    def fetch(number: Any, u: Any, v: Any) -> Vec:
        level = np.clip(_level_of_detail(u, v, surface, images.size), 0, len(pyramid) - 1)
        texel = Vec(*(np.zeros_like(u) for _ in range(3)))
        for i, texture in enumerate(pyramid):
            share = np.clip(1 - np.abs(level - i), 0, 1)
            if share.any():
                texel = texel + texture3d(texture, (number + 0.5) / len(texture), v, u) * share
        return texel

    return fetch


def mip_pyramid(pictures: NDArray[np.float32]) -> Pyramid:
    """(N, size, size, 3) and its halvings, each texel the mean of four, down to one texel (or to an odd size)."""
    levels = [pictures]
    while levels[-1].shape[1] > 1 and levels[-1].shape[1] % 2 == 0:
        n, size = levels[-1].shape[0], levels[-1].shape[1] // 2
        levels.append(levels[-1].reshape(n, size, 2, size, 2, 3).mean((2, 4), dtype=np.float32))
    return levels


def _level_of_detail(u: Array, v: Array, surface: NDArray[np.bool_], size: int) -> Array:
    """(H, W); differences to pixels off the surface count as none."""
    squared = [_quad_difference(u, surface, axis) ** 2 + _quad_difference(v, surface, axis) ** 2 for axis in (0, 1)]
    longest = np.maximum(*squared)
    return np.asarray(0.5 * np.log2(np.maximum(longest * size**2, 1e-12)))


def _quad_difference(values: Array, surface: NDArray[np.bool_], axis: int) -> Array:
    """The difference along one axis between the two pixels of a quad, at both."""
    size = values.shape[axis]
    partner = np.minimum(np.arange(size) ^ 1, size - 1)
    difference = np.abs(np.take(values, partner, axis) - values)
    return np.where(surface & np.take(surface, partner, axis), difference, 0)


FILTERS = {"bilinear": _bilinear, "trilinear": _trilinear}
"""How texels are filtered, by name."""
