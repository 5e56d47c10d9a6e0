"""Directional albedo by quadrature against closed forms and sampling."""

from __future__ import annotations

import math

import numpy as np
import pytest

from brdf import metrics
from brdf.models import GGX, Lambertian, Mirror, SmoothConductor


@pytest.mark.parametrize("angle", metrics.ALBEDO_ANGLES)
def test_directional_albedo_of_a_diffuser(angle):
    np.testing.assert_allclose(
        metrics.directional_albedo(Lambertian(albedo=(0.2, 0.5, 0.9)), angle), [0.2, 0.5, 0.9], rtol=0.01
    )


def test_directional_albedo_of_a_lobe_agrees_with_sampling():
    m = GGX(alpha=0.2, F0=1.0)
    wo = [math.sin(math.radians(60)), 0, 0.5]
    np.testing.assert_allclose(metrics.directional_albedo(m, 60.0), m.albedo(wo, samples=16384), atol=0.005)


def test_mirrors_reflect_what_their_delta_says():
    np.testing.assert_allclose(metrics.directional_albedo(Mirror(), 60.0), Mirror().albedo([math.sqrt(0.75), 0, 0.5]))
    metal = SmoothConductor(eta=(0.2, 0.9, 1.1), k=(3.9, 2.4, 2.1))
    # normal incidence: ((eta - 1)^2 + k^2) / ((eta + 1)^2 + k^2)
    eta, k = np.array([0.2, 0.9, 1.1]), np.array([3.9, 2.4, 2.1])
    expected = ((eta - 1) ** 2 + k**2) / ((eta + 1) ** 2 + k**2)
    np.testing.assert_allclose(metrics.directional_albedo(metal, 0.0), expected, rtol=1e-9)
    both = Lambertian(albedo=0.25) + 0.5 * Mirror()
    assert metrics.directional_albedo(both, 30.0)[1] == pytest.approx(
        0.25 + 0.5 * Mirror().albedo([0, 0, 1])[1], rel=0.01
    )
