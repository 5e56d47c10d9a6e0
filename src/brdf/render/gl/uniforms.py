"""A scene as the uniforms and textures of the shader stages."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...shaders import Shader
from ..environment_texels import map_texels, places
from ..lights import Light, Point
from ..scene import Camera
from ..task import Task
from ..tree import texels
from .card import Card, Program

Floats = NDArray[np.float32]

MOST_LIGHTS = 8
"""As many as the shader has room for."""


class SceneOnCard:
    """A task's scene in the card's memory: `apply` has a program draw it."""

    def __init__(self, opened: Card, task: Task, light_scale: float = 1) -> None:
        """`light_scale`: factor on all lights. Raises SceneError."""
        mesh, environment = task.scene.mesh, task.scene.environment
        self._uniforms: dict[str, Any] = _camera(task) | _lights(task.scene.lights, light_scale)
        self._textures: dict[str, Any] = {}
        if not mesh.is_unit_sphere:
            lists = texels(mesh, task.shadows)
            self._textures |= {"mesh_faces": opened.texel_list(lists.faces)}
            self._textures |= {"mesh_nodes": opened.texel_list(lists.nodes)}
            self._uniforms |= {"mesh_has_uv": mesh.uvs is not None, "mesh_nudge": mesh.nudge}
            self._uniforms |= {"mesh_node_count": len(lists.nodes) // 2}
        if environment is not None:
            self._textures |= {"environment_map": opened.texture(map_texels(environment))}
            self._textures |= {"environment_directions": opened.texture(places(environment))}
            self._uniforms |= {"environment_turn": environment.turn, "environment_scale": 1.0}
        self._uniforms |= {"environment_total": task.rounds * task.per_pixel, "environment_seed": task.seed}

    def apply(self, program: Program) -> Program:
        """The same program, with the scene's uniforms set and its textures bound."""
        for name, value in self._uniforms.items():
            program[name] = value
        for name, texture in self._textures.items():
            program.bind(name, texture)
        return program


def set_material(opened: Card, program: Program, shader: Shader, filtered: bool = False) -> None:
    """Set a material's own numbers and textures; `filtered`: the driver filters them."""
    for parameter in shader.description["parameters"]:
        program[parameter["uniform"]] = np.asarray(parameter["value"], np.float64)
    for texture in shader.description["textures"]:
        program.bind(texture["uniform"], opened.described(texture, shader.texels, filtered))


def _camera(task: Task) -> dict[str, Any]:
    camera = task.scene.camera
    half = np.tan(np.radians(camera.fov / 2)) if camera.height is None else camera.height / 2
    return {
        "camera_position": camera.position,
        "camera_frame": camera.frame,
        "camera_parallel": camera.height is not None,
        "camera_half": float(half),
        "camera_depths": _depths(camera, task.scene.mesh.vertices),
        "picture_size": (float(task.width), float(task.height)),
    }


def _depths(camera: Camera, vertices: Floats) -> tuple[float, float]:
    """Nearest and farthest distance along the view; a pinhole camera sees nothing nearer than 1e-4 of the farthest."""
    depth = -((vertices - camera.position) @ camera.frame[2])
    near, far = float(depth.min()), float(depth.max())
    margin = 1e-3 * max(far - near, abs(far))
    near, far = near - margin, far + margin
    return (near, far) if camera.height is not None else (max(near, 1e-4 * far), far)


def _lights(lights: Sequence[Light], scale: float) -> dict[str, Any]:
    place, irradiance = np.zeros((MOST_LIGHTS, 4)), np.zeros((MOST_LIGHTS, 3))
    for n, light in enumerate(lights):
        place[n] = (*light.position, 1) if isinstance(light, Point) else (*light.toward, 0)
        irradiance[n] = np.pi * scale * light.power
    return {"light_place": place, "light_irradiance": irradiance, "light_count": len(lights)}
