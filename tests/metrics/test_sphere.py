"""Pictures of a sphere and their distances, against cases computed by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest

from brdf import metrics
from brdf.color import ciede2000, rgb_to_lab
from brdf.errors import ParameterError
from brdf.models import GGX, Lambertian


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


def test_refuses_a_picture_without_pixels():
    with pytest.raises(ParameterError, match="at least 2"):
        metrics.psnr(Lambertian(), Lambertian(), size=1)


def test_lights_say_which_picture_a_pixel_is_of():
    wi, wo = (w.astype(float) for w in metrics.sphere_pairs(48))
    lights = metrics.sphere_lights(48)
    angles = np.degrees(np.arccos(np.clip(np.einsum("ij,ij->i", wi, wo), -1, 1)))
    np.testing.assert_allclose(angles, np.array(metrics.LIGHT_ANGLES)[lights], atol=0.05)


def test_psnr_of_each_light():
    # constant differences: light 0 differs by sRGB 1, light 1 by nothing, light 2 has no pixel, light 3 by sRGB 1/2
    linear_of_half = ((0.5 + 0.055) / 1.055) ** 2.4
    lights = np.array([0, 0, 1, 3])
    reference, other = np.ones((4, 3)), np.ones((4, 3))
    other[:2], other[3] = 0.0, linear_of_half
    found = metrics.psnr_by_light(reference, other, lights, 4)
    np.testing.assert_allclose(found, [0, math.inf, math.inf, 20 * math.log10(2)], atol=1e-9)


def test_psnr_by_angle_pools_to_the_psnr_of_all_pixels():
    a, b = Lambertian(albedo=0.8), GGX(alpha=0.4)
    by_angle = metrics.psnr_by_angle(a, b, 40)
    pixels = np.bincount(metrics.sphere_lights(40), minlength=len(by_angle))
    pooled = -10 * np.log10(np.sum(pixels * 10 ** (-by_angle / 10)) / pixels.sum())
    assert by_angle.shape == (len(metrics.LIGHT_ANGLES),)
    assert pooled == pytest.approx(metrics.psnr(a, b, 40), abs=1e-4)


def test_a_light_that_lights_no_pixel_counts_as_without_difference():
    assert metrics.psnr_by_angle(Lambertian(albedo=0.8), Lambertian(albedo=0.3), 2)[-1] == math.inf


def test_delta_e_of_constant_colours():
    red, grey = np.full((10, 3), (0.7, 0.1, 0.1)), np.full((10, 3), 0.2)
    one = float(ciede2000(rgb_to_lab(red[0]), rgb_to_lab(grey[0])))
    assert metrics.delta_e_of(red, grey) == pytest.approx((one, one))
    other = np.concatenate([red[:1], grey[1:]])
    found = metrics.delta_e_of(grey, other)
    assert found.mean == pytest.approx(one / 10)
    assert found.p95 == pytest.approx(0.55 * one)  # linear between the ranks: 0.95 * 9 = 8.55


def test_delta_e_clamps_to_white():
    assert metrics.delta_e_of(np.full((3, 3), 4.0), np.full((3, 3), 9.0)) == (0, 0)


def test_delta_e_of_grey_spheres_is_a_difference_of_lightness():
    found = metrics.delta_e(Lambertian(albedo=0.2), Lambertian(albedo=0.5), 24)
    cos = metrics.sphere_pairs(24)[0][:, 2].astype(float)

    def lightness(y):
        return np.where(y > (6 / 29) ** 3, 116 * np.cbrt(y) - 16, y * 24389 / 27)

    low, high = lightness(0.2 * cos), lightness(0.5 * cos)
    off = ((low + high) / 2 - 50) ** 2
    expected = (high - low) / (1 + 0.015 * off / np.sqrt(20 + off))
    assert found == pytest.approx((expected.mean(), np.percentile(expected, 95)), rel=1e-4)
