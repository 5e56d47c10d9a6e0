"""Any reflectance on adaptive grids: close to it, exact at the nodes, the same in Mitsuba, never of an absent lobe."""

from __future__ import annotations

import numpy as np
import pytest
from tests.helpers import random_directions
from tests.representations.test_adaptive import mitsuba_value

import brdf
from brdf import io
from brdf.errors import ReflectanceError
from brdf.geometry.directions import from_spherical
from brdf.models import GGX, Lambertian
from brdf.representations.baking.adaptive_grid import Sizes, bake_adaptive
from brdf.representations.scattered import Scattered

PLASTIC = Lambertian(albedo=(0.1, 0.2, 0.3)) + GGX(alpha=0.1)
SMALL = Sizes(9, 8, (32, 48), 16)


@pytest.fixture(scope="module")
def plastic():
    return bake_adaptive(PLASTIC)


def test_values_at_incident_nodes(plastic):
    """In the plane of incidence through the highlight, at an incident angle of the grid and between them."""
    for theta_i, tolerance in ((float(plastic.theta_i[12]), 0.05), (0.7, 0.05), (1.3, 0.12)):
        wi = from_spherical(theta_i, 0.3)
        wo = from_spherical(theta_i + np.linspace(-0.2, min(0.2, 1.5 - theta_i), 21), 0.3 + np.pi)
        np.testing.assert_allclose(plastic(wi, wo), PLASTIC(wi, wo), rtol=tolerance)


def test_pictures(plastic):
    """51 dB and more with light from the front; the last degrees before grazing angles are coarse."""
    compared = brdf.compare(PLASTIC, plastic)
    assert compared.psnr_mean > 50
    assert min(compared.psnr_by_angle[:24]) > 45


def test_a_lambertian_surface():
    m = bake_adaptive(Lambertian(albedo=0.5))
    wi, wo = random_directions(3000, 1, 0.2), random_directions(3000, 2, 0.2)
    error = np.abs(m(wi, wo)[:, 0] / (0.5 / np.pi) - 1)
    assert np.median(error) < 0.003
    assert np.quantile(error, 0.98) < 0.05


def test_anisotropic(tmp_path):
    model = GGX(alpha_x=0.2, alpha_y=0.5, F0=0.8) + Lambertian(albedo=0.1)
    m = bake_adaptive(model, SMALL)
    assert not m.isotropic
    wi, wo = random_directions(4000, 3, 0.2), random_directions(4000, 4, 0.2)
    error = np.abs(m(wi, wo) - model(wi, wo)).mean() / model(wi, wo).mean()
    assert error < 0.1
    turned = np.abs(m(wi[:, [1, 0, 2]], wo[:, [1, 0, 2]]) - model(wi, wo)).mean() / model(wi, wo).mean()
    assert turned > 5 * error


@pytest.mark.parametrize("model", [PLASTIC, GGX(alpha_x=0.2, alpha_y=0.5)], ids=["isotropic", "anisotropic"])
def test_mitsuba_reads_the_same(model, tmp_path):
    io.write(bake_adaptive(model, None if model.isotropic else SMALL), tmp_path / "m.bsdf")
    m = io.read(tmp_path / "m.bsdf")
    wi, wo = random_directions(300, 5, 0.05), random_directions(300, 6, 0.05)
    value, density = mitsuba_value(tmp_path / "m.bsdf", "scalar_rgb", wi, wo)
    np.testing.assert_allclose(value, m(wi, wo), rtol=2e-3, atol=2e-4)
    assert value.min() >= 0
    assert np.isfinite(density).all()
    assert density.min() > 0


def test_spectra_survive(tmp_path):
    nm = np.array([450.0, 550, 650])
    wi, wo = random_directions(600, 7, 0.1), random_directions(600, 8, 0.1)
    measured = Scattered.from_samples(wi, wo, np.outer(1 + (wi + wo)[:, 2], [1, 2, 3]), nm)
    io.write(measured, tmp_path / "m.bsdf")
    m = io.read(tmp_path / "m.bsdf")
    np.testing.assert_array_equal(m.wavelengths, nm)
    error = np.abs(m.spectrum(wi, wo) - measured.spectrum(wi, wo)) / measured.spectrum(wi, wo)
    assert np.median(error) < 0.02


def test_a_measurement_is_written_as_it_is(data, tmp_path):
    m = io.read(data / "rgl" / "irid_flake_paint1_rgb.bsdf")
    io.write(m, tmp_path / "m.bsdf")
    np.testing.assert_array_equal(io.read(tmp_path / "m.bsdf").tensors["rgb"], m.tensors["rgb"])


def test_what_cannot_be_tabulated():
    with pytest.raises(ReflectanceError, match="mirrors like a polished surface"):
        bake_adaptive(brdf.models.SmoothConductor())
