"""The renderer against closed forms: what each pixel must be, computed without it."""

from __future__ import annotations

import numpy as np
import pytest

import brdf
from brdf.errors import ParameterError, SceneError, UnknownNameError
from brdf.render import Camera, Directional, Environment, Point, render, render_halves

WHITE = brdf.models.Lambertian(albedo=1.0)
ABOVE = Camera((0, 0, 5), height=2.2)
"""Parallel rays along -z onto the unit sphere; the picture is 2.2 wide and high."""


def sphere_normals(size):
    """Normals of the unit sphere under ABOVE at pixel centres, and which pixels lie wholly on it."""
    centre = ((np.arange(size) + 0.5) / size - 0.5) * 2.2
    x, y = np.meshgrid(centre, -centre)
    z = np.sqrt(np.maximum(1 - x**2 - y**2, 0))
    return np.stack([x, y, z], -1), np.hypot(x, y) < 1 - 2 * 2.2 / size


def test_lambertian_sphere_under_one_light_is_the_cosine():
    size, albedo = 96, np.array([0.2, 0.5, 0.8])
    light = Directional(theta=50, phi=35, power=2.0)
    image = render(
        brdf.models.Lambertian(albedo=albedo), "sphere", light, camera=ABOVE, size=(size, size), supersampling=1
    )
    normals, inside = sphere_normals(size)
    expected = 2 * albedo * np.maximum(normals @ light.toward, 0)[..., None]
    np.testing.assert_allclose(image.pixels[inside], expected[inside], atol=2e-5)


def test_light_from_plus_x_is_on_the_right_and_from_plus_y_above():
    for light, axis, sign in ((Directional(90, 90), 1, 1), (Directional(0, 0), 0, -1), (Directional(90, -90), 1, -1)):
        image = render(WHITE, "sphere", light, camera=Camera((0, 0, 5)), size=(64, 64), background=(0, 0, 0))
        halves = np.split(image.pixels.sum(-1), 2, axis)
        assert sign * (halves[1].sum() - halves[0].sum()) > 0.9 * image.pixels.sum(), light


def test_point_light_falls_with_the_square_of_the_distance():
    ray = {"mesh": "plane", "camera": Camera((0, 3, 0.001), fov=1), "size": (8, 8)}
    near = render(WHITE, lights=Point((0, 1, 0)), **ray).pixels.mean()
    far = render(WHITE, lights=Point((0, 3, 0)), **ray).pixels.mean()
    assert near == pytest.approx(1.0, rel=2e-3)
    assert far == pytest.approx(1 / 9, rel=2e-3)


@pytest.mark.parametrize("shadows", [True, False])
def test_white_furnace(shadows):
    """A white convex body in white surroundings cannot be seen."""
    image = render(WHITE, "sphere", env=1.0, size=(64, 48), samples=64, background=(1, 1, 1), shadows=shadows)
    assert image.pixels.mean() == pytest.approx(1, abs=2e-3)
    np.testing.assert_allclose(image.pixels, 1, atol=0.12)


def test_furnace_of_a_rough_metal_shows_its_albedo():
    metal = brdf.models.GGX(alpha=0.4, F0=(0.9, 0.6, 0.3))
    image = render(metal, "sphere", env=1.0, camera=Camera((0, 0, 5), fov=1), size=(8, 8), samples=4096)
    np.testing.assert_allclose(image.pixels.mean((0, 1)), metal.albedo([0.0, 0.0, 1.0]), rtol=5e-3)


def linear_environment(height=64):
    """Radiance 1 + x/2 + 0.3 y - 0.2 z of the direction."""
    theta = (np.arange(height) + 0.5) * np.pi / height
    phi = ((np.arange(2 * height) + 0.5) / (2 * height) - 0.5) * 2 * np.pi
    x, y = np.sin(theta)[:, None] * np.sin(phi), np.broadcast_to(np.cos(theta)[:, None], (height, 2 * height))
    z = -np.sin(theta)[:, None] * np.cos(phi)
    return np.repeat((1 + x / 2 + 0.3 * y - 0.2 * z)[..., None], 3, -1)


def test_matte_sphere_in_a_linear_environment():
    """The cosine lobe keeps 2/3 of a linear radiance: E(n) / pi = 1 + 2/3 (n_x / 2 + 0.3 n_y - 0.2 n_z)."""
    size = 32
    image = render(WHITE, "sphere", env=Environment(linear_environment()), camera=ABOVE, size=(size, size), samples=256)
    normals, inside = sphere_normals(size)
    expected = 1 + 2 / 3 * normals @ (0.5, 0.3, -0.2)
    error = image.pixels[inside] - expected[inside][:, None]
    assert abs(error.mean()) < 3e-3
    assert error.std() < 0.02


def test_both_ways_to_sample_agree_with_one_another():
    """A small lamp and a sharp metal: far too rare for one kind of direction alone, exact by integration."""
    pixels = np.full((32, 64, 3), 0.1)
    pixels[10:13, 46:50] = 40
    environment = Environment(pixels)
    metal = brdf.models.GGX(alpha=0.15, F0=0.8)
    camera = Camera((0, 0, 5), fov=0.5)
    from brdf.render.lights import direction

    toward = environment.sample(np.random.default_rng(3).random((400_000, 2), np.float32))
    wo = np.array([0.0, 0.0, 1.0])
    # The normal halfway between lamp and viewer: seen there, the sphere mirrors the lamp.
    phi = (48 / 64 - 0.5) * 360
    lamp = direction(11.5 / 32 * 180, 180 - phi)
    normal = (lamp + wo) / np.linalg.norm(lamp + wo)
    tangent = np.cross([0, 1, 0], normal)
    tangent /= np.linalg.norm(tangent)
    frame = np.stack([tangent, np.cross(normal, tangent), normal])
    local = toward[0] @ frame.T
    local = (local / np.linalg.norm(local, axis=-1, keepdims=True)).astype(np.float32)
    f_cos = metal.f_cos(local, np.broadcast_to((frame @ wo).astype(np.float32), local.shape))
    expected = (f_cos * toward[1] / toward[2][:, None]).mean(0)
    camera = Camera(normal + 5 * wo, normal, fov=0.2)
    image = render(metal, "sphere", env=environment, camera=camera, size=(8, 8), samples=1024)
    np.testing.assert_allclose(image.pixels.mean((0, 1)), expected, rtol=0.01)


OBSTACLE = """v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nv 0 1 1\nv 1 1 1\nv 1 1 -1\nv 0 1 -1\nf 1 2 3 4\nf 5 6 7 8\n"""


def test_shadow_falls_where_the_light_is_blocked(tmp_path):
    """A square above the right half of another, lit from straight above and seen at a slant from below its edge."""
    mesh = tmp_path / "squares.obj"
    mesh.write_text(OBSTACLE)
    camera = Camera((0, 0.45, 9), (0, 0, 0), fov=14)
    points = np.array([(-0.5, 0, 0.5), (0.5, 0, 0.5), (0.5, 0, -0.2), (-0.5, 0, -0.2)])
    at = camera.project(points, 400, 300).astype(int)
    lit = {
        on: render(WHITE, mesh, Directional(0, 0), camera=camera, size=(400, 300), shadows=on).pixels[
            at[:, 1], at[:, 0], 0
        ]
        for on in (True, False)
    }
    np.testing.assert_allclose(lit[True], [1, 0, 0, 1], atol=1e-4)
    np.testing.assert_allclose(lit[False], 1, atol=1e-4)


def test_coarse_mesh_with_smooth_normals_has_no_facets_in_its_terminator(tmp_path):
    import trimesh

    coarse = trimesh.creation.icosphere(subdivisions=2)
    coarse.export(tmp_path / "coarse.ply")
    light = Directional(90, 80)
    options = {"camera": ABOVE, "size": (128, 128), "background": (0, 0, 0)}
    exact = render(WHITE, "sphere", light, **options).pixels[..., 0]
    meshed = render(WHITE, tmp_path / "coarse.ply", light, **options).pixels[..., 0]
    _, inside = sphere_normals(128)
    inside = inside & (np.hypot(*np.meshgrid(*[np.linspace(-1.1, 1.1, 128)] * 2)) < 0.9)
    assert np.abs(exact - meshed)[inside].max() < 0.06
    facing = inside & (exact > 0.08)
    assert (meshed[facing] > 0).all()


def test_orthographic_sphere_is_a_circle_of_the_right_size():
    image = render(WHITE, "sphere", env=1.0, camera=ABOVE, size=(200, 200), samples=1, background="transparent")
    assert image.alpha.sum() * (2.2 / 200) ** 2 == pytest.approx(np.pi, rel=2e-3)


def test_perspective_sphere_subtends_its_angle():
    camera = Camera((0, 0, 4), fov=40)
    image = render(WHITE, "sphere", env=1.0, camera=camera, size=(200, 200), samples=1, background="transparent")
    radius = np.tan(np.arcsin(1 / 4)) / np.tan(np.radians(20)) * 100
    assert image.alpha.sum() == pytest.approx(np.pi * radius**2, rel=2e-3)


@pytest.mark.parametrize("mesh", ["teapot", "sphere"])
def test_same_seed_same_picture(mesh):
    metal = brdf.models.GGX(alpha=0.1, F0=0.9)
    first, again, other = (render(metal, mesh, size=(60, 40), samples=8, seed=seed).pixels for seed in (4, 4, 5))
    np.testing.assert_array_equal(first, again)
    assert (first != other).any()


def test_every_pixel_is_finite_at_grazing_angles():
    for model in (brdf.models.GGX(alpha=1e-3, F0=1), brdf.models.GGX(alpha=1.0, F0=1)):
        image = render(model, "teapot", ["directional:theta=89", "point:0/3/0"], 1.0, size=(120, 90), samples=4)
        assert np.isfinite(image.pixels).all()
        assert (image.pixels >= 0).all()


def test_default_light_shows_middle_grey_as_middle_grey():
    grey = brdf.models.Lambertian(albedo=0.18)
    image = render(grey, "sphere", size=(80, 60), samples=64, background="transparent")
    mean = image.pixels.sum((0, 1)) / image.alpha.sum()
    np.testing.assert_allclose(mean, 0.18, rtol=0.03)


def test_halves_are_the_two_materials():
    red, blue = (brdf.models.Lambertian(albedo=colour) for colour in ((1, 0, 0), (0, 0, 1)))
    options = {
        "mesh": "sphere",
        "lights": Directional(60, 0),
        "camera": ABOVE,
        "size": (64, 64),
        "background": (0, 0, 0),
    }
    both = render_halves(red, blue, divider=0, **options).pixels
    np.testing.assert_array_equal(both[:, :32], render(red, **options).pixels[:, :32])
    np.testing.assert_array_equal(both[:, 32:], render(blue, **options).pixels[:, 32:])
    line = render_halves(red, blue, divider=2, **options).pixels
    assert (line[:, 31:33] == 1).all()


def test_progress_is_told_to_the_end():
    told = []
    render(WHITE, "sphere", size=(16, 12), samples=16, progress=told.append)
    assert told == [0.25, 0.5, 0.75, 1.0]


@pytest.mark.parametrize(
    ("options", "error", "words"),
    [
        ({"size": (0, 10)}, SceneError, "size must lie between"),
        ({"size": 10}, SceneError, "size must be"),
        ({"samples": 0}, ParameterError, "samples must be a whole number"),
        ({"seed": -1}, ParameterError, "seed"),
        ({"lights": []}, SceneError, "there is no light"),
        ({"lights": [3]}, SceneError, "a light must be"),
        ({"background": "enviroment"}, UnknownNameError, "did you mean 'environment'"),
        ({"lights": "directional", "background": "environment"}, SceneError, "needs an environment"),
        ({"mesh": "teapott"}, UnknownNameError, "did you mean 'teapot'"),
    ],
)
def test_what_cannot_be_rendered_says_why(options, error, words):
    with pytest.raises(error, match=words):
        render(WHITE, **options)


def test_without_embree_the_sphere_is_rendered_and_a_mesh_says_what_it_needs(monkeypatch):
    import sys

    for name in ("embreex", "embreex.mesh_construction", "embreex.rtcore_scene"):
        monkeypatch.setitem(sys.modules, name, None)
    assert render(WHITE, "sphere", "directional", size=(16, 12)).pixels.max() > 0.5
    with pytest.raises(SceneError, match="mesh teapot needs embreex"):
        render(WHITE, "teapot", "directional", size=(16, 12))


def test_what_is_shown_stands_in_the_file(tmp_path):
    from PIL import Image as Pictures

    metal = brdf.models.GGX(alpha=0.2).named("a metal", "measured here")
    render(metal, "sphere", "directional:theta=30,phi=0,power=2", size=(16, 12)).save(tmp_path / "a.png")
    text = Pictures.open(tmp_path / "a.png").text
    assert text["Material"] == "a metal"
    assert text["Source"] == "measured here"
    assert text["Light"] == "directional:theta=30,phi=0,power=2/2/2"
    assert text["Software"] == f"brdf {brdf.__version__}"
