"""Scattered measurements: close to the data, symmetric, bounded away from it, one colour in every path."""

from __future__ import annotations

import numpy as np
import pytest
from tests.helpers import random_directions

from brdf import color, io
from brdf.geometry.directions import from_spherical
from brdf.io import gonio
from brdf.representations.scattered import Scattered

WAVELENGTHS = np.linspace(400, 700, 7)
PAINTS = {"garnet_red": (0.01, 0.03), "acryl_blue": (0.01, 0.13), "mystique": (0.02, 0.3)}
"""Bounds of the median error at the data and at rows held out."""


def lobe(wi, wo):
    """A diffuse and a glossy part, exactly isotropic and reciprocal, (N, 7)."""
    h = (wi + wo) / np.linalg.norm(wi + wo, axis=-1, keepdims=True)
    diffuse = np.linspace(0.05, 0.3, 7)
    return diffuse + np.exp(-(1 - h[:, 2:]) / 0.05)


def measured(data, paint):
    nm, angles, values = gonio.read_rows(data / "gonio" / "cornell" / f"{paint}.brdf")
    return from_spherical(angles[:, 0], angles[:, 1]), from_spherical(angles[:, 2], angles[:, 3]), values, nm


@pytest.fixture(scope="module")
def made():
    wi, wo = random_directions(1500, 1, 0.1), random_directions(1500, 2, 0.1)
    return Scattered.from_samples(wi, wo, lobe(wi, wo), WAVELENGTHS)


def median_error(m, wi, wo, values):
    return np.median(np.abs(m.spectrum(wi, wo) - values).mean(1) / values.mean(1))


def test_follows_a_smooth_reflectance(made):
    wi, wo = random_directions(2000, 3, 0.2), random_directions(2000, 4, 0.2)
    assert median_error(made, wi, wo, lobe(wi, wo)) < 0.03


@pytest.mark.parametrize("paint", PAINTS)
def test_measured_paints(data, paint):
    wi, wo, values, nm = measured(data, paint)
    at_data, held_out = PAINTS[paint]
    assert median_error(io.read(data / "gonio" / "cornell" / f"{paint}.brdf"), wi, wo, values) < at_data
    is_held = np.random.default_rng(0).random(len(values)) < 0.1
    rest = Scattered.from_samples(wi[~is_held], wo[~is_held], values[~is_held], nm)
    assert median_error(rest, wi[is_held], wo[is_held], values[is_held]) < held_out


@pytest.mark.parametrize("paint", PAINTS)
def test_never_beyond_the_data(data, paint):
    wi, wo, values, nm = measured(data, paint)
    m = Scattered.from_samples(wi, wo, values, nm)
    found = m.spectrum(random_directions(20_000, 5), random_directions(20_000, 6))
    assert found.min() >= 0
    assert np.all(found.max(0) <= values.max(0) * (1 + 1e-5))


def test_symmetries(made):
    wi, wo = random_directions(500, 7), random_directions(500, 8)
    value, mirror = made(wi, wo), np.array([1.0, -1.0, 1.0])
    np.testing.assert_allclose(made(wo, wi), value, rtol=1e-9)
    np.testing.assert_allclose(made(wi * mirror, wo * mirror), value, rtol=1e-9)


def test_rgb_is_the_colour_of_the_spectrum(made):
    wi, wo = random_directions(500, 7), random_directions(500, 8)
    np.testing.assert_allclose(
        made.raw(wi, wo), color.spectrum_to_rgb(made.spectrum(wi, wo), WAVELENGTHS), rtol=1e-4, atol=1e-6
    )


def test_defined_where_coordinates_degenerate(made):
    z, grazing = np.array([0, 0, 1.0]), from_spherical(np.pi / 2 - 1e-6, 0.3)
    for wi, wo in [(z, z), (grazing, grazing), (grazing, grazing * [-1, -1, 1])]:
        assert np.isfinite(made(wi, wo)).all()
    np.testing.assert_array_equal(made.spectrum(-z, z), 0)


def test_reciprocal_duplicates_and_black_samples():
    wi, wo = random_directions(50, 1, 0.1), random_directions(50, 2, 0.1)
    values = np.zeros((100, 7))
    m = Scattered.from_samples(np.concatenate([wi, wo]), np.concatenate([wo, wi]), values, WAVELENGTHS)
    np.testing.assert_array_equal(m.spectrum(wi, wo), 0)


def test_storage_round_trip(made, tmp_path):
    made.save(tmp_path / "m.safetensors")
    read = io.read(tmp_path / "m.safetensors")
    wi, wo = random_directions(100, 7), random_directions(100, 8)
    np.testing.assert_array_equal(read(wi, wo), made(wi, wo))
    np.testing.assert_array_equal(read.wavelengths, WAVELENGTHS)


@pytest.mark.parametrize(
    ("spectra", "said"),
    [(np.ones((2, 2, 2, 3)), "must be"), (np.full((2, 2, 2, 7), -1.0), "not below zero"), (np.ones((2, 7)), "must be")],
)
def test_refuses_broken_grids(spectra, said):
    with pytest.raises(ValueError, match=said):
        Scattered(spectra, WAVELENGTHS)
