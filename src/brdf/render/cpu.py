"""The renderer that needs neither GL nor a GPU: embree finds what is seen, compiled kernels shade it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..formula.kernels import compile_ahead
from ..reflectance import Reflectance
from . import background as backgrounds
from .progress import Progress, Report
from .shading import EnvironmentPass, from_light, pixel_means
from .task import Task, checked_size, seen_rectangle
from .visibility import ShadingPoints, surface_of

Floats = NDArray[np.float32]

RAYS_AT_ONCE = 1 << 20
"""Camera rays traced together: bounds the memory (about 250 MB) whatever the size of the picture."""
WORTH_COMPILING_AHEAD = 100_000
"""Pixels above which the materials' kernels are sure to be needed."""


def prepare(reflectances: Sequence[Reflectance], *scene: Any) -> None:
    """Begin to compile what a large picture needs, while the scene is made. Takes what `task.checked` takes."""
    width, height = checked_size(scene[4])
    if width * height > WORTH_COMPILING_AHEAD:
        compile_ahead(reflectances)


def draw(task: Task, progress: Report | bool | None = None) -> tuple[Floats, Floats]:
    """Radiance that the shape reflects to each pixel (H W, 3), and how much of the pixel it covers (H W,)."""
    scene, width, height = task.scene, task.width, task.height
    surface = surface_of(scene.mesh)
    blocker = surface if task.shadows else None

    rows, columns = seen_rectangle(scene, width, height)
    per_pixel, rounds = task.per_pixel, task.rounds
    at_once = max(1, RAYS_AT_ONCE // per_pixel // max(1, columns.stop - columns.start))
    bands = [slice(row, min(row + at_once, rows.stop)) for row in range(rows.start, rows.stop, at_once)]
    steps = len(scene.lights) + rounds

    radiance = np.zeros((height * width, 3), np.float32)
    coverage = np.zeros(height * width, np.float32)
    with Progress("rendering", max(1, len(bands) * len(task.reflectances) * steps), progress) as bar:
        for band in bands:
            row, column = np.mgrid[band, columns]
            pixels = (row * width + column).astype(np.int32).ravel()
            met = surface.meet(*backgrounds.rays(scene.camera, pixels, task.per_side, width, height))
            own_pixels, ranks = pixels[met.rays // per_pixel], (met.rays % per_pixel).astype(np.int32)
            reflected = np.zeros((len(own_pixels), 3), np.float32)
            around = scene.environment and EnvironmentPass(
                scene.environment, own_pixels, ranks, per_pixel, rounds, width, task.seed
            )
            which = task.which(own_pixels % width)
            for number, reflectance in enumerate(task.reflectances):
                part = np.flatnonzero(which == number)
                at: ShadingPoints = met[part] if len(task.reflectances) > 1 else met
                for light in scene.lights:
                    reflected[part] += from_light(reflectance, at, light, blocker)
                    bar.step()
                if around:
                    reflected[part] += around.reflected(reflectance, at, part, blocker, bar.step)
            means, covered = pixel_means(reflected, own_pixels, height * width, per_pixel)
            radiance += means
            coverage += covered
    return radiance, coverage
