"""Pictures lit from all around against integrals, and what ranks by them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from brdf import metrics
from brdf.errors import UnknownNameError
from brdf.metrics.surroundings import lit_from_all_around, radiance_of_surroundings
from brdf.models import GGX, Lambertian


def irradiance(normal: np.ndarray) -> np.ndarray:
    """(3,) by a rule of its own: even steps in the angle from +y and around it."""
    theta, phi = np.meshgrid((np.arange(400) + 0.5) * math.pi / 400, (np.arange(800) + 0.5) * math.pi / 400)
    d = np.stack([np.sin(theta) * np.sin(phi), np.cos(theta), np.sin(theta) * np.cos(phi)], -1)
    weight = np.maximum(d @ normal, 0) * np.sin(theta) * (math.pi / 400) ** 2
    return np.einsum("ijc,ij->c", radiance_of_surroundings(d), weight)


def test_a_white_diffuser_shows_the_irradiance() -> None:
    picture = lit_from_all_around(Lambertian(albedo=1.0), size=9)
    axis = (2 * np.arange(9) + 1) / 9 - 1
    x, y = (grid.ravel() for grid in np.meshgrid(axis, axis))
    inside = x * x + y * y < 1
    normals = np.stack([x, y, np.sqrt(np.maximum(1 - x * x - y * y, 0))], -1)[inside]
    assert len(picture) == len(normals)
    for pixel in (0, len(normals) // 2, len(normals) - 1):
        np.testing.assert_allclose(picture[pixel], irradiance(normals[pixel]) / math.pi, rtol=4e-3)


def test_the_picture_is_upright() -> None:
    picture = lit_from_all_around(Lambertian(albedo=1.0), size=24)
    assert picture[-40:].mean() > 1.5 * picture[:40].mean()  # the lamps hang above the horizon


def test_a_glossy_sphere_shows_the_lamps() -> None:
    m = GGX(alpha=0.15, F0=1.0)
    picture = lit_from_all_around(m, size=41)
    middle = picture[len(picture) // 2]  # there the normal is the direction to the viewer
    theta, phi = np.meshgrid((np.arange(600) + 0.5) * math.pi / 1200, (np.arange(600) + 0.5) * math.pi / 300)
    world = np.stack([np.sin(theta) * np.sin(phi), np.sin(theta) * np.cos(phi), np.cos(theta)], -1)
    weight = np.sin(theta) * math.pi / 1200 * math.pi / 300
    light = radiance_of_surroundings(world)
    expected = np.einsum("ijc,ijc,ij->c", m.f_cos(world, np.array([0.0, 0.0, 1.0])), light, weight)
    np.testing.assert_allclose(middle, expected, rtol=0.02)


def test_other_rankings_are_refused() -> None:
    with pytest.raises(UnknownNameError, match="unknown ranking 'pnsr': did you mean 'psnr'"):
        metrics.rank(Lambertian(), [GGX()], by="pnsr")


@pytest.mark.parametrize("by", metrics.RANKINGS)
def test_every_ranking_puts_the_same_reflectance_first(by: str) -> None:
    others = [Lambertian(albedo=a).named(str(a)) for a in (0.9, 0.5, 0.45)]
    assert [c.other for c in metrics.rank(Lambertian(albedo=0.5), others, size=16, by=by)] == ["0.5", "0.45", "0.9"]
