"""What is seen past the shape: a neutral gradient, the environment out of focus, one colour, or nothing."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import ParameterError, SceneError, UnknownNameError
from .compiled import in_parallel
from .environment import Environment
from .scene import Camera
from .surface_kernels import camera_rays

Floats = NDArray[np.float32]

KINDS = ("gradient", "environment", "transparent")
LIGHTEST, DARKEST = 0.16, 0.035
"""Radiance of the gradient in the middle and in the corners: a little darker than middle grey."""


def check(background: str | ArrayLike, environment: Environment | None) -> str | Floats:
    """A kind of background, or an RGB colour (3,). Raises UnknownNameError, ParameterError, SceneError."""
    if not isinstance(background, str):
        colour = np.asarray(background, np.float32)
        if colour.shape not in ((), (3,)) or not (np.isfinite(colour) & (colour >= 0)).all():
            raise ParameterError(f"background must be a name or an RGB triple >= 0, got {background!r}")
        return np.broadcast_to(colour, (3,))
    if background not in KINDS:
        raise UnknownNameError("background", background, KINDS)
    if background == "environment" and environment is None:
        raise SceneError("background 'environment' needs an environment; give one or choose 'gradient'")
    return background


def painted(
    background: str | Floats, camera: Camera, environment: Environment | None, width: int, height: int
) -> Floats:
    """(H, W, 3) radiance; zero for "transparent"."""
    if not isinstance(background, str):
        return np.broadcast_to(background, (height, width, 3)).astype(np.float32)
    if background == "environment" and environment is not None:
        _, directions = rays(camera, np.arange(width * height, dtype=np.int32), 1, width, height)
        return environment.blurred().radiance(directions)[0].reshape(height, width, 3)
    if background == "transparent":
        return np.zeros((height, width, 3), np.float32)
    x = (np.arange(width) + 0.5) / width - 0.5
    y = (np.arange(height) + 0.5) / height - 0.45
    squared = np.minimum((x**2 + y[:, None] ** 2) / 0.5, 1)
    grey = DARKEST + (LIGHTEST - DARKEST) * (1 - squared) ** 2
    return np.repeat(grey[..., None], 3, -1).astype(np.float32)


def offsets(per_side: int) -> Floats:
    """(per_side², 2) places in a pixel: one in each cell of the grid, and no two in one row or column."""
    i, j = np.meshgrid(np.arange(per_side), np.arange(per_side), indexing="ij")
    x, y = (i + (j + 0.5) / per_side) / per_side, (j + (i + 0.5) / per_side) / per_side
    return np.stack([x.ravel(), y.ravel()], -1).astype(np.float32)


def rays(camera: Camera, pixels: NDArray[np.int32], per_side: int, width: int, height: int) -> tuple[Any, Any]:
    """Origins and directions (len(pixels) · per_side², 3) of the camera's rays; a pixel is row * width + column."""
    count = len(pixels) * per_side**2
    origins, directions = np.empty((count, 3), np.float32), np.empty((count, 3), np.float32)
    parallel = camera.height is not None
    half = camera.height / 2 if camera.height is not None else np.tan(np.radians(camera.fov / 2))
    in_parallel(
        camera_rays, count, camera.frame, camera.position[None], float(half), float(width), float(height), parallel,
        pixels, per_side, width, offsets(per_side), origins, directions,
    )  # fmt: skip
    return origins, directions
