"""The simulated sample: closed forms for shading, shadows, parallax and one bounce; laws for the rest."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from brdf import models
from brdf.capture import simulate, simulate_btf
from brdf.capture.simulation import Layer, MicroSurface, micro_surface, names
from brdf.capture.simulation.patterns import noise
from brdf.errors import ParameterError, UnknownNameError
from brdf.geometry.directions import from_spherical

WHITE = (Layer(models.Lambertian(albedo=1.0), np.ones((1, 1, 3), np.float32)),)


def towards(theta: float, phi: float = 0.0) -> np.ndarray:
    return np.asarray(from_spherical(math.radians(theta), math.radians(phi)))


def test_a_plane_shows_the_reflectance_itself() -> None:
    plane = MicroSurface(np.zeros((16, 16), np.float32), WHITE)
    elevations = (0, 10, 45, 80, 89.5)
    sample = simulate(plane, elevations, size=8, azimuth=30)
    expected = np.cos(np.radians(elevations))[:, None, None, None] / math.pi
    np.testing.assert_allclose(sample.images, np.broadcast_to(expected, sample.images.shape), rtol=2e-6)
    ggx = models.GGX(alpha=0.2, F0=(0.9, 0.5, 0.1))
    sample = simulate(plane, elevations, size=8, brdf=ggx)
    np.testing.assert_allclose(sample.images[:, 3, 5], ggx.f_cos(towards_all(elevations), towards(0)), rtol=1e-4)


def towards_all(elevations: tuple[float, ...]) -> np.ndarray:
    return np.stack([towards(e) for e in elevations])


@pytest.mark.parametrize("theta", [20, 45, 63, 75])
@pytest.mark.parametrize(("azimuth", "axis"), [(0, 1), (180, 1), (90, 0), (270, 0)])
def test_the_shadow_of_a_step_is_as_long_as_its_height_requires(theta: float, azimuth: float, axis: int) -> None:
    n, high = 256, 22.0
    height = np.zeros((n, n), np.float32)
    block = slice(100, 160)
    height[(slice(None), block) if axis == 1 else (block, slice(None))] = high / n
    picture = simulate(MicroSurface(height, WHITE), (theta,), size=n, azimuth=azimuth, bounce=False).images[0, ..., 0]
    line = picture[50] if axis == 1 else picture[:, 50]
    dark = np.flatnonzero(line < 1e-6)
    beyond = dark < 100 if azimuth in (0, 270) else dark > 159  # light from +x (or from below): to the left (above)
    # the ramp of the step's own face, a texel or two wide, is dark, too
    assert abs(np.count_nonzero(beyond) - high * math.tan(math.radians(theta))) <= 1.5
    assert np.count_nonzero(~beyond) <= 2


def test_one_bounce_in_a_groove_equals_its_form_factor() -> None:
    """The share of the other wall that a point at s on a wall of length l sees: (1 - (s - l cos a) / d(s)) / 2."""
    n, slope, albedo = 128, 1.0, 0.8
    x = np.abs((np.arange(n) + 0.5) - n / 2)
    height = np.broadcast_to(slope * x / n, (n, n)).astype(np.float32)
    layer = Layer(models.Lambertian(albedo=1.0), np.full((1, 1, 3), albedo, np.float32))
    surface = MicroSurface(height, (layer,))
    direct, both = (simulate(surface, (0,), size=n, bounce=b).images[0, ..., 0].mean(0) for b in (False, True))
    tilt = math.atan(slope)
    s, length, opening = x / math.cos(tilt), n / 2 / math.cos(tilt), math.pi - 2 * tilt
    distance = np.sqrt(s**2 + length**2 - 2 * s * length * math.cos(opening))
    factor = (1 - (s - length * math.cos(opening)) / distance) / 2
    wall = (x > 2) & (x < n / 2 - 3)  # at the bottom and at the crest the sampled relief is round
    np.testing.assert_allclose(direct[wall], albedo * math.cos(tilt) / math.pi, rtol=1e-5)
    gained = both[wall] / direct[wall] - 1
    assert abs(gained.mean() / (albedo * factor[wall].mean()) - 1) < 0.02
    assert np.abs(gained - albedo * factor[wall]).max() < 0.03


@pytest.mark.parametrize("theta", [30, 45, 60])
def test_a_raised_plateau_is_seen_displaced_with_half_of_its_face(theta: float) -> None:
    n, high = 128, 12.0
    height = np.zeros((n, n), np.float32)
    height[:, 60:80] = high / n
    colour = np.full((n, n, 3), (0.1, 0.1, 0.9), np.float32)
    colour[:, 60:80] = (0.9, 0.1, 0.1)
    surface = MicroSurface(height, (Layer(models.Lambertian(albedo=1.0), colour),))
    lights = np.stack([towards(0), towards(10), towards(10, 90)])
    views = np.stack([towards(theta), towards(theta, 180), towards(theta, 90)])
    m = simulate_btf(surface, lights, views, n, bounce=False)
    top = high - high * 20 / n  # above the mean plane, which views are rectified to
    slant = math.tan(math.radians(theta))
    # the face is a ramp between the last texel of the plateau and the first below it: half of it has either colour
    for view, near, far, sign in ((0, 79.5, 60, 1), (1, 59.5, 79, -1)):
        row = m.images[0, view, 40]
        seen = np.flatnonzero(row[:, 0] > row[:, 2])[::sign]
        assert abs(seen[0] - (far - sign * top * slant)) <= 1.2
        assert abs(seen[-1] - (near - sign * (top - high / 2) * slant)) <= 2


def test_the_mean_over_a_rough_sample_is_reciprocal() -> None:
    """Shadows follow the light and masking the view: exchanged, the mean BRDF of diffuse facets must stay."""
    n = 192
    height = (0.012 * noise(n, np.random.default_rng(4), 4, 24, 0.5)).astype(np.float32)
    surface = MicroSurface(height, WHITE)
    directions = np.stack([towards(10), towards(55, 20), towards(70, 130), towards(62, 250)])
    mean = simulate_btf(surface, directions, directions, n, bounce=False).images.mean((2, 3, 4))
    assert mean[1, 2] < 0.8 * mean[0, 1]  # it is rough: light from one side, view from another
    np.testing.assert_allclose(mean, mean.T, rtol=0.03)


def test_pictures_continue_themselves_and_depend_on_the_seed_alone() -> None:
    surface = micro_surface("stone", 64)
    moved = MicroSurface(
        np.roll(surface.height, (20, -9), (0, 1)),
        [Layer(a.reflectance, np.roll(a.weight, (20, -9), (0, 1))) for a in surface.layers],
    )
    here, there = (simulate(s, (65,), size=64, bounce=False).images[0] for s in (surface, moved))
    np.testing.assert_allclose(np.roll(here, (20, -9), (0, 1)), there, rtol=1e-4, atol=1e-6)
    same, other = simulate("stone", (65,), 32, seed=0).images, simulate("stone", (65,), 32, seed=1).images
    np.testing.assert_array_equal(simulate("stone", (65,), 32).images, same)
    assert np.abs(same - other).max() > 0.02


@pytest.mark.parametrize("name", names())
def test_every_material_is_plausible(name: str) -> None:
    sample = simulate(name, (0, 30, 60, 85), size=48)
    assert np.isfinite(sample.images).all()
    assert sample.images.min() >= 0
    averages = math.pi * sample.averages
    assert 0.02 < averages[0] < 0.9
    assert (np.diff(averages) < 0).all()
    contrast = sample.images.std((1, 2)).mean(-1) / sample.images.mean((1, 2)).mean(-1)
    assert contrast[2] > 0.08  # there is something to see
    assert contrast[3] > contrast[1]  # and the more, the lower the lamp


def test_there_are_the_materials_of_the_paper() -> None:
    wanted = {"jeans", "suede", "leather", "pressed wood", "wax", "nylon", "cloth", "wool", "plastic", "stone"}
    assert wanted <= set(names())


def test_a_full_btf_agrees_with_the_pictures_from_above() -> None:
    lights = np.stack([towards(0), towards(40), towards(60, 90)])
    m = simulate_btf("leather", lights, np.stack([towards(0), towards(30), towards(30, 120)]), size=32)
    picture = simulate("leather", (40,), 32).images[0]
    np.testing.assert_allclose(m.images[1, 0] * math.cos(math.radians(40)), picture, rtol=1e-5, atol=1e-7)
    assert m.name == "leather"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"material": "lether"}, "unknown simulated material 'lether': did you mean 'leather'?"),
        ({"elevations": (0, 90)}, r"elevations must be angles from the normal in \[0, 90\) degrees"),
        ({"elevations": ()}, "at least one"),
        ({"size": 0}, "size must lie between 1 and 4096 pixels, got 0"),
        ({"brdf": models.Mirror()}, "Mirror mirrors or transmits; a relief needs rough reflection"),
        ({"material": MicroSurface(np.zeros((12, 12)), WHITE), "size": 5}, "size must divide the 12 texels"),
    ],
)
def test_mistakes_are_named(arguments: dict[str, object], message: str) -> None:
    given = {"material": "wax", "elevations": (0,), "size": 8} | arguments
    with pytest.raises((ParameterError, UnknownNameError), match=message):
        simulate(**given)  # type: ignore[arg-type]


def test_a_relief_must_be_a_square_of_numbers() -> None:
    for height in (np.zeros((3, 4)), np.full((2, 2), np.nan), np.zeros(5)):
        with pytest.raises(ParameterError, match="a height field must be square and finite"):
            MicroSurface(height, WHITE)


@pytest.mark.parametrize(("theta", "azimuth"), [(40, 0), (60, 70), (75, 160)])
@pytest.mark.parametrize("bounce", [False, True])
def test_a_path_tracer_sees_the_same_relief(theta: float, azimuth: float, bounce: bool, tmp_path: Path) -> None:
    mi = pytest.importorskip("mitsuba")
    if mi.variant() is None:
        mi.set_variant("scalar_rgb")
    n, albedo = 48, 0.8
    height = (0.03 * noise(n, np.random.default_rng(7), 2, 6, 1.0)).astype(np.float32)
    layer = Layer(models.Lambertian(albedo=1.0), np.full((1, 1, 3), albedo, np.float32))
    ours = simulate(MicroSurface(height, (layer,)), (theta,), n, azimuth=azimuth, bounce=bounce).images[0, ..., 0]
    with mi.util.variant_context("scalar_rgb"):
        write_tiles(mi, height * n, tmp_path / "relief.ply")
        scene = path_traced(mi, tmp_path / "relief.ply", n, albedo, towards(theta, azimuth), 3 if bounce else 2)
        theirs = np.array(mi.render(scene))[..., 0]
    # their facets are flat triangles and their pixels hold many rays, ours one: edges of shadows differ
    assert ours.mean() == pytest.approx(theirs.mean(), rel=0.015)
    assert np.corrcoef(ours.ravel(), theirs.ravel())[0, 1] > 0.95


def write_tiles(mi: Any, height: np.ndarray, path: Path) -> None:
    """3 x 3 tiles of a height field in texels, the middle one around the origin, as triangles."""
    n, field = len(height), np.tile(height - height.mean(), (3, 3))
    column, row = np.meshgrid(np.arange(3 * n), np.arange(3 * n))
    points = np.stack([column - 1.5 * n + 0.5, 1.5 * n - 0.5 - row, field], -1).reshape(-1, 3)
    i = (row * 3 * n + column)[:-1, :-1].ravel()
    j = i + 3 * n
    faces = np.concatenate([np.stack([i, j, i + 1], -1), np.stack([i + 1, j, j + 1], -1)])
    mesh = mi.Mesh("relief", len(points), len(faces))
    parameters = mi.traverse(mesh)
    parameters["vertex_positions"], parameters["faces"] = points.ravel(), faces.ravel()
    parameters.update()
    mesh.write_ply(str(path))


def path_traced(mi: Any, relief: Path, n: int, albedo: float, wi: np.ndarray, depth: int) -> Any:
    """The relief from above under irradiance 1 from `wi`."""
    transform = mi.ScalarTransform4f
    above = transform().look_at(origin=[0, 0, 9 * n], target=[0, 0, 0], up=[0, 1, 0])
    diffuse = {"type": "diffuse", "reflectance": {"type": "rgb", "value": [albedo] * 3}}
    return mi.load_dict({
        "type": "scene",
        "integrator": {"type": "path", "max_depth": depth, "rr_depth": 99},
        "sensor": {
            "type": "orthographic",
            "to_world": above @ transform().scale([n / 2, n / 2, 1]),
            "far_clip": 100.0 * n,
            "film": {"type": "hdrfilm", "width": n, "height": n, "rfilter": {"type": "box"}},
            "sampler": {"type": "independent", "sample_count": 64},
        },
        "lamp": {"type": "directional", "direction": [-float(x) for x in wi], "irradiance": 1.0},
        "relief": {"type": "ply", "filename": str(relief), "face_normals": True,
                   "bsdf": {"type": "twosided", "inner": diffuse}},
    })  # fmt: skip
