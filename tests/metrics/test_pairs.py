"""Errors over pairs of directions, against cases computed by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest

from brdf import metrics
from brdf.errors import ParameterError
from brdf.geometry.directions import to_half_difference
from brdf.models import GGX, Lambertian


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


def test_error_map_of_diffusers_of_which_one_is_brighter():
    # f cos >> 1e-3 / sr: |ln 2|; towards grazing light less, since 1e-3 counts then
    found = metrics.error_map(Lambertian(albedo=0.8), Lambertian(albedo=0.4), 24)
    assert found.shape == (24, 24)
    assert found[0, 0] == pytest.approx(math.log(2), rel=0.01)
    assert (found < math.log(2)).all()
    assert found[-1, -1] < found[-1, 0] < found[0, 0]
    np.testing.assert_array_equal(metrics.error_map(GGX(), GGX(), 8), 0)


def test_error_map_puts_theta_d_on_rows_and_the_square_of_theta_h_on_columns():
    class Seen:
        """Keeps the directions it is asked for."""

        def f_cos(self, wi, wo):
            self.pair = wi, wo
            return np.ones(wi.shape)

    m = Seen()
    metrics.error_map(m, Lambertian(albedo=0.5), 10, 8)
    wi, wo = m.pair
    assert min(wi[..., 2].min(), wo[..., 2].min()) > 0  # every one of the azimuths is above the horizon
    theta_h, phi_h, theta_d, phi_d = to_half_difference(wi, wo)
    nodes = (np.arange(10) + 0.5) / 10
    np.testing.assert_allclose(theta_d, np.broadcast_to(nodes[:, None, None] * math.pi / 2, (10, 10, 8)), atol=1e-9)
    np.testing.assert_allclose(theta_h, np.broadcast_to(nodes[:, None] ** 2 * math.pi / 2, (10, 10, 8)), atol=1e-9)
    assert np.unique(phi_h[4, 4].round(6)).size == 8
    assert np.unique(phi_d[4, 4].round(6)).size == 8


@pytest.mark.parametrize("arguments", [(0, 4), (4, 0)])
def test_an_error_map_without_cells_is_refused(arguments):
    with pytest.raises(ParameterError, match="at least one cell"):
        metrics.error_map(GGX(), GGX(), *arguments)
