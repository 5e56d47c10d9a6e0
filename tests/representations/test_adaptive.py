"""Adaptive measurements: agreement with Mitsuba, the sampler against its density, storage."""

from __future__ import annotations

import csv

import numpy as np
import pytest
from tests.helpers import random_directions
from tests.representations.synthetic_rgl import tensors

import brdf
from brdf import color, io
from brdf.errors import ReflectanceError
from brdf.geometry.directions import from_spherical
from brdf.io import rgl
from brdf.representations.adaptive import Adaptive, AdaptiveSampler

KINDS = {
    "isotropic": {"azimuths": 1},
    "whole circle": {"azimuths": 9},
    "half circle": {"azimuths": 6, "share": 0.5},
    "quarter circle": {"azimuths": 5, "share": 0.25},
}


def pairs(count=200, seed=5, least_cosine=0.03):
    return random_directions(count, seed, least_cosine), random_directions(count, seed + 1, least_cosine)


def reference_rows(data):
    with (data / "rgl" / "rgl_reference_eval.csv").open() as file:
        for row in csv.DictReader(file):
            numbers = [float(v) for k, v in row.items() if k != "file"]
            yield row["file"], numbers


def test_published_files_agree_with_mitsuba(data):
    """The angles of the reference are rounded to six digits, which explains what is left of the difference."""
    by_file = {}
    for name, numbers in reference_rows(data):
        by_file.setdefault(name, []).append(numbers)
    assert len(by_file) == 10
    errors = []
    for name, rows in by_file.items():
        table = np.array(rows)
        angles, value = np.radians(table[:, :4]), table[:, 4:]
        m = io.read(data / "rgl" / name)
        found = m.raw(from_spherical(angles[:, 0], angles[:, 1]), from_spherical(angles[:, 2], angles[:, 3]))
        errors.append(np.abs(found - value).max(1) / np.abs(value).max(1))
    errors = np.concatenate(errors)
    assert np.median(errors) < 1e-5
    assert np.quantile(errors, 0.99) < 1e-4


def test_negative_values_are_clamped_by_the_call_alone(data):
    m = io.read(data / "rgl" / "cc_green_malachite_rgb.bsdf")
    wi, wo = pairs(5000)
    raw = m.raw(wi, wo)
    assert (raw < 0).any()
    np.testing.assert_array_equal(m(wi, wo), np.maximum(raw, 0))


def mitsuba_value(path, variant, wi, wo, wavelengths=None):
    mi = pytest.importorskip("mitsuba")
    mi.set_variant(variant)
    bsdf = mi.load_dict({"type": "measured", "filename": str(path)})
    values, densities = [], []
    for a, b in zip(wi, wo, strict=True):
        interaction = mi.SurfaceInteraction3f()
        interaction.wi = mi.Vector3f(*a.tolist())
        if wavelengths is not None:
            interaction.wavelengths = wavelengths
        direction = mi.Vector3f(*b.tolist())
        values.append(np.array(bsdf.eval(mi.BSDFContext(), interaction, direction)).ravel() / b[2])
        densities.append(bsdf.pdf(mi.BSDFContext(), interaction, direction))
    return np.array(values), np.array(densities)


@pytest.mark.parametrize("kind", KINDS)
def test_values_and_density_agree_with_mitsuba(tmp_path, kind):
    path = tmp_path / "m.bsdf"
    rgl.write_tensors(tensors(**KINDS[kind]), path)
    m, (wi, wo) = io.read(path), pairs()
    value, density = mitsuba_value(path, "scalar_rgb", wi, wo)
    np.testing.assert_allclose(m.raw(wi, wo), value, rtol=2e-4)
    found = AdaptiveSampler(m._model, m._settings).pdf(wo, wi)  # ours draws `wi` with `wo` in the incident place
    np.testing.assert_allclose(found, density, rtol=2e-4, atol=1e-6)


@pytest.mark.parametrize("jacobian", [0, 1])
def test_spectra_agree_with_mitsuba(tmp_path, jacobian):
    path = tmp_path / "m.bsdf"
    rgl.write_tensors(tensors(azimuths=5, wavelengths=7) | {"jacobian": np.array([jacobian], np.uint8)}, path)
    m, (wi, wo) = io.read(path), pairs()
    value, _ = mitsuba_value(path, "scalar_spectral", wi, wo, wavelengths=[400, 450, 500, 700])
    np.testing.assert_allclose(m.spectrum(wi, wo)[:, [0, 1, 2, 6]], value, rtol=2e-4)


def test_rgb_is_the_colour_of_the_spectrum():
    m, (wi, wo) = Adaptive(tensors(wavelengths=16)), pairs()
    expected = color.spectrum_to_rgb(m.spectrum(wi, wo), m.wavelengths)
    np.testing.assert_allclose(m.raw(wi, wo), expected, rtol=1e-5)


def test_rgb_files_have_no_spectrum():
    with pytest.raises(ReflectanceError, match="holds RGB only"):
        Adaptive(tensors()).spectrum([0, 0, 1.0], [0, 0, 1.0])


def test_isotropy():
    wi, wo = pairs()
    turn = np.array([[0.6, -0.8, 0], [0.8, 0.6, 0], [0, 0, 1]])
    m = Adaptive(tensors())
    assert m.isotropic
    np.testing.assert_allclose(m(wi @ turn.T, wo @ turn.T), m(wi, wo), rtol=1e-9)
    assert not Adaptive(tensors(azimuths=9)).isotropic


def in_half_vector_cells(sampler, wo, cells, fine):
    """Integral of the density over cells of (u, v), the half vector's place, by a fine midpoint rule."""
    u, v = np.meshgrid(*((np.arange(n * fine) + 0.5) / (n * fine) for n in cells), indexing="ij")
    theta, phi = u * u * np.pi / 2, (2 * v - 1) * np.pi
    h = from_spherical(theta, phi).reshape(-1, 3)
    cosine = h @ wo
    wi = 2 * cosine[:, None] * h - wo
    area = 2 * np.pi**2 * u.ravel() * np.sin(theta.ravel()) * 4 * cosine
    density = sampler.pdf(wi, np.broadcast_to(wo, wi.shape)) * np.where(cosine > 0, area, 0)
    return density.reshape(cells[0], fine, cells[1], fine).mean((1, 3)) / np.prod(cells)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("theta", [0.2, 1.2])
def test_draws_follow_the_density(kind, theta):
    m = Adaptive(tensors(**KINDS[kind]))
    sampler = AdaptiveSampler(m._model, m._settings)
    wo, cells, count = from_spherical(theta, 0.7), (12, 16), 100_000
    u = np.random.default_rng(11).random((count, 2))
    wi, is_delta = sampler.sample(np.broadcast_to(wo, (count, 3)), u)
    above = wi[:, 2] > 0
    assert not is_delta.any()
    h = wi[above] + wo
    theta_h = np.arctan2(np.hypot(h[:, 0], h[:, 1]), h[:, 2])
    place = np.sqrt(theta_h * 2 / np.pi), np.arctan2(h[:, 1], h[:, 0]) / (2 * np.pi) + 0.5
    counted = np.histogram2d(*place, bins=cells, range=((0, 1), (0, 1)))[0]
    expected = count * in_half_vector_cells(sampler, wo, cells, 24)
    assert expected.sum() == pytest.approx(above.sum(), rel=0.01)
    used = expected > 20
    chi2 = ((counted - expected)[used] ** 2 / expected[used]).sum()
    assert chi2 < used.sum() + 5 * np.sqrt(2 * used.sum())  # five standard deviations


@pytest.mark.parametrize("material", ["chm_orange_rgb", "ilm_solo_m_68_rgb", "irid_flake_paint1_fine_rgb"])
def test_density_of_published_files_integrates_to_one(data, material):
    m = io.read(data / "rgl" / f"{material}.bsdf")
    sampler = AdaptiveSampler(m._model, m._settings)
    wo = from_spherical(np.radians(30), 0.0)
    u = np.random.default_rng(1).random((20000, 2))
    above = (sampler.sample(np.broadcast_to(wo, (20000, 3)), u)[0][:, 2] > 0).mean()
    assert in_half_vector_cells(sampler, wo, (32, 32), 24).sum() == pytest.approx(above, abs=0.01)


def test_sampled_albedo_is_the_integral(data):
    m = io.read(data / "rgl" / "aurora_white_rgb.bsdf")
    wo = from_spherical(0.8, 0.0)
    wi = random_directions(200_000, 2)
    expected = 2 * np.pi * m.f_cos(wi, wo).mean(0)
    sampled = m.sample(wo, np.random.default_rng(3).random((200_000, 2))).weight.mean(0)
    np.testing.assert_allclose(sampled, expected, rtol=0.01)


def test_float32_stays_float32_and_agrees():
    m, (wi, wo) = Adaptive(tensors()), pairs()
    value = m(wi.astype(np.float32), wo.astype(np.float32))
    assert value.dtype == np.float32
    np.testing.assert_allclose(value, m(wi, wo), rtol=1e-4)


def test_many_pairs_equal_few():
    m, (wi, wo) = Adaptive(tensors(azimuths=5)), pairs(40_000)
    np.testing.assert_array_equal(m(wi, wo)[-100:], m(wi[-100:], wo[-100:]))


def test_below_the_horizon_is_black():
    m = Adaptive(tensors())
    np.testing.assert_array_equal(m([[0, 0.6, -0.8], [0, 0.6, 0.8]], [[0, 0, 1], [0, 0.6, -0.8]]), 0)


@pytest.mark.parametrize("options", [{}, {"azimuths": 5, "wavelengths": 6}])
@pytest.mark.parametrize("name", ["m.safetensors", "m.bsdf"])
def test_storage_round_trip(tmp_path, options, name):
    m, (wi, wo) = Adaptive(tensors(**options), "made up").named("m"), pairs()
    io.write(m, tmp_path / name)
    read = io.read(tmp_path / name)
    assert (read.name, read.description, read.isotropic) == ("m", "made up", m.isotropic)
    np.testing.assert_array_equal(read.raw(wi, wo), m.raw(wi, wo))


def test_it_says_that_it_has_no_formula():
    m = Adaptive(tensors())
    assert not m.has_formula
    with pytest.raises(ReflectanceError, match="bake it to a Table"):
        m.f(None, None)
    assert isinstance(0.5 * m, brdf.Reflectance)
