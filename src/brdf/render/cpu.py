"""The renderer that needs neither GL nor a GPU: embree finds what is seen, compiled kernels shade it."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import ParameterError, SceneError
from ..formula.kernels import compile_ahead
from ..reflectance import Reflectance
from . import background as backgrounds
from . import environment as environments
from . import lights as light_texts
from .environment import Environment
from .image import Image
from .lights import Light
from .mesh import Mesh
from .mesh import load as load_mesh
from .progress import Progress, Report
from .scene import Camera, Scene
from .shading import EnvironmentPass, from_light, pixel_means
from .visibility import ShadingPoints, surface_of

Floats = NDArray[np.float32]

RAYS_AT_ONCE = 1 << 20
"""Camera rays traced together: bounds the memory (about 250 MB) whatever the size of the picture."""
LARGEST_SIDE = 8192
WORTH_COMPILING_AHEAD = 100_000
"""Pixels above which the materials' kernels are sure to be needed."""


def render(
    reflectance: Reflectance,
    mesh: str | os.PathLike[str] | Mesh = "teapot",
    lights: Iterable[Light | str] | Light | str | None = None,
    env: str | os.PathLike[str] | float | Environment | None = None,
    camera: Camera | None = None,
    size: tuple[int, int] = (800, 600),
    samples: int = 16,
    supersampling: int = 2,
    shadows: bool = True,
    background: str | ArrayLike = "gradient",
    seed: int = 0,
    progress: Report | bool | None = None,
) -> Image:
    """A picture of a shape made of `reflectance`, lit directly (no light bounces twice).

    `mesh`: "teapot", "sphere", "plane", or a mesh file. `lights`: lights, or text such as
    "directional:theta=30,phi=45,power=3" and "point:1/2/3". `env`: "studio", an .hdr or .exr file, or a number (the
    same radiance everywhere). With neither, the studio. `camera`: by default one that frames the mesh. `size`: width
    and height in pixels. `samples`: directions to the environment per pixel, of each of the two kinds;
    `supersampling`² rays per pixel. `shadows`: whether the shape shadows itself. `background`: "gradient",
    "environment" (out of focus), "transparent" or an RGB colour. The same `seed` gives the same picture. `progress`: a
    function of the share done, True for a bar, False for none; by default a bar in a terminal when it takes longer
    than a second.
    Raises SceneError, ParameterError, UnknownNameError, FileError.
    """
    return _render(
        [reflectance], mesh, lights, env, camera, size, samples, supersampling, shadows, background, seed, progress
    )


def render_halves(
    left: Reflectance, right: Reflectance, *, divider: float = 1.0, mesh: str | os.PathLike[str] | Mesh = "teapot",
    lights: Iterable[Light | str] | Light | str | None = None,
    env: str | os.PathLike[str] | float | Environment | None = None, camera: Camera | None = None,
    size: tuple[int, int] = (800, 600), samples: int = 16, supersampling: int = 2, shadows: bool = True,
    background: str | ArrayLike = "gradient", seed: int = 0, progress: Report | bool | None = None,
) -> Image:  # fmt: skip
    """One picture whose left half is made of `left` and whose right half of `right`; for the rest as `render`.

    `divider`: width in pixels of the light line between them, 0 for none.
    """
    image = _render(
        [left, right], mesh, lights, env, camera, size, samples, supersampling, shadows, background, seed, progress
    )
    if divider > 0:
        start = size[0] // 2 - int(divider) // 2
        image.pixels[:, start : start + max(1, int(divider))] = 1.0
        if image.alpha is not None:
            image.alpha[:, start : start + max(1, int(divider))] = 1.0
    return image


def _render(
    reflectances: Sequence[Reflectance], mesh: Any, lights: Any, env: Any, camera: Camera | None, size: Any,
    samples: int, supersampling: int, shadows: bool, background: Any, seed: int, progress: Report | bool | None,
) -> Image:  # fmt: skip
    width, height = checked_size(size)
    samples = _count("samples", samples, 1, 65536)
    per_side = _count("supersampling", supersampling, 1, 16)
    seed = _count("seed", seed, 0, 2**31 - 1)
    if width * height > WORTH_COMPILING_AHEAD:
        compile_ahead(reflectances)
    scene = assembled(mesh, lights, env, camera, width / height)
    backdrop = backgrounds.check(background, scene.environment)
    surface = surface_of(scene.mesh)
    blocker = surface if shadows else None

    rows, columns = seen_rectangle(scene, width, height)
    per_pixel = per_side**2
    rounds = -(-samples // per_pixel)
    at_once = max(1, RAYS_AT_ONCE // per_pixel // max(1, columns.stop - columns.start))
    bands = [slice(row, min(row + at_once, rows.stop)) for row in range(rows.start, rows.stop, at_once)]
    steps = len(scene.lights) + (rounds if scene.environment else 0)

    radiance = np.zeros((height * width, 3), np.float32)
    coverage = np.zeros(height * width, np.float32)
    with Progress("rendering", max(1, len(bands) * len(reflectances) * steps), progress) as bar:
        for band in bands:
            row, column = np.mgrid[band, columns]
            pixels = (row * width + column).astype(np.int32).ravel()
            met = surface.meet(*backgrounds.rays(scene.camera, pixels, per_side, width, height))
            own_pixels, ranks = pixels[met.rays // per_pixel], (met.rays % per_pixel).astype(np.int32)
            reflected = np.zeros((len(own_pixels), 3), np.float32)
            around = scene.environment and EnvironmentPass(
                scene.environment, own_pixels, ranks, per_pixel, rounds, width, seed
            )
            which = (own_pixels % width) * len(reflectances) // width
            for number, reflectance in enumerate(reflectances):
                part = np.flatnonzero(which == number)
                at: ShadingPoints = met[part] if len(reflectances) > 1 else met
                for light in scene.lights:
                    reflected[part] += from_light(reflectance, at, light, blocker)
                    bar.step()
                if around:
                    reflected[part] += around.reflected(reflectance, at, part, blocker, bar.step)
            means, covered = pixel_means(reflected, own_pixels, height * width, per_pixel)
            radiance += means
            coverage += covered

    behind = backgrounds.painted(backdrop, scene.camera, scene.environment, width, height).reshape(-1, 3)
    composite = (radiance + (1 - coverage[:, None]) * behind).reshape(height, width, 3)
    transparent = isinstance(backdrop, str) and backdrop == "transparent"
    taken = rounds * per_pixel if scene.environment else 0
    notes = {
        "Material": " | ".join(reflectance.name or repr(reflectance) for reflectance in reflectances),
        "Source": " | ".join(reflectance.source for reflectance in reflectances if reflectance.source),
        "Mesh": scene.mesh.name,
        "Light": ", ".join([*map(str, scene.lights), *([scene.environment.name] if scene.environment else [])]),
        "Samples": f"{taken} per pixel, {per_side} x {per_side} rays, seed {seed}",
    }
    return Image(composite, coverage.reshape(height, width) if transparent else None, notes)


def assembled(mesh: Any, lights: Any, env: Any, camera: Camera | None, aspect: float) -> Scene:
    """The scene that the arguments of `render` describe."""
    shape = load_mesh(mesh)
    given: list[Any] = []
    if lights is not None:
        given = [lights] if isinstance(lights, (str, Light)) else list(lights)
    made = tuple(light_texts.parse(light) if isinstance(light, str) else light for light in given)
    for light in made:
        if not isinstance(light, Light):
            raise SceneError(f"a light must be a Directional, a Point or text, got {light!r}")
    around = None
    if env is not None or lights is None:
        around = environments.load("studio" if env is None else env)
    return Scene(shape, camera or Camera.framing(shape, aspect=aspect), made, around)


def seen_rectangle(scene: Scene, width: int, height: int) -> tuple[slice, slice]:
    """Rows and columns of the picture outside of which nothing of the mesh is seen."""
    corners = scene.camera.project(scene.mesh.vertices, width, height)
    if not np.isfinite(corners).all():
        return slice(0, height), slice(0, width)
    # The exact sphere bulges beyond its triangles by up to 0.06 % of its size, a pixel or two.
    margin = 2 + (0.002 * max(width, height) if scene.mesh.is_unit_sphere else 0)
    least = np.clip(np.floor(corners.min(0) - margin), 0, (width, height)).astype(int)
    most = np.clip(np.ceil(corners.max(0) + margin), 0, (width, height)).astype(int)
    return slice(int(least[1]), int(most[1])), slice(int(least[0]), int(most[0]))


def checked_size(size: Any) -> tuple[int, int]:
    """(width, height). Raises SceneError for what is no size of a picture."""
    try:
        width, height = (int(side) for side in size)
    except (TypeError, ValueError):
        raise SceneError(f"size must be (width, height) in pixels, got {size!r}") from None
    if not (0 < width <= LARGEST_SIDE and 0 < height <= LARGEST_SIDE):
        raise SceneError(f"size must lie between 1 x 1 and {LARGEST_SIDE} x {LARGEST_SIDE}, got {width} x {height}")
    return width, height


def _count(name: str, value: Any, low: int, high: int) -> int:
    if not isinstance(value, (int, np.integer)) or isinstance(value, bool) or not low <= value <= high:
        raise ParameterError(f"{name} must be a whole number in [{low}, {high}], got {value!r}")
    return int(value)
