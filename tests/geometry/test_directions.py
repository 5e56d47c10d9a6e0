"""Directions: reference values, round trips to rounding, agreement with other formulas."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from brdf.geometry import directions as d

RNG = np.random.default_rng(4)
W = d.cosine_weighted(RNG.random((2000, 2)))
V = d.uniform_hemisphere(RNG.random((2000, 2)))


def test_half_and_difference_angles_of_the_reference() -> None:
    wi, wo = d.from_spherical(np.pi / 6, 0.0), d.from_spherical(np.pi / 3, np.pi / 2)
    angles = d.to_half_difference(wi, wo)
    assert angles.theta_h == pytest.approx(0.63191431, abs=1e-8)
    assert angles.theta_d == pytest.approx(0.56148196, abs=1e-8)
    folded = np.arccos(abs(np.cos(angles.phi_d)))
    assert folded == pytest.approx(0.94973129, abs=1e-8)


def test_difference_angles_follow_from_turning_the_half_vector_to_the_normal() -> None:
    angles = d.to_half_difference(W, V)
    about_z = d.rotated(W, -angles.phi_h)
    c, s = np.cos(angles.theta_h), np.sin(angles.theta_h)
    turned = np.stack([c * about_z[:, 0] - s * about_z[:, 2], about_z[:, 1], s * about_z[:, 0] + c * about_z[:, 2]], -1)
    theta_d, phi_d = d.to_spherical(turned)
    np.testing.assert_allclose(angles.theta_d, theta_d, atol=1e-12)
    np.testing.assert_allclose(np.cos(angles.phi_d - phi_d), 1, atol=1e-12)


def test_half_difference_round_trip() -> None:
    wi, wo = d.from_half_difference(*d.to_half_difference(W, V))
    np.testing.assert_allclose(wi, W, atol=1e-12)
    np.testing.assert_allclose(wo, V, atol=1e-12)


@pytest.mark.parametrize("tilt", [0.0, 1e-12, 1e-7, 1e-3, 1.5])
def test_small_angles_keep_their_digits(tilt: float) -> None:
    w = d.from_spherical(tilt, 0.4)
    assert d.to_spherical(w)[0] == pytest.approx(tilt, rel=1e-12)
    assert d.angle_between(w, [0.0, 0.0, 1.0]) == pytest.approx(tilt, rel=1e-9, abs=1e-20)
    angles = d.to_half_difference(d.from_spherical(tilt, 0.0), d.from_spherical(tilt, np.pi))
    assert angles.theta_d == pytest.approx(tilt, rel=1e-12)


def test_mirror_and_retroreflection() -> None:
    mirrored = V * [-1, -1, 1]
    angles = d.to_half_difference(V, mirrored)
    np.testing.assert_allclose(angles.theta_h, 0, atol=1e-15)
    np.testing.assert_allclose(angles.theta_d, d.to_spherical(V)[0], atol=1e-12)
    retro = d.to_half_difference(V, V)
    np.testing.assert_allclose(retro.theta_d, 0, atol=1e-15)
    np.testing.assert_allclose(retro.theta_h, d.to_spherical(V)[0], atol=1e-12)


def test_spherical_round_trip() -> None:
    theta, phi = RNG.uniform(0, np.pi, 500), RNG.uniform(-np.pi, np.pi, 500)
    for given, found in zip((theta, phi), d.to_spherical(d.from_spherical(theta, phi)), strict=True):
        np.testing.assert_allclose(found, given, atol=1e-12)


def test_reflection_is_about_the_half_vector() -> None:
    np.testing.assert_allclose(d.reflected(V, d.half_vector(W, V)), W, atol=1e-12)


def test_frames_are_right_handed_on_the_whole_sphere() -> None:
    n = np.concatenate([W, -V, np.eye(3), -np.eye(3)])
    tangent, bitangent = d.frame(n)
    np.testing.assert_allclose(np.cross(tangent, bitangent), n, atol=1e-12)
    np.testing.assert_allclose(d.dot(tangent, bitangent), 0, atol=1e-12)
    np.testing.assert_allclose(d.dot(tangent, tangent), 1, atol=1e-12)
    np.testing.assert_array_equal(d.frame([0.0, 0.0, 1.0]), [[1, 0, 0], [0, 1, 0]])


def test_normalized_keeps_the_zero_vector() -> None:
    np.testing.assert_array_equal(d.normalized([[0, 0, 0], [0, 3, 4]]), [[0, 0, 0], [0, 0.6, 0.8]])


@pytest.mark.parametrize(("draw", "moment"), [(d.cosine_weighted, 2 / 3), (d.uniform_hemisphere, 1 / 2)])
def test_distributions_have_their_mean_cosine(draw: Any, moment: float) -> None:
    w = draw(RNG.random((100_000, 2)))
    np.testing.assert_allclose(np.linalg.norm(w, axis=-1), 1, atol=1e-12)
    np.testing.assert_allclose(w.mean(0), [0, 0, moment], atol=0.006)  # 4 standard errors of x and y


def test_float32_stays() -> None:
    w, v = W.astype(np.float32), V.astype(np.float32)
    u = RNG.random((5, 2)).astype(np.float32)
    made = [*d.to_half_difference(w, v), *d.to_spherical(w), *d.frame(w), d.half_vector(w, v), d.angle_between(w, v)]
    made += [d.rotated(w, np.float32(0.3)), d.cosine_weighted(u), d.uniform_hemisphere(u), d.normalized(w)]
    made += d.from_half_difference(*d.to_half_difference(w, v))
    assert {array.dtype for array in made} == {np.dtype(np.float32)}
