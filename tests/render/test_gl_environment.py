"""Light from all around on a graphics card: the same expectation as on the processor, from the same sample points."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import brdf
from brdf.models import GGX, Lambertian
from brdf.reflectance import Reflectance
from brdf.render import Environment, environment, render
from brdf.render.environment_texels import map_texels, places
from brdf.render.gl import renderer
from brdf.render.stand_in import lobe_density, stand_in

PLASTIC = GGX(alpha=0.2, F0=(1, 0.78, 0.34)) + Lambertian(albedo=(0.2, 0.1, 0.3))
WHITE = Lambertian(albedo=1.0)
SMALL: dict[str, Any] = {"mesh": "sphere", "size": (40, 30), "background": (0, 0, 0)}

pytestmark = pytest.mark.usefixtures("gl")


def deviation(first: Any, second: Any) -> float:
    """RMS difference, relative to the mean of the pixels that are lit."""
    lit = second.pixels.max(-1) > 0
    return float(np.sqrt(np.mean((first.pixels - second.pixels)[lit] ** 2)) / second.pixels[lit].mean())


@pytest.mark.parametrize(("m", "mesh"), [
    (PLASTIC, "sphere"), (brdf.TwoSided(GGX(alpha_x=0.1, alpha_y=0.4)), "sphere"), (PLASTIC, "teapot"),
])  # fmt: skip
def test_it_converges_to_what_the_processor_draws(m: Reflectance, mesh: str) -> None:
    count = 512 if mesh == "sphere" else 64
    scene: dict[str, Any] = SMALL | {"mesh": mesh, "samples": count, "env": environment.load("studio", rotation=70)}
    reference = render(m, **scene | {"samples": 16 * count}, seed=3)
    drawn, alike = render(m, **scene, backend="gl"), render(m, **scene)
    assert deviation(drawn, reference) < 1.5 * deviation(alike, reference)
    means = drawn.pixels.mean((0, 1)) / reference.pixels.mean((0, 1))
    np.testing.assert_allclose(means, 1, atol=1e-3 if mesh == "sphere" else 4e-3)


def test_a_white_sphere_in_white_surroundings_cannot_be_seen() -> None:
    image = render(WHITE, "sphere", env=1.0, size=(64, 48), samples=64, background=(1, 1, 1), backend="gl")
    assert image.pixels.mean() == pytest.approx(1, abs=2e-3)
    np.testing.assert_allclose(image.pixels, 1, atol=0.12)


def test_a_single_bright_pixel_is_found_and_turns_with_the_map() -> None:
    """Against the light as a sum over pixels: E(n) / pi is what a white surface with that normal shows."""
    pixels = np.full((16, 32, 3), 0.01)
    pixels[4, 20] = (90, 60, 30)
    lamp = Environment(pixels, rotation=40)
    image = render(WHITE, "sphere", env=lamp, camera=brdf.render.Camera((0, 0, 5), height=0.02), size=(4, 4),
                   samples=1024, backend="gl")  # fmt: skip
    np.testing.assert_allclose(image.pixels.mean((0, 1)), lamp.irradiance((0, 0, 1)) / np.pi, rtol=0.02)


def test_the_same_seed_gives_the_same_picture_and_another_one_another() -> None:
    first, same, other = (render(PLASTIC, **SMALL, seed=seed, backend="gl").pixels for seed in (0, 0, 1))
    np.testing.assert_array_equal(first, same)
    assert np.abs(first - other).max() > 0.01


def test_lights_shine_once_however_many_passes_there_are(monkeypatch: pytest.MonkeyPatch) -> None:
    scene: dict[str, Any] = SMALL | {"samples": 12, "supersampling": 1, "backend": "gl"}
    scene |= {"lights": "directional:theta=50", "env": "studio"}
    whole = render(PLASTIC, **scene)
    monkeypatch.setattr(renderer, "MOST_AT_ONCE", 4)
    np.testing.assert_allclose(render(PLASTIC, **scene).pixels, whole.pixels, rtol=1e-5, atol=1e-6)


@pytest.mark.parametrize("lobe", [(1.0, 0.5), (0.05, 0.9), (0.3, 0.05)])
def test_what_stands_in_decides_the_noise_alone(lobe: tuple[float, float], monkeypatch: pytest.MonkeyPatch) -> None:
    scene: dict[str, Any] = SMALL | {"samples": 256, "supersampling": 1}
    expected = render(PLASTIC, **scene).pixels.mean((0, 1))
    monkeypatch.setattr(renderer, "stand_in", lambda _: lobe)
    np.testing.assert_allclose(render(PLASTIC, **scene, backend="gl").pixels.mean((0, 1)), expected, rtol=4e-3)


@pytest.mark.parametrize(("m", "alpha", "share"), [
    (GGX(alpha=0.1, F0=1), (0.07, 0.14), (0.9, 1)), (GGX(alpha=0.5, F0=1), (0.2, 0.75), (0.3, 1)),
    (WHITE, (0, 1), (0, 0.1)), (PLASTIC, (0.12, 0.3), (0.4, 0.9)), (Lambertian(albedo=0), (1, 1), (0, 0.1)),
    (brdf.TwoSided(GGX(alpha=0.1)), (0.07, 0.14), (0.9, 1)),
])  # fmt: skip
def test_a_lobe_is_found_for_every_material(m: Reflectance, alpha: Any, share: Any) -> None:
    """Of a narrow lobe its own width, of a matte surface none, and something where nothing is reflected at all."""
    found = stand_in(m)
    assert alpha[0] <= found[0] <= alpha[1]
    assert share[0] <= found[1] <= share[1]
    assert stand_in(m) == found


@pytest.mark.parametrize(
    ("angle", "least", "most"), [(0, 1 / 1.04 - 1e-3, 1 / 1.04 + 1e-3), (50, 0.9, 1), (80, 0.8, 1)]
)
def test_the_lobe_is_a_density(angle: float, least: float, most: float) -> None:
    """Of 1 what the surface would mirror below itself is missing: along the normal alpha^2 / (1 + alpha^2) of it."""
    cosine, phi = (np.arange(800) + 0.5) / 800, 2 * np.pi * (np.arange(800) + 0.5) / 800
    z, phi = (a.ravel() for a in np.meshgrid(cosine, phi))
    wi = np.stack([np.sqrt(1 - z**2) * np.cos(phi), np.sqrt(1 - z**2) * np.sin(phi), z], -1)
    wo = np.broadcast_to([np.sin(np.radians(angle)), 0, np.cos(np.radians(angle))], wi.shape)
    assert least < lobe_density(wi, wo, 0.2).mean() * 2 * np.pi < most


def test_places_lie_where_the_light_is() -> None:
    """The mean of 1 / density over them is the sphere's solid angle, and of radiance / density the whole light."""
    studio = environment.load("studio", rotation=25)
    texels, drawn = map_texels(studio), places(studio).reshape(-1, 2)
    rows, columns = texels.shape[:2]
    at = texels[(drawn[:, 1] * rows).astype(int).clip(0, rows - 1), (drawn[:, 0] * columns).astype(int) % columns]
    assert (1 / at[:, 3]).mean() == pytest.approx(4 * np.pi, rel=0.05)
    edges = np.cos(np.arange(rows + 1) * np.pi / rows)
    whole = (studio.pixels * ((edges[:-1] - edges[1:]) * 2 * np.pi / columns)[:, None, None]).sum((0, 1))
    np.testing.assert_allclose((at[:, :3] / at[:, 3:]).mean(0), whole, rtol=0.01)
