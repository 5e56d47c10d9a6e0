"""Shading maps as hardware without programmable pixels drew them: r at the vertices, interpolated over each face."""

from __future__ import annotations

import dataclasses
import os
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..color import luminance
from ..errors import ReflectanceError, SceneError
from ..geometry.directions import frame, normalized
from ..representations.shading.shading_map import ShadingMap
from . import background as backgrounds
from .backends import chosen
from .image import Image
from .lights import Light
from .mesh import Mesh, load
from .progress import Report
from .scene import Camera, Scene
from .shading import pixel_means
from .task import Task, checked, finished
from .visibility import Triangles

Floats = NDArray[np.float32]

LEAST_COSINE = 0.01
"""Of the viewing direction at a vertex: on outlines some vertices of a visible face are turned away."""


def render_per_vertex(
    shading_map: ShadingMap, mesh: str | os.PathLike[str] | Mesh, light: Light | str, camera: Camera | None = None,
    size: tuple[int, int] = (800, 600), supersampling: int = 2, shadows: bool = True,
    background: str | ArrayLike = "gradient", backend: str = "cpu",
) -> Image:  # fmt: skip
    """A picture under one light with the BRDF evaluated at vertices alone: coarse meshes lose highlights.

    For the rest as `render`, which evaluates it at every sample of every pixel. Reference: Kautz2004, section 4.1.
    Raises ReflectanceError for an anisotropic BRDF, SceneError, ParameterError, UnknownNameError, FileError.
    """
    if not shading_map.isotropic:
        raise ReflectanceError("r at vertices needs an isotropic BRDF: a vertex has no tangent of its own")
    solid = dataclasses.replace(load(mesh), is_unit_sphere=False)
    if solid.uvs is None:
        raise SceneError(f"the mesh {solid.name} has no texture coordinates to lay pictures on")
    task = checked([shading_map], solid, light, None, camera, size, 1, supersampling, shadows, background, 0)
    return finished(task, *chosen(backend, _draw, _draw_on_card)(task, None))


def _draw_on_card(task: Task, progress: Report | bool | None) -> tuple[Floats, Floats]:
    from .gl import draw_per_vertex

    return draw_per_vertex(task, progress)


def _draw(task: Task, progress: Report | bool | None) -> tuple[Floats, Floats]:
    """Radiance that the shape reflects to each pixel (H W, 3), and how much of the pixel it covers (H W,)."""
    (shading_map,), scene, count = task.reflectances, task.scene, task.width * task.height
    assert isinstance(shading_map, ShadingMap)
    surface = Triangles(scene.mesh)
    at_corners = _at_corners(shading_map, scene.mesh, scene)

    pixels = np.arange(count, dtype=np.int32)
    origins, directions = backgrounds.rays(scene.camera, pixels, task.per_side, task.width, task.height)
    face, weights = surface.faces(origins, directions)
    at = surface.meet(origins, directions)
    face, second, third = face[at.rays], *weights[:, at.rays]
    shares = np.stack([1 - second - third, second, third], -1)
    r = np.einsum("nk,nk->n", shares, at_corners[face])

    world, distances, irradiance = scene.lights[0].seen_from(at.points)
    reflected = shading_map.lookup(r, at.uvs) * irradiance
    if task.shadows:
        reflected[surface.blocks(at.points, world, distances)] = 0
    return pixel_means(reflected.astype(np.float32), pixels[at.rays // task.per_pixel], count, task.per_pixel)


def _at_corners(shading_map: ShadingMap, mesh: Mesh, scene: Scene) -> NDArray[np.float64]:
    """r = sigma f cos at the corners of the faces, (F, 3); 0 where the light is below the horizon."""
    points = mesh.vertices[mesh.faces].reshape(-1, 3)
    normals = mesh.normals.reshape(-1, 3).astype(np.float64)
    to_viewer = scene.camera.frame[2] if scene.camera.height is not None else scene.camera.position - points
    views = np.broadcast_to(to_viewer, points.shape).astype(np.float64)
    world, _, _ = scene.lights[0].seen_from(points)
    wi, wo = (_local(normalized(w), normals) for w in (world.astype(np.float64), views))
    wo[:, 2] = np.maximum(wo[:, 2], LEAST_COSINE)
    reflected = luminance(shading_map.children["brdf"].f_cos(wi, normalized(wo)))
    return np.asarray(shading_map.sigma * reflected).reshape(-1, 3)


def _local(world: NDArray[np.floating[Any]], normals: NDArray[np.float64]) -> NDArray[np.float64]:
    """Directions (N, 3) in frames about the normals, whose tangents do not matter."""
    axes = np.stack([*frame(normals), normals], 1)
    return np.asarray(np.einsum("nij,nj->ni", axes, world))
