"""Shapes: the teapot against the published patches, normals, files."""

from __future__ import annotations

import numpy as np
import pytest

from brdf.errors import CorruptFileError, FileError, SceneError, UnknownNameError
from brdf.render import teapot
from brdf.render.mesh import corner_normals, load


def signed_volume(mesh):
    corners = mesh.vertices[mesh.faces].astype(float)
    return np.einsum("fi,fi->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6


def area(mesh):
    corners = mesh.vertices[mesh.faces].astype(float)
    return np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=-1).sum() / 2


def outward(mesh):
    """Share of the corners whose normal agrees with the winding of the face."""
    corners = mesh.vertices[mesh.faces].astype(float)
    face = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return (np.einsum("fi,fci->fc", face, mesh.normals) > 0).mean()


def test_teapot_patches_are_the_published_ones(data):
    lines = (data / "mesh" / "teapot.bpt").read_text().split("\n")
    published = np.array([line.split() for line in lines if len(line.split()) == 3], float).reshape(32, 16, 3)

    def canonical(patches):
        return sorted(sorted(map(tuple, np.round(patch, 6) + 0.0)) for patch in patches.reshape(32, 16, 3))

    assert canonical(teapot.patches()) == canonical(published)


def test_teapot_shape():
    mesh = load("teapot")
    np.testing.assert_allclose(mesh.bounds, [[-3, 0, -2], [3.434, 3.15, 2]], atol=0.01)
    assert outward(mesh) == 1
    assert np.isfinite(mesh.normals).all()
    # Handle and spout turn their own outsides out, as the body does.
    for part in (mesh.vertices[:, 0] < -2.05, mesh.vertices[:, 0] > 2.05):
        faces = part[mesh.faces].all(1)
        aside = mesh.vertices[mesh.faces[faces]][..., 2]  # both are tubes about the plane z = 0
        far = np.abs(aside) > 0.15
        assert (aside[far] * mesh.normals[faces][..., 2][far] > 0).mean() > 0.9


def test_teapot_body_is_closed_and_of_the_volume_of_its_profile():
    """The body turned about its axis: the volume from the profile alone, to the error of a circle made of Béziers."""
    t = np.linspace(0, 1, 2001)
    value, _ = teapot.bernstein(t)
    expected = 0.0
    for name in ("upper body", "lower body", "bottom"):
        profile = np.array(teapot.PROFILES[name])
        radius, height = value @ profile[:, 0], value @ profile[:, 2]
        expected += np.trapezoid(np.pi * radius**2, -height)
    patches = teapot.patches()
    points = patches[4:12].reshape(-1, 3)
    assert points[:, 2].min() == 0.15
    made = teapot.tessellated(24)
    body = np.isin(made["faces"][:, 0] // 25**2, [*range(4, 12), *range(20, 24)])
    corners = made["vertices"][made["faces"][body]]
    flux = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
    # The opening at height 2.4 is closed by a disc; the divergence theorem with F = (0, y, 0).
    volume = (flux[:, 1] * corners[..., 1].mean(1)).sum() + 2.4 * np.pi * 1.5**2
    assert volume == pytest.approx(expected, rel=0.01)


def test_teapot_normals_are_those_of_the_surface():
    """Against finite differences of the patches, and the limits at the knob's tip and the bottom's middle."""
    made = teapot.tessellated(20)
    step = 1e-5
    t = np.linspace(0, 1, 21)
    inner = t[3:18]
    control = teapot.patches()

    def at(u, v):
        return np.einsum("ik,jl,pklc->pijc", teapot.bernstein(u)[0], teapot.bernstein(v)[0], control)

    along = (at(inner + step, inner) - at(inner - step, inner)) / (2 * step)
    around = (at(inner, inner + step) - at(inner, inner - step)) / (2 * step)
    expected = np.cross(around, along)
    expected /= np.linalg.norm(expected, axis=-1, keepdims=True)
    normals = made["normals"].reshape(32, 21, 21, 3)[:, 3:18, 3:18]
    np.testing.assert_allclose(normals, expected[..., [0, 2, 1]] * (1, 1, -1), atol=1e-6)
    tip = np.isclose(made["vertices"], (0, 3.15, 0)).all(1)
    middle = np.isclose(made["vertices"], 0).all(1)
    assert tip.sum() == middle.sum() == 4 * 21
    np.testing.assert_allclose(made["normals"][tip], np.broadcast_to((0, 1, 0), (84, 3)), atol=1e-9)
    np.testing.assert_allclose(made["normals"][middle], np.broadcast_to((0, -1, 0), (84, 3)), atol=1e-9)


def test_sphere():
    mesh = load("sphere")
    assert signed_volume(mesh) == pytest.approx(4 / 3 * np.pi, rel=5e-3)
    assert area(mesh) == pytest.approx(4 * np.pi, rel=3e-3)
    assert outward(mesh) == 1


def test_plane_faces_up():
    mesh = load("plane")
    np.testing.assert_allclose(mesh.normals, np.broadcast_to((0, 1, 0), (2, 3, 3)))


@pytest.mark.parametrize("name", ["bunny.ply", "shaderball.glb", "teapot_materialx.obj"])
def test_files_are_read(data, name):
    mesh = load(data / "mesh" / name)
    assert len(mesh.faces) == {"bunny.ply": 69451, "shaderball.glb": 88264, "teapot_materialx.obj": 25200}[name]
    assert signed_volume(mesh) > 0
    assert outward(mesh) > 0.99
    assert (mesh.uvs is None) == (name == "bunny.ply")


CUBE = "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1)) + (
    "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n"
)


def test_edges_of_a_cube_stay_sharp(tmp_path):
    path = tmp_path / "cube.obj"
    path.write_text(CUBE)
    mesh = load(path)
    assert signed_volume(mesh) == pytest.approx(1)
    np.testing.assert_allclose(np.abs(mesh.normals).max(-1), 1, atol=1e-6)


def test_a_coarse_ball_is_smoothed():
    ball = load("sphere")
    normals = corner_normals(ball.vertices.astype(float), ball.faces)
    assert np.einsum("fci,fci->fc", normals, ball.normals).min() > np.cos(np.radians(2))


def test_normals_of_the_file_are_kept(tmp_path):
    path = tmp_path / "bent.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0.6 0 0.8\nf 1//1 2//1 3//1\n")
    np.testing.assert_allclose(load(path).normals, np.broadcast_to((0.6, 0, 0.8), (1, 3, 3)), atol=1e-6)


def test_a_face_that_stands_twice_counts_once(tmp_path):
    path = tmp_path / "twice.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 2 4 3\nf 2 1 3\nf 3 1 2\n")
    np.testing.assert_array_equal(load(path).faces, [(0, 1, 2), (1, 3, 2)])


def test_bad_meshes_say_what_is_wrong(tmp_path):
    import trimesh

    with pytest.raises(UnknownNameError, match="did you mean 'teapot'"):
        load("teapo")
    with pytest.raises(FileError, match="no such mesh file"):
        load("none.ply")
    with pytest.raises(FileError, match="is a folder"):
        load(tmp_path)
    trimesh.PointCloud(np.random.default_rng(0).random((10, 3))).export(tmp_path / "points.ply")
    with pytest.raises(SceneError, match=r"points\.ply: has no faces"):
        load(tmp_path / "points.ply")
    (tmp_path / "broken.ply").write_bytes(b"ply\nformat binary_little_endian 1.0\nelement vertex 99999999999\n")
    with pytest.raises(CorruptFileError, match=r"broken\.ply"):
        load(tmp_path / "broken.ply")
    (tmp_path / "what.xyzzy").write_bytes(b"?")
    with pytest.raises(CorruptFileError, match="no known mesh format"):
        load(tmp_path / "what.xyzzy")
    (tmp_path / "flat.obj").write_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")
    with pytest.raises(SceneError, match="area of zero"):
        load(tmp_path / "flat.obj")


@pytest.mark.parametrize("kind", ["ascii.ply", "binary.ply", "ascii.stl", "binary.stl", "glb", "quads.ply"])
def test_files_that_were_cut_off_are_refused(tmp_path, kind):
    import trimesh

    ball = trimesh.creation.icosphere(2)
    whole = tmp_path / f"whole.{kind}"
    if kind == "ascii.stl":
        ball.export(whole, file_type="stl_ascii")
    elif kind == "quads.ply":
        corners = "".join(f"{x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1))
        faces = "4 0 1 3 2\n4 4 6 7 5\n3 0 4 5\n3 0 5 1\n4 2 3 7 6\n"
        properties = "property float x\nproperty float y\nproperty float z\n"
        header = f"element vertex 8\n{properties}element face 5\nproperty list uchar int vertex_indices\n"
        whole.write_text(f"ply\nformat ascii 1.0\n{header}end_header\n{corners}{faces}")
    else:
        ball.export(whole, **({"encoding": "ascii"} if kind == "ascii.ply" else {}))
    assert len(load(whole).faces) == (8 if kind == "quads.ply" else 320)
    content = whole.read_bytes()
    cut = tmp_path / f"cut.{kind}"
    for share in (0.4, 0.7, 0.9):
        cut.write_bytes(content[: int(share * len(content))])
        with pytest.raises(CorruptFileError, match=r"cut\..*truncated or damaged") as caught:
            load(cut)
        assert "\n" not in str(caught.value)
