"""Draws a task: one pass for every ray of a pixel, summed in the card's memory."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ...errors import ReflectanceError, SceneError
from ...shaders import Shader, shader_of, stages
from ..background import offsets
from ..progress import Progress, Report
from ..stand_in import stand_in
from ..task import Task, seen_rectangle
from .card import Card, Program, card
from .uniforms import MOST_LIGHTS, SceneOnCard, set_material

Floats = NDArray[np.float32]

MOST_AT_ONCE = 16
"""Directions to the environment that one pass seeks: so that no pass takes a driver longer than it allows."""

FUNCTION = "brdf_material"


@dataclass(frozen=True)
class Stages:
    """Shaders that shade a shape, and the materials whose numbers they read."""

    vertex: str
    fragment: str
    materials: tuple[Shader, ...]
    once_a_pixel: bool = True
    """Whether they take 3 vertices in all, rather than 3 a face."""


def draw(task: Task, progress: Report | bool | None = None) -> tuple[Floats, Floats]:
    """Radiance that the shape reflects to each pixel (H W, 3), and how much of the pixel it covers (H W,).

    Raises DriverError, ReflectanceError for what has no shader or mirrors, SceneError for more than 8 lights.
    """
    return drawn(task, stages_of(task), progress)


def drawn(task: Task, shading: Sequence[Stages], progress: Report | bool | None) -> tuple[Floats, Floats]:
    """The same with the stages of each material. Raises DriverError, SceneError."""
    with card() as opened:
        renderer = Renderer(opened, task, shading)
        with Progress("rendering", renderer.steps, progress) as bar:
            for place in offsets(task.per_side):
                for _ in renderer.draw_sample(place):
                    opened.finish()
                    bar.step()
        return renderer.read()


def stages_of(task: Task) -> list[Stages]:
    """The stages of each material. Raises ReflectanceError, SceneError for what cannot be drawn with them."""
    if len(task.scene.lights) > MOST_LIGHTS:
        raise SceneError(f"the backend 'gl' draws up to {MOST_LIGHTS} lights, got {len(task.scene.lights)}; use 'cpu'")
    for m in task.reflectances:
        if m.has_delta:
            raise ReflectanceError(
                f"{m.name or type(m).__name__} mirrors, which has no values to draw; use the backend 'cpu'"
            )
    shaders = [shader_of(m, function=FUNCTION) for m in task.reflectances]
    shape = "sphere" if task.scene.mesh.is_unit_sphere else "seen"
    return [Stages(*stages.shading(shader, shape), (shader,)) for shader in shaders]


class Renderer:
    """A task in the card's memory. `draw_sample` adds a ray to each pixel, `read` gives their mean.

    `filtered`: linear lookups are the driver's, faster and on most cards coarser, instead of the shader's own.
    """

    def __init__(self, opened: Card, task: Task, shading: Sequence[Stages], filtered: bool = False) -> None:
        self._card, self._task = opened, task
        mesh = task.scene.mesh
        self._mesh_vertices = 0 if mesh.is_unit_sphere else 3 * len(mesh.faces)
        self._vertices = 3 if all(stage.once_a_pixel for stage in shading) else self._mesh_vertices
        self._passes = _passes(task.rounds)
        self._sums = 0
        self._sample = opened.target(task.width, task.height, depth=self._vertices > 3)
        self._sum = opened.target(task.width, task.height, depth=False)
        scene = SceneOnCard(opened, task, self._passes)
        self._materials = []
        defined = stages.HARDWARE_FILTER * filtered + stages.LIGHTS_ALONE * (task.scene.environment is None)
        for stage, m in zip(shading, task.reflectances, strict=True):
            program = scene.apply(opened.program(stage.vertex, defined + stage.fragment))
            for shader in stage.materials:
                set_material(opened, program, shader, filtered)
            program["environment_samples"] = task.rounds // self._passes
            if task.scene.environment is not None:
                program["lobe_alpha"], program["lobe_share"] = stand_in(m)
            self._materials.append(program)
        self._first, self._seen = self._first_pass(scene), self._sample
        if self._mesh_vertices and self._vertices == 3:
            self._seen = opened.target(task.width, task.height, depth=True, channels=1)
            for program in self._materials:
                program.bind("seen_faces", self._seen.texture)
        self._add = opened.program(stages.vertex("screen"), stages.sum_of_samples())
        self._add.bind("drawn", self._sample.texture)
        self._parts = _parts(task)

    @property
    def steps(self) -> int:
        """Passes in all."""
        return self._task.per_pixel * self._passes

    def _first_pass(self, scene: SceneOnCard) -> Program | None:
        """What draws the triangles before anything is shaded: so nothing hidden is."""
        if not self._mesh_vertices:
            return None
        fragment = stages.faces() if self._vertices == 3 else stages.depth()
        return scene.apply(self._card.program(stages.vertex("mesh"), fragment))

    def draw_sample(self, place: Sequence[float] | Floats) -> Iterator[int]:
        """Draw one ray a pixel, through a `place` in it, pass by pass."""
        for program in [*self._materials, *([self._first] if self._first else [])]:
            program["sample_place"] = place
        self._sample.framebuffer.use()
        self._sample.framebuffer.clear()
        self._draw_triangles()
        for number in range(self._passes):
            for program in self._materials:
                program["environment_pass"] = self._sums
                # Lights shine in the first of a ray's passes alone, the mean of which is taken with the others.
                program["light_count"] = len(self._task.scene.lights) if number == 0 else 0
            self._draw_pass()
            yield self._sums

    def _draw_triangles(self) -> None:
        """Leave their depth and, where shading is once a pixel, the number of the nearest."""
        gl, framebuffer = self._card.context, self._seen.framebuffer
        gl.depth_func = "<="
        if self._first:
            gl.enable_only(gl.DEPTH_TEST)
            framebuffer.use()
            if self._vertices == 3:
                framebuffer.clear()
            else:
                framebuffer.color_mask = (False,) * 4
            self._first.draw(self._mesh_vertices)
            framebuffer.color_mask = (True,) * 4

    def _draw_pass(self) -> None:
        gl, framebuffer = self._card.context, self._sample.framebuffer
        framebuffer.use()
        gl.enable_only(gl.DEPTH_TEST if self._vertices > 3 else gl.NOTHING)
        for program, part in zip(self._materials, self._parts, strict=True):
            framebuffer.scissor = part
            if part[2] > 0 and part[3] > 0:
                program.draw(self._vertices)
        framebuffer.scissor = None
        self._sum.framebuffer.use()
        if not self._sums:
            self._sum.framebuffer.clear()
        gl.enable_only(gl.BLEND)
        gl.blend_func = gl.ONE, gl.ONE
        self._add.draw(3)
        self._sums += 1

    def read(self) -> tuple[Floats, Floats]:
        """Mean radiance (H W, 3) and coverage (H W,)."""
        mean = self._sum.read().reshape(-1, 4) / np.float32(max(1, self._sums))
        return np.ascontiguousarray(mean[:, :3]), np.ascontiguousarray(mean[:, 3])


def _passes(rounds: int) -> int:
    """Passes of equal size, none larger than MOST_AT_ONCE."""
    return next(n for n in range(1, max(1, rounds) + 1) if rounds % n == 0 and rounds // n <= MOST_AT_ONCE)


def _parts(task: Task) -> list[tuple[int, int, int, int]]:
    """The rectangle (left, bottom, width, height) of each material, in the driver's pixels, which count upwards."""
    rows, columns = seen_rectangle(task.scene, task.width, task.height)
    which = task.which(np.arange(task.width))
    edges = np.searchsorted(which, np.arange(len(task.reflectances) + 1)).tolist()
    parts = []
    for start, stop in pairwise(edges):
        left, right = max(start, columns.start), min(stop, columns.stop)
        parts.append((left, task.height - rows.stop, max(0, right - left), rows.stop - rows.start))
    return parts
