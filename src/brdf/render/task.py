"""What is to be drawn, checked and complete, and what every renderer does alike with what it has drawn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError, SceneError
from ..reflectance import Reflectance
from . import background as backgrounds
from . import environment as environments
from . import lights as light_texts
from .image import Image
from .lights import Light
from .mesh import load as load_mesh
from .scene import Camera, Scene

Floats = NDArray[np.float32]

LARGEST_SIDE = 8192


@dataclass(frozen=True)
class Task:
    """A picture to draw. More reflectances than one stand side by side, each in its part of the picture's width."""

    reflectances: Sequence[Reflectance]
    scene: Scene
    backdrop: str | Floats
    width: int
    height: int
    samples: int
    """Least directions to the environment per pixel, of each of the two kinds."""
    per_side: int
    """Rays per pixel along each side."""
    shadows: bool
    seed: int

    @property
    def per_pixel(self) -> int:
        """Rays per pixel."""
        return self.per_side**2

    @property
    def rounds(self) -> int:
        """Directions to the environment per ray, of each of the two kinds."""
        return -(-self.samples // self.per_pixel) if self.scene.environment else 0

    def which(self, columns: NDArray[Any]) -> NDArray[Any]:
        """The number of the reflectance that stands in these columns of the picture."""
        return columns * len(self.reflectances) // self.width


def checked(
    reflectances: Sequence[Reflectance], mesh: Any, lights: Any, env: Any, camera: Camera | None, size: Any,
    samples: Any, supersampling: Any, shadows: bool, background: Any, seed: Any,
) -> Task:  # fmt: skip
    """The task that the arguments of `render` describe. Raises as `render` does."""
    width, height = checked_size(size)
    samples = _count("samples", samples, 1, 65536)
    per_side = _count("supersampling", supersampling, 1, 16)
    seed = _count("seed", seed, 0, 2**31 - 1)
    scene = assembled(mesh, lights, env, camera, width / height)
    backdrop = backgrounds.check(background, scene.environment)
    return Task(reflectances, scene, backdrop, width, height, samples, per_side, shadows, seed)


def finished(task: Task, radiance: Floats, coverage: Floats) -> Image:
    """The picture of the reflected `radiance` (H W, 3), which is 0 off the shape, and the shape's `coverage` (H W,)."""
    scene, width, height = task.scene, task.width, task.height
    behind = backgrounds.painted(task.backdrop, scene.camera, scene.environment, width, height).reshape(-1, 3)
    composite = (radiance + (1 - coverage[:, None]) * behind).reshape(height, width, 3)
    transparent = isinstance(task.backdrop, str) and task.backdrop == "transparent"
    notes = {
        "Material": " | ".join(m.name or repr(m) for m in task.reflectances),
        "Source": " | ".join(m.source for m in task.reflectances if m.source),
        "Mesh": scene.mesh.name,
        "Light": ", ".join([*map(str, scene.lights), *([scene.environment.name] if scene.environment else [])]),
        "Samples": f"{task.rounds * task.per_pixel} per pixel, {task.per_side} x {task.per_side} rays, "
        f"seed {task.seed}",
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
