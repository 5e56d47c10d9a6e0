"""The tree of boxes around a mesh's triangles, walked as shaders walk it."""

from __future__ import annotations

import numpy as np
import pytest

from brdf.render import Mesh, mesh
from brdf.render.tree import MeshTexels, texels

BALL = mesh.load("sphere")


def soup(count: int, seed: int = 0, spread: float = 1.0) -> Mesh:
    """Triangles anywhere."""
    rng = np.random.default_rng(seed)
    corners = rng.normal(size=(count, 1, 3)) * spread + rng.normal(size=(count, 3, 3)) * 0.1
    faces = np.arange(3 * count, dtype=np.int32).reshape(-1, 3)
    normals = np.broadcast_to(np.array([0, 0, 1], "f4"), (count, 3, 3)).copy()
    return Mesh("soup", corners.reshape(-1, 3).astype("f4"), faces, normals)


def leaves(lists: MeshTexels) -> list[tuple[int, int, int]]:
    """(node, first triangle, number of them) in the order in which a ray that meets every box comes to them."""
    found, node, nodes = [], 0, lists.nodes.reshape(-1, 2, 4)
    while node < len(nodes):
        if nodes[node, 0, 3] >= 0:
            found.append((node, int(nodes[node, 0, 3]), int(nodes[node, 1, 3])))
        node += 1
    return found


def boxes_met(lists: MeshTexels, origin: np.ndarray, ray: np.ndarray) -> set[int]:
    """Triangles in the leaves that a ray comes to, as `shadowed` in the shader goes through them."""
    found, node, nodes = set(), 0, lists.nodes.reshape(-1, 2, 4)
    while node < len(nodes):
        least, greatest = nodes[node]
        a, b = (least[:3] - origin) / ray, (greatest[:3] - origin) / ray
        met = max(np.minimum(a, b).max(), 0) <= np.maximum(a, b).min()
        if least[3] >= 0 and met:
            found.update(range(int(least[3]), int(least[3] + greatest[3])))
        node = node + 1 if met or least[3] >= 0 else int(greatest[3])
    return found


def hits(corners: np.ndarray, origin: np.ndarray, ray: np.ndarray) -> set[int]:
    """Triangles (F, 3, 3) that a ray meets, by solving for their weights."""
    matrix = np.stack([corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0], 0 * corners[:, 0] - ray], -1)
    u, v, t = np.linalg.solve(matrix, (origin - corners[:, 0])[..., None])[..., 0].T
    return set(np.flatnonzero((u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0)))


@pytest.mark.parametrize("shape", [BALL, soup(1000), soup(3), soup(500, spread=0.0)])
def test_every_triangle_is_in_one_leaf_and_inside_its_box(shape: Mesh) -> None:
    lists = texels(shape)
    faces, nodes = lists.faces.reshape(-1, 6, 4), lists.nodes.reshape(-1, 2, 4)
    places = [range(first, first + count) for _, first, count in leaves(lists)]
    assert [n for place in places for n in place] == list(range(len(shape.faces)))
    assert max(map(len, places)) <= 4
    for (node, *_), place in zip(leaves(lists), places, strict=True):
        corners = faces[place.start : place.stop, :3, :3]
        assert (corners >= nodes[node, 0, :3]).all()
        assert (corners <= nodes[node, 1, :3]).all()
    triangles = [shape.vertices[shape.faces], shape.normals]
    wanted, found = np.concatenate(triangles, 1).reshape(-1, 18), faces[:, :, :3].reshape(-1, 18)
    np.testing.assert_array_equal(np.unique(found, axis=0), np.unique(wanted, axis=0))


def test_texture_coordinates_stay_with_their_corners() -> None:
    """On the sphere they follow from the position: v = 1 - theta / pi."""
    faces = texels(BALL).faces.reshape(-1, 6, 4)
    height, v = faces[:, :3, 1], faces[:, 3:, 3]
    np.testing.assert_allclose(v, 1 - np.arccos(np.clip(height, -1, 1)) / np.pi, atol=4e-4)
    turn, u = np.arctan2(faces[:, :3, 0], faces[:, :3, 2]) / (2 * np.pi), faces[:, :3, 3]
    away = np.abs(height) < 0.99
    np.testing.assert_allclose(np.exp(2j * np.pi * u)[away], np.exp(2j * np.pi * turn)[away], atol=1e-5)


@pytest.mark.parametrize("shape", [BALL, soup(400)])
def test_no_ray_misses_a_triangle_that_it_meets(shape: Mesh) -> None:
    lists = texels(shape)
    corners = lists.faces.reshape(-1, 6, 4)[:, :3, :3].astype(np.float64)
    rng, looked_at, met = np.random.default_rng(5), 0, 0
    for _ in range(60):
        origin = rng.normal(size=3)
        ray = rng.normal(size=3) * 0.3 - origin
        reached, wanted = boxes_met(lists, origin, ray), hits(corners, origin, ray)
        assert wanted <= reached
        looked_at, met = looked_at + len(reached), met + len(wanted)
    assert met > 30
    assert looked_at < 0.15 * 60 * len(corners)


def test_the_same_mesh_gives_the_same_tree() -> None:
    first, second = texels(soup(300)), texels(soup(300))
    np.testing.assert_array_equal(first.faces, second.faces)
    np.testing.assert_array_equal(first.nodes, second.nodes)


def test_triangles_in_one_place_and_on_a_scale_that_doubles_do_not_make_a_list() -> None:
    same = Mesh("same", soup(1).vertices, np.zeros((5000, 3), "i4"), np.zeros((5000, 3, 3), "f4"))
    assert len(texels(same).nodes) < 4 * 5000
    doubling = soup(120, spread=0.0)
    grown = (doubling.vertices.reshape(-1, 3, 3) * 2.0 ** np.arange(-60, 60)[:, None, None]).reshape(-1, 3)
    lists = texels(Mesh("doubling", grown.astype("f4"), doubling.faces, doubling.normals))
    assert sum(count for *_, count in leaves(lists)) == 120


def test_without_shadows_there_is_no_tree() -> None:
    lists = texels(BALL, shadows=False)
    assert lists.nodes.shape == (0, 4)
    np.testing.assert_array_equal(lists.faces.reshape(-1, 6, 4)[:, :3, :3], BALL.vertices[BALL.faces])
