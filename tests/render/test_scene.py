"""Cameras."""

from __future__ import annotations

import numpy as np
import pytest

from brdf.errors import SceneError
from brdf.render import Camera
from brdf.render.background import rays
from brdf.render.mesh import load
from brdf.render.visibility import surface_of


@pytest.mark.parametrize("orthographic", [False, True])
@pytest.mark.parametrize("mesh", ["teapot", "sphere", "plane"])
@pytest.mark.parametrize("aspect", [4 / 3, 0.5])
def test_framing_shows_all_of_it_centred(mesh, aspect, orthographic):
    shape = load(mesh)
    camera = Camera.framing(shape, aspect=aspect, orthographic=orthographic, margin=1.1)
    width, height = round(600 * aspect), 600
    seen = camera.project(shape.vertices, width, height)
    least, most = seen.min(0), seen.max(0)
    np.testing.assert_allclose((least + most) / 2, (width / 2, height / 2), atol=3)
    assert ((most - least) / (width, height)).max() == pytest.approx(1 / 1.1, abs=0.02)


@pytest.mark.parametrize("height", [None, 3.0])
def test_rays_go_through_the_pixels_that_project_says(height):
    camera = Camera((1, 2, 5), (0.1, 0, 0), fov=35, height=height)
    pixels = np.array([0, 57, 1234, 40 * 30 - 1], np.int32)
    origins, directions = rays(camera, pixels, 1, 40, 30)
    np.testing.assert_allclose(np.linalg.norm(directions, axis=-1), 1, atol=1e-6)
    back = camera.project(origins + 3 * directions, 40, 30)
    np.testing.assert_allclose(back, np.stack([pixels % 40, pixels // 40], -1) + 0.5, atol=1e-3)


def test_frames_are_right_handed_and_texture_runs_along_the_tangent():
    for mesh in ("teapot", "sphere", "plane"):
        shape = load(mesh)
        camera = Camera.framing(shape, theta=50)
        origins, directions = rays(camera, np.arange(64 * 48, dtype=np.int32), 1, 64, 48)
        met = surface_of(shape).meet(origins, directions)
        assert len(met.rays) > 300
        np.testing.assert_allclose(
            met.frames @ met.frames.transpose(0, 2, 1), np.broadcast_to(np.eye(3), met.frames.shape), atol=1e-5
        )
        np.testing.assert_allclose(np.linalg.det(met.frames), 1, atol=1e-5)
        np.testing.assert_allclose(np.einsum("nij,nj->ni", met.frames, -directions[met.rays]), met.views, atol=1e-4)
    np.testing.assert_allclose(met.frames[0], [(1, 0, 0), (0, 0, -1), (0, 1, 0)], atol=1e-6)
    np.testing.assert_allclose(met.uvs[:, 0], met.points[:, 0] / 2 + 0.5, atol=1e-3)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"position": (0, 0, 0)}, "must not stand at its target"),
        ({"position": (0, 5, 0)}, "along its up direction"),
        ({"position": (0, 0, 5), "fov": 180}, "fov"),
        ({"position": (0, 0, 5), "height": -1.0}, "height"),
        ({"position": (0, 5)}, "three finite numbers"),
    ],
)
def test_impossible_cameras(options, words):
    with pytest.raises(SceneError, match=words):
        Camera(**options)
