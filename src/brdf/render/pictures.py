"""Pictures by whichever renderer: what users call."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import Any

from numpy.typing import ArrayLike

from ..reflectance import Reflectance
from . import cpu, task
from .backends import chosen
from .environment import Environment
from .image import Image
from .lights import Light
from .mesh import Mesh
from .progress import Report
from .scene import Camera


def _on_card(what: task.Task, progress: Report | bool | None) -> tuple[task.Floats, task.Floats]:
    from . import gl

    return gl.draw(what, progress)


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
    backend: str = "cpu",
) -> Image:
    """A picture of a shape made of `reflectance`, lit directly (no light bounces twice).

    `mesh`: "teapot", "sphere", "plane", or a mesh file. `lights`: lights, or text such as
    "directional:theta=30,phi=45,power=3" and "point:1/2/3". `env`: "studio", an .hdr or .exr file, or a number (the
    same radiance everywhere). With neither, the studio. `camera`: by default one that frames the mesh. `size`: width
    and height in pixels. `samples`: directions to the environment per pixel, of each of the two kinds;
    `supersampling`² rays per pixel. `shadows`: whether the shape shadows itself. `background`: "gradient",
    "environment" (out of focus), "transparent" or an RGB colour. The same `seed` gives the same picture. `progress`: a
    function of the share done, True for a bar, False for none; by default a bar in a terminal when it takes longer
    than a second. `backend`: "cpu" runs anywhere; "gl" draws on a graphics card or OpenGL's software driver, and
    without one warns and leaves it to "cpu". The two agree.
    Raises SceneError, ParameterError, UnknownNameError, FileError; for "gl" ReflectanceError where there is no shader.
    """
    return _drawn(
        backend, progress, [reflectance], mesh, lights, env, camera, size, samples, supersampling, shadows, background,
        seed,
    )  # fmt: skip


def render_halves(
    left: Reflectance, right: Reflectance, *, divider: float = 1.0, mesh: str | os.PathLike[str] | Mesh = "teapot",
    lights: Iterable[Light | str] | Light | str | None = None,
    env: str | os.PathLike[str] | float | Environment | None = None, camera: Camera | None = None,
    size: tuple[int, int] = (800, 600), samples: int = 16, supersampling: int = 2, shadows: bool = True,
    background: str | ArrayLike = "gradient", seed: int = 0, progress: Report | bool | None = None,
    backend: str = "cpu",
) -> Image:  # fmt: skip
    """One picture whose left half is made of `left` and whose right half of `right`; for the rest as `render`.

    `divider`: width in pixels of the light line between them, 0 for none.
    """
    image = _drawn(
        backend, progress, [left, right], mesh, lights, env, camera, size, samples, supersampling, shadows, background,
        seed,
    )  # fmt: skip
    if divider > 0:
        start = size[0] // 2 - int(divider) // 2
        image.pixels[:, start : start + max(1, int(divider))] = 1.0
        if image.alpha is not None:
            image.alpha[:, start : start + max(1, int(divider))] = 1.0
    return image


def _drawn(backend: str, progress: Report | bool | None, *scene: Any) -> Image:
    draw = chosen(backend, cpu.draw, _on_card)
    if backend == "cpu":
        cpu.prepare(*scene)
    what = task.checked(*scene)
    return task.finished(what, *draw(what, progress))
