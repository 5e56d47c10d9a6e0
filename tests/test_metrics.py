"""Metrics against cases computed by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest

from brdf import metrics
from brdf.errors import ParameterError
from brdf.models import GGX, Lambertian


def test_identical_reflectances_agree_perfectly():
    m = GGX(alpha=0.3)
    comparison = metrics.compare(m, GGX(alpha=0.3), size=24)
    assert comparison.psnr == math.inf
    assert comparison.relative_rmse == 0
    assert comparison.albedo_difference == 0
    assert set(comparison.metrics.values()) == {0.0}


def test_psnr_of_a_constant_difference():
    a, b = np.full((7, 3), 1.0), np.full((7, 3), 0.0)
    assert metrics.psnr_of(a, b) == pytest.approx(0.0, abs=1e-12)  # sRGB 1 against 0: mean square 1
    linear_of_half = ((0.5 + 0.055) / 1.055) ** 2.4
    assert metrics.psnr_of(a, np.full((7, 3), linear_of_half)) == pytest.approx(20 * math.log10(2), abs=1e-9)


def test_psnr_clamps_and_relative_rmse_does_not():
    a, b = np.full((4, 3), 3.0), np.full((4, 3), 6.0)
    assert metrics.psnr_of(a, b) == math.inf
    assert metrics.relative_rmse_of(a, b) == 1.0


def test_relative_rmse_of_black():
    black = np.zeros((2, 3))
    assert metrics.relative_rmse_of(black, black) == 0
    assert metrics.relative_rmse_of(black, black + 1) == math.inf


def test_relative_rmse_of_lambertian_spheres_is_the_ratio():
    assert metrics.relative_rmse(Lambertian(albedo=0.5), Lambertian(albedo=0.4), 16) == pytest.approx(0.2, abs=1e-6)


def test_white_diffuse_sphere_shows_the_cosine():
    wi, _ = metrics.sphere_pairs(16)
    radiance = metrics.sphere_radiance(Lambertian(albedo=1.0), 16)
    np.testing.assert_allclose(radiance, np.repeat(wi[:, 2:], 3, axis=1), rtol=1e-6)


def test_sphere_pairs_are_the_lit_pixels():
    size = 64
    wi, wo = metrics.sphere_pairs(size)
    assert wi[:, 2].min() > 0
    assert wo[:, 2].min() > 0
    np.testing.assert_allclose(np.linalg.norm(wi, axis=1), 1, atol=1e-6)
    # the lit part of the disc at light angle phi has the area pi (1 + cos phi) / 2
    share = np.mean([(1 + math.cos(math.radians(a))) / 2 for a in metrics.LIGHT_ANGLES])
    assert len(wi) == pytest.approx(share * 36 * math.pi / 4 * size**2, rel=0.01)
    # light and viewer keep their angle whatever the normal
    angles = np.degrees(np.arccos(np.clip(np.einsum("ij,ij->i", wi.astype(float), wo), -1, 1)))
    assert np.abs(angles / 5 - np.rint(angles / 5)).max() < 0.01


def test_sphere_pairs_make_one_frame_for_light_and_viewer():
    # mirroring the viewer about the normal gives the light exactly where n is the half vector
    wi, wo = (w.astype(float) for w in metrics.sphere_pairs(64, (60.0,)))
    h = (wi + wo) / np.linalg.norm(wi + wo, axis=1, keepdims=True)
    at_peak = h[:, 2] > 0.9995
    assert at_peak.any()
    np.testing.assert_allclose(wi[at_peak, :2], -wo[at_peak, :2], atol=0.08)


def test_direction_pairs_have_the_measure_of_two_hemispheres():
    wi, wo, weight = metrics.direction_pairs()
    assert weight.sum() == pytest.approx(1)
    # uniform over both hemispheres: E[cos] = 1/2, E[cos^2] = 1/3, E[cos_i cos_o] = 1/4, no mean azimuth
    assert weight @ wi[:, 2] == pytest.approx(1 / 2, rel=0.01)
    assert weight @ wo[:, 2] == pytest.approx(1 / 2, rel=0.01)
    assert weight @ wi[:, 2] ** 2 == pytest.approx(1 / 3, rel=0.01)
    assert weight @ (wi[:, 2] * wo[:, 2]) == pytest.approx(1 / 4, rel=0.01)
    np.testing.assert_allclose(weight @ wi[:, :2], 0, atol=0.005)


def test_direction_metrics_of_two_diffusers():
    found = metrics.direction_metrics(Lambertian(albedo=0.8), Lambertian(albedo=0.3))
    # with cos uniform in [0, 1]: E[cos^2] = 1/3 and E[cos^(2/3)] = 3/5
    assert found["cosine-weighted L2"] == pytest.approx(0.5 / math.pi * math.sqrt(1 / 3), rel=0.01)
    roots = np.cbrt(0.8 / math.pi) - np.cbrt(0.3 / math.pi)
    assert found["cube root"] == pytest.approx(roots * math.sqrt(3 / 5), rel=0.01)
    cos = (np.arange(10000) + 0.5) / 10000
    a, b = 0.8 / math.pi * cos, 0.3 / math.pi * cos
    assert found["log"] == pytest.approx(np.sqrt(np.mean(np.log((1 + a) / (1 + b)) ** 2)), rel=0.01)
    assert found["log relative"] == pytest.approx(np.mean(np.log((a + 1e-3) / (b + 1e-3))), rel=0.01)


@pytest.mark.parametrize("angle", metrics.ALBEDO_ANGLES)
def test_directional_albedo_of_a_diffuser(angle):
    np.testing.assert_allclose(
        metrics.directional_albedo(Lambertian(albedo=(0.2, 0.5, 0.9)), angle), [0.2, 0.5, 0.9], rtol=0.01
    )


def test_directional_albedo_of_a_lobe_agrees_with_sampling():
    m = GGX(alpha=0.2, F0=1.0)
    wo = [math.sin(math.radians(60)), 0, 0.5]
    np.testing.assert_allclose(metrics.directional_albedo(m, 60.0), m.albedo(wo, samples=16384), atol=0.005)


def test_comparison_prints_every_number():
    comparison = metrics.compare(Lambertian(albedo=0.8).named("a"), Lambertian(albedo=0.3).named("b"), size=16)
    text = comparison.table()
    assert text.startswith("a -> b\n")
    for name in ("PSNR", "relative RMSE", "albedo difference", "bytes", *metrics.METRICS):
        assert name in text
    assert comparison.albedo_difference == pytest.approx(0.5, rel=0.01)
    assert comparison.bytes == (12, 12)


def test_refuses_a_picture_without_pixels():
    with pytest.raises(ParameterError, match="at least 2"):
        metrics.psnr(Lambertian(), Lambertian(), size=1)
