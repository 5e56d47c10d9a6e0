"""Draws a task: one pass for every ray of a pixel, summed in the card's memory."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ...errors import ReflectanceError, SceneError
from ...reflectance import Reflectance
from ...shaders import Shader, shader_of, stages
from ..background import offsets
from ..environment_texels import map_texels, places
from ..lights import Light, Point
from ..progress import Progress, Report
from ..scene import Camera
from ..stand_in import stand_in
from ..task import Task, seen_rectangle
from ..tree import texels
from .card import Card, Program, card

Floats = NDArray[np.float32]

MOST_LIGHTS = 8
"""As many as the shader has room for."""

MOST_AT_ONCE = 16
"""Directions to the environment that one pass seeks: so that no pass takes a driver longer than it allows."""

FUNCTION = "brdf_material"

SCENE_TEXTURES = ("mesh_faces", "mesh_nodes", "environment_map", "environment_directions")


def draw(task: Task, progress: Report | bool | None = None) -> tuple[Floats, Floats]:
    """Radiance that the shape reflects to each pixel (H W, 3), and how much of the pixel it covers (H W,).

    Raises DriverError, ReflectanceError for what has no shader or mirrors, SceneError for more than 8 lights.
    """
    shaders = shaders_of(task)
    with card() as opened:
        renderer = Renderer(opened, task, shaders)
        with Progress("rendering", renderer.steps, progress) as bar:
            for place in offsets(task.per_side):
                for _ in renderer.draw_sample(place):
                    bar.step()
        return renderer.read()


def shaders_of(task: Task) -> list[Shader]:
    """The materials' shaders. Raises ReflectanceError, SceneError for what cannot be drawn with them."""
    if len(task.scene.lights) > MOST_LIGHTS:
        raise SceneError(f"the backend 'gl' draws up to {MOST_LIGHTS} lights, got {len(task.scene.lights)}; use 'cpu'")
    for m in task.reflectances:
        if m.has_delta:
            raise ReflectanceError(
                f"{m.name or type(m).__name__} mirrors, which has no values to draw; use the backend 'cpu'"
            )
    return [shader_of(m, function=FUNCTION) for m in task.reflectances]


class Renderer:
    """A task in the card's memory. `draw_sample` adds a ray to each pixel, `read` gives their mean."""

    def __init__(self, opened: Card, task: Task, shaders: Sequence[Shader]) -> None:
        self._card, self._task = opened, task
        shape = "sphere" if task.scene.mesh.is_unit_sphere else "mesh"
        self._vertices = 3 if shape == "sphere" else 3 * len(task.scene.mesh.faces)
        self._passes = _passes(task.rounds)
        self._sums = 0
        self._sample = opened.target(task.width, task.height, depth=True)
        self._sum = opened.target(task.width, task.height, depth=False)
        self._sum.framebuffer.clear()
        self._lists = self._made_lists(shape)
        self._materials = [
            self._with_scene(_material(opened, shader, shape), shape, m)
            for shader, m in zip(shaders, task.reflectances, strict=True)
        ]
        self._depth = opened.program(stages.vertex("mesh"), stages.depth()) if shape == "mesh" else None
        if self._depth:
            self._with_scene(self._depth, shape)
        self._add = opened.program(stages.vertex("screen"), stages.sum_of_samples())
        self._add.bind(0, "drawn", self._sample.texture)
        self._parts = _parts(task)

    @property
    def steps(self) -> int:
        """Passes in all."""
        return self._task.per_pixel * self._passes

    def draw_sample(self, place: Sequence[float] | Floats) -> Iterator[int]:
        """Draw one ray a pixel, through a `place` in it, pass by pass."""
        gl = self._card.context
        for program in [*self._materials, *([self._depth] if self._depth else [])]:
            program["sample_place"] = place
        for number in range(self._passes):
            self._sample.framebuffer.use()
            self._sample.framebuffer.clear()
            if self._depth:
                gl.enable_only(gl.DEPTH_TEST)
                gl.depth_func = "<="
                self._sample.framebuffer.color_mask = (False,) * 4
                self._depth.draw(self._vertices)
                self._sample.framebuffer.color_mask = (True,) * 4
            else:
                gl.enable_only(gl.NOTHING)
            for program, part in zip(self._materials, self._parts, strict=True):
                program["environment_pass"] = self._sums
                # Lights shine in the first of a ray's passes, for all of them.
                program["light_count"] = len(self._task.scene.lights) if number == 0 else 0
                self._sample.framebuffer.scissor = part
                if part[2] > 0 and part[3] > 0:
                    program.draw(self._vertices)
            self._sample.framebuffer.scissor = None
            self._sum.framebuffer.use()
            gl.enable_only(gl.BLEND)
            gl.blend_func = gl.ONE, gl.ONE
            self._add.draw(3)
            self._sums += 1
            gl.finish()
            yield self._sums

    def read(self) -> tuple[Floats, Floats]:
        """Mean radiance (H W, 3) and coverage (H W,)."""
        mean = self._sum.read().reshape(-1, 4) / np.float32(max(1, self._sums))
        return np.ascontiguousarray(mean[:, :3]), np.ascontiguousarray(mean[:, 3])

    def _made_lists(self, shape: str) -> dict[str, object]:
        lists: dict[str, object] = {}
        environment = self._task.scene.environment
        if shape == "mesh":
            mesh = texels(self._task.scene.mesh, self._task.shadows)
            lists["mesh_faces"] = self._card.texel_list(mesh.faces)
            lists["mesh_nodes"] = self._card.texel_list(mesh.nodes)
            self._mesh = mesh
        if environment is not None:
            lists["environment_map"] = self._card.texture(map_texels(environment))
            lists["environment_directions"] = self._card.texture(places(environment))
        return lists

    def _with_scene(self, program: Program, shape: str, m: Reflectance | None = None) -> Program:
        """The program with the scene's uniforms and textures set."""
        task = self._task
        for unit, name in enumerate(SCENE_TEXTURES):
            if name in self._lists:
                program.bind(unit, name, self._lists[name])
        _set_camera(program, task)
        if shape == "mesh":
            program["mesh_has_uv"], program["mesh_nudge"] = self._mesh.has_uv, self._mesh.nudge
            program["mesh_node_count"] = len(self._mesh.nodes) // 2
        _set_lights(program, task.scene.lights, self._passes)
        environment = task.scene.environment
        program["environment_samples"] = task.rounds // self._passes
        program["environment_total"], program["environment_seed"] = task.rounds * task.per_pixel, task.seed
        if environment is not None and m is not None:
            program["environment_turn"], program["environment_scale"] = environment.turn, 1.0
            program["lobe_alpha"], program["lobe_share"] = stand_in(m)
        return program


def _passes(rounds: int) -> int:
    """Passes of equal size, none larger than MOST_AT_ONCE."""
    return next(n for n in range(1, max(1, rounds) + 1) if rounds % n == 0 and rounds // n <= MOST_AT_ONCE)


def _material(opened: Card, shader: Shader, shape: str) -> Program:
    """The program that shades a shape, with the material's own numbers and textures set."""
    program = opened.program(*stages.shading(shader, shape))
    for parameter in shader.description["parameters"]:
        program[parameter["uniform"]] = np.asarray(parameter["value"], np.float64)
    for unit, texture in enumerate(shader.description["textures"], len(SCENE_TEXTURES)):
        program.bind(unit, texture["uniform"], opened.described(texture, shader.texels))
    return program


def _set_camera(program: Program, task: Task) -> None:
    camera = task.scene.camera
    program["camera_position"], program["camera_frame"] = camera.position, camera.frame
    program["camera_parallel"] = camera.height is not None
    half = np.tan(np.radians(camera.fov / 2)) if camera.height is None else camera.height / 2
    program["camera_half"] = float(half)
    program["camera_depths"] = _depths(camera, task.scene.mesh.vertices)
    program["picture_size"] = (float(task.width), float(task.height))


def _depths(camera: Camera, vertices: Floats) -> tuple[float, float]:
    """Nearest and farthest distance along the view; a pinhole camera sees nothing nearer than 1e-4 of the farthest."""
    depth = -((vertices - camera.position) @ camera.frame[2])
    near, far = float(depth.min()), float(depth.max())
    margin = 1e-3 * max(far - near, abs(far))
    near, far = near - margin, far + margin
    return (near, far) if camera.height is not None else (max(near, 1e-4 * far), far)


def _set_lights(program: Program, lights: Sequence[Light], passes: int) -> None:
    place, irradiance = np.zeros((MOST_LIGHTS, 4)), np.zeros((MOST_LIGHTS, 3))
    for n, light in enumerate(lights):
        is_point = isinstance(light, Point)
        place[n] = *(light.position if isinstance(light, Point) else light.toward), float(is_point)
        irradiance[n] = np.pi * passes * light.power
    program["light_place"], program["light_irradiance"] = place, irradiance


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
