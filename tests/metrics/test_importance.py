"""Errors at importance pairs: the weights against closed forms, the errors against themselves."""

from __future__ import annotations

import math

import numpy as np
import pytest

import brdf
from brdf.errors import ParameterError
from brdf.metrics import importance_errors, importance_pairs
from brdf.metrics.importance import LEAST_COSINE, ErrorsAgainst, display_rms, relative_rms
from brdf.models import GGX, Lafortune, Lambertian

LOW = LEAST_COSINE
"""The measure, d wi cos_o d wo over cosines above this, has simple moments."""

MOMENTS = [
    (lambda wi, wo: wi[:, 2], (1 + LOW) / 2, "cos_i, uniform"),
    (lambda wi, wo: wi[:, 2] ** 2, (1 - LOW**3) / 3 / (1 - LOW), "cos_i^2"),
    (lambda wi, wo: wo[:, 2], 2 / 3 * (1 - LOW**3) / (1 - LOW**2), "cos_o, cosine-weighted"),
    (lambda wi, wo: wi[:, 0] * wo[:, 0], 0.0, "azimuths are independent"),
    (lambda wi, wo: (wi[:, 0] * wo[:, 0] + wi[:, 1] * wo[:, 1]) ** 2,
     (1 - (1 - LOW**3) / 3 / (1 - LOW)) * (1 - (1 - LOW**4) / 2 / (1 - LOW**2)) / 2, "sin^2 sin^2 / 2"),
]  # fmt: skip


@pytest.mark.parametrize(("function", "expected"), [m[:2] for m in MOMENTS], ids=[m[2] for m in MOMENTS])
def test_weights_undo_the_crowding(function, expected):
    wi, wo, weight = importance_pairs(1 << 17, 3)
    values = function(wi, wo)
    mean = weight @ values
    deviation = math.sqrt(np.sum((weight * (values - mean)) ** 2))
    assert abs(mean - expected) < 4 * deviation
    assert deviation < 0.006


@pytest.mark.parametrize("alpha", [0.01, 0.1])
def test_narrow_lobes_are_resolved(alpha):
    """The mean of f cos_i is the mean albedo over 2 pi, known from the model's own sampler."""
    m = GGX(alpha=alpha, F0=1.0)
    wi, wo, weight = importance_pairs(1 << 16, 5)
    found = 2 * math.pi * (1 - LOW) * float(weight @ m.f_cos(wi, wo)[:, 0])
    mu = np.sqrt(np.linspace(LOW**2, 1, 65)[:-1] + (1 - LOW**2) / 128)
    views = np.stack([np.sqrt(1 - mu * mu), 0 * mu, mu], -1)
    assert found == pytest.approx(float(np.mean(m.albedo(views, 4096)[:, 0])), rel=0.03)


def test_pairs_follow_from_the_seed():
    assert np.array_equal(importance_pairs(100, 1).wi, importance_pairs.__wrapped__(100, 1).wi)
    assert not np.array_equal(importance_pairs(100, 1).wi, importance_pairs(100, 2).wi)
    wi, wo, weight = importance_pairs(1000, 1)
    assert min(wi[:, 2].min(), wo[:, 2].min()) > LOW
    np.testing.assert_allclose(np.linalg.norm(wi, axis=1), 1, atol=1e-12)
    assert weight.sum() == pytest.approx(1)


def test_a_scaled_reflectance_is_off_by_the_scale():
    m = Lambertian(albedo=0.5) + Lafortune(ks=0.2, Cxy=1.0)
    errors = importance_errors(m, 1.1 * m)
    assert errors.relative_rms == pytest.approx(0.1)
    assert importance_errors(m, m) == (0, 0)


def test_display_error_of_two_diffusers():
    """(0.25 cos)^(1/2.2) - (0.16 cos)^(1/2.2) squared, cosines uniform."""
    pairs = importance_pairs(1 << 16, 2)
    against = ErrorsAgainst(Lambertian(albedo=0.25), pairs)
    g = 2 / 2.2
    moment = (1 - LOW ** (g + 1)) / (g + 1) / (1 - LOW)
    expected = (0.25 ** (1 / 2.2) - 0.16 ** (1 / 2.2)) * math.sqrt(moment)
    assert against(Lambertian(albedo=0.16)).display_rms == pytest.approx(expected, rel=0.01)


def test_what_is_brighter_than_white_shows_no_error():
    weight = np.full(4, 0.25)
    bright = np.full((4, 3), 2.0)
    assert display_rms(bright, 2 * bright, weight) == 0
    assert relative_rms(bright, 2 * bright, weight) == 1
    assert relative_rms(0 * bright, bright, weight) == math.inf


def test_no_pairs_are_refused():
    with pytest.raises(ParameterError, match="at least one pair"):
        importance_pairs(0)
    assert "importance_errors" in brdf.metrics.__all__
