"""Shading maps with r at the vertices: as at every pixel on a fine mesh, without highlights on a coarse one."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

import brdf
from brdf.errors import ReflectanceError, SceneError
from brdf.models import GGX, Lambertian
from brdf.render import Mesh, render_per_vertex
from brdf.render import mesh as meshes
from mesostructures import ACQUIRED, photographs

GLOSSY = GGX(alpha=0.12, F0=0.5) + Lambertian(albedo=0.2)
MAP = brdf.ShadingMap.from_images(photographs("plastic", 64), ACQUIRED, GLOSSY)
LIGHT = "directional:theta=45,phi=30,power=2"
VIEW = {"size": (80, 60), "background": (0, 0, 0)}


def ball(steps: int) -> Mesh:
    """The unit sphere as a grid of 2 · steps by steps cells."""
    u, v = np.meshgrid(np.arange(2 * steps + 1) / (2 * steps), np.arange(steps + 1) / steps, indexing="ij")
    theta, phi = np.pi * (1 - v), 2 * np.pi * u
    points = np.stack([np.sin(theta) * np.sin(phi), np.cos(theta), np.sin(theta) * np.cos(phi)], -1).reshape(-1, 3)
    index = np.arange(len(points)).reshape(u.shape)
    a, b, c, d = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    faces = np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])
    points, uvs = points.astype("f4"), np.stack([u, v], -1).reshape(-1, 2).astype("f4")
    return Mesh(f"ball of {steps}", points, faces.astype("i4"), points[faces], uvs[faces])


@pytest.mark.parametrize("light", [LIGHT, "point:1.5/2/2"])
def test_on_a_fine_mesh_vertices_are_enough(light: str) -> None:
    per_pixel = brdf.render(MAP, ball(160), light, **VIEW).pixels
    per_vertex = render_per_vertex(MAP, ball(160), light, **VIEW).pixels
    assert per_pixel.max() > 0.3
    assert np.sqrt(np.mean((per_vertex - per_pixel) ** 2)) < 0.01 * per_pixel.max()


def test_a_coarse_mesh_misses_highlights() -> None:
    per_pixel = brdf.render(MAP, ball(8), LIGHT, **VIEW).pixels
    per_vertex = render_per_vertex(MAP, ball(8), LIGHT, **VIEW).pixels
    assert per_vertex.max() < 0.7 * per_pixel.max()


def test_the_plane_seen_from_far_is_the_same_at_any_vertex() -> None:
    view = {**VIEW, "camera": brdf.render.Camera(position=(0, 4, 0.01), target=(0, 0, 0), height=2.5)}
    per_pixel = brdf.render(MAP, "plane", LIGHT, **view).pixels
    np.testing.assert_allclose(render_per_vertex(MAP, "plane", LIGHT, **view).pixels, per_pixel, rtol=2e-3, atol=1e-5)


def test_what_is_refused() -> None:
    with pytest.raises(ReflectanceError, match="needs an isotropic BRDF"):
        render_per_vertex(MAP.replaced(brdf=GGX(alpha_x=0.1, alpha_y=0.3)), "sphere", LIGHT)
    bare = dataclasses.replace(meshes.load("plane"), uvs=None)
    with pytest.raises(SceneError, match="no texture coordinates"):
        render_per_vertex(MAP, bare, LIGHT)
