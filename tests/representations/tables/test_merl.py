"""MERL's layout: nodes, period, holes, and files made from published networks."""

from __future__ import annotations

import math
import subprocess
import sys

import numpy as np
import pytest
from tests.helpers import random_directions

from brdf.errors import ReflectanceError
from brdf.geometry.warps import HALF_PI
from brdf.metrics import psnr
from brdf.models import GGX, Lambertian
from brdf.reflectance import Reflectance
from brdf.representations.baking.slice_stack import MEASURED_FLOOR, SliceStack, is_measured
from brdf.representations.tables.bases import HalfBasis
from brdf.representations.tables.merl import LAYOUT, from_merl, to_merl

ROUNDING = 1e-12
"""One bin, (60, 50, 0), lies on the horizon to the last bit."""

WI, WO = random_directions(500, 1), random_directions(500, 2)


def bin_directions(i, j, k):
    """The directions of bins' lower edges: theta_h = (i / 90)^2 90 degrees, theta_d = j degrees, phi_d = k degrees."""
    theta_h = (np.asarray(i) / 90) ** 2 * HALF_PI
    return HalfBasis().directions(theta_h, np.radians(np.asarray(j, float)), np.radians(np.asarray(k, float)))


def below_horizon():
    i, j, k = np.ogrid[:90, :90, :180]
    wi, wo = bin_directions(i, j, k)
    return (wi[..., 2] <= ROUNDING) | (wo[..., 2] <= ROUNDING)


BELOW = below_horizon()


@pytest.fixture(scope="module")
def noise():
    """Random positive bins, -1 below the horizon."""
    values = np.random.default_rng(0).uniform(0.1, 1, (90, 90, 180, 3)).astype(np.float32)
    values[BELOW] = -1
    return values


@pytest.fixture(scope="module")
def noise_table(noise):
    return from_merl(noise, "noise", "seeded")


def some_bins(count=400, least=1):
    """Bins above the horizon at which phi_d is defined."""
    rng = np.random.default_rng(1)
    i, j, k = rng.integers(least, 90, count), rng.integers(least, 90, count), rng.integers(0, 180, count)
    above = ~BELOW[i, j, k]
    return i[above], j[above], k[above]


def test_constant_table_is_exact():
    table = from_merl(np.full((90, 90, 180, 3), [0.1, 0.2, 0.3], np.float32))
    np.testing.assert_allclose(table(WI, WO), np.tile(np.float32([0.1, 0.2, 0.3]), (500, 1)), rtol=1e-12)


def test_nodes_keep_their_values(noise, noise_table):
    i, j, k = some_bins()
    wi, wo = bin_directions(i, j, k)
    np.testing.assert_allclose(noise_table(wi, wo), noise[i, j, k], atol=1e-7)


def test_interpolates_halfway_between_nodes(noise, noise_table):
    i, j, k = some_bins()
    inner = (k < 179) & (j < 88)
    i, j, k = i[inner], j[inner], k[inner]
    around = np.stack([noise[i, j, k], noise[i, j, k + 1], noise[i, j + 1, k], noise[i, j + 1, k + 1]])
    wi, wo = bin_directions(i, j + 0.5, k + 0.5)
    inner = (around > 0).all((0, 2)) & (wi[:, 2] > 0) & (wo[:, 2] > 0)
    assert inner.sum() > 100
    np.testing.assert_allclose(noise_table(wi, wo)[inner], around.mean(0)[inner], atol=1e-6)


def test_has_a_period_of_180_degrees(noise, noise_table):
    i, j, _ = some_bins()
    before, after = (noise_table(*bin_directions(i, j, k)) for k in (180 - 1e-7, 1e-7))
    np.testing.assert_allclose(before, after, atol=1e-5)
    halfway = noise_table(*bin_directions(i, j, 179.5))
    closed = (noise[i, j, 179] + noise[i, j, 0]) / 2
    fine = (noise[i, j, 179] > 0).all(-1) & (noise[i, j, 0] > 0).all(-1)
    assert fine.sum() > 100
    np.testing.assert_allclose(halfway[fine], closed[fine], atol=1e-5)


def test_is_reciprocal(noise_table):
    np.testing.assert_allclose(noise_table(WI, WO), noise_table(WO, WI), atol=1e-9)


def test_approaches_its_first_row_as_theta_h_vanishes():
    m = Lambertian(albedo=0.3) + GGX(alpha=0.3)
    table = from_merl(to_merl(m))
    wi = np.array([0.6, 0.0, 0.8])
    for shift in (0.0, 1e-9, 1e-6, 1e-5):
        wo = np.array([-0.6 - shift, 0.0, 0.8])
        wo /= np.linalg.norm(wo)
        np.testing.assert_allclose(table(wi, wo), m(wi, wo), rtol=2e-3)


def test_close_to_the_reflectance_it_samples():
    m = Lambertian(albedo=0.3) + GGX(alpha=0.3)
    clear = (WI[:, 2] > 0.2) & (WO[:, 2] > 0.2)
    np.testing.assert_allclose(from_merl(to_merl(m))(WI, WO)[clear], m(WI, WO)[clear], rtol=3e-3)


def test_bins_of_a_reflectance():
    m = Lambertian(albedo=0.3) + GGX(alpha=0.3)
    values = to_merl(m)
    assert values.shape == (90, 90, 180, 3)
    assert values.dtype == np.float32
    np.testing.assert_array_equal(values[..., 0] == -1, BELOW)
    i, j, k = some_bins()
    np.testing.assert_allclose(values[i, j, k], m(*bin_directions(i, j, k)), rtol=1e-6)


def test_bins_go_through_a_table_unchanged(noise, noise_table):
    np.testing.assert_array_equal(to_merl(noise_table), noise)


def test_lambertian_bins_below_the_horizon_are_a_quarter_of_all():
    assert np.mean(to_merl(Lambertian())[..., 0] == -1) == pytest.approx(0.238, abs=5e-4)


def test_holes_are_filled_and_known(noise):
    values = noise.copy()
    values[40, 20, 30] = -1  # one bin
    values[50, 0:10, 60, 1] = np.nan  # the start of a column, one channel
    values[10, :, 100] = -0.001  # a whole column
    values[0] = -1  # a whole row
    table = from_merl(values)
    grid = table.codes
    assert np.isfinite(grid).all()
    assert grid.min() > 0
    np.testing.assert_array_equal(grid[40, 20, 30], values[40, 19, 30])
    np.testing.assert_array_equal(grid[50, 3, 60], values[50, 10, 60])
    np.testing.assert_array_equal(grid[10, :60, 100], grid[10, :60, 99])
    np.testing.assert_array_equal(grid[0], grid[1])
    assert not table.measured[40, 20, 30]
    assert not table.valid(*bin_directions(40, 20, 30))
    assert not table.valid(*bin_directions(40, 20.3, 30.2))
    assert table.valid(*bin_directions(40, 22, 30))
    np.testing.assert_array_equal(to_merl(table)[40, 20, 30], [-1, -1, -1])


def test_valid_is_above_the_horizon(noise_table):
    wi, wo = random_directions(300, 3), random_directions(300, 4)
    assert noise_table.valid(wi, wo)[(wi[:, 2] > 0.1) & (wo[:, 2] > 0.1)].all()
    assert not noise_table.valid(wi * [1, 1, -1], wo).any()


def test_saved_with_its_holes(tmp_path, noise, noise_table):
    noise_table.save(tmp_path / "m.safetensors")
    back = Reflectance.restore(tmp_path / "m.safetensors")
    np.testing.assert_array_equal(back(WI, WO), noise_table(WI, WO))
    np.testing.assert_array_equal(to_merl(back), noise)


def test_keeps_one_copy_of_the_numbers(noise_table):
    assert noise_table.textures["grid"] is noise_table.codes
    assert noise_table.nbytes == 90 * 90 * 181 * 12 + (90 * 90 * 181 + 7) // 8


def test_measured_stack_leaves_holes_out():
    """Spoilt bins marked as invalid do not reach a stack baked from the table."""
    m = Lambertian(albedo=0.3) + GGX(alpha=0.3)
    clean = to_merl(m)
    marked = clean.copy()
    marked[np.random.default_rng(2).random(BELOW.shape) < 0.02] = -1
    spoilt = np.where((marked < 0) & (clean >= 0), 50.0, clean).astype(np.float32)
    clear = (WI[:, 2] > 0.3) & (WO[:, 2] > 0.3)

    def error(values):
        stack = SliceStack.bake(from_merl(values))
        return np.median(np.abs(stack(WI, WO)[clear] / m(WI, WO)[clear] - 1))

    assert error(marked) < 1.5 * error(clean) + 0.01
    assert error(spoilt) > 2 * error(marked)


def test_floor_of_measured_data_is_a_quantile(noise_table):
    assert is_measured(noise_table)
    assert not is_measured(Lambertian())
    assert 0 < MEASURED_FLOOR < 0.1
    values = noise_table(WI, WO)
    floor = SliceStack.bake(noise_table).values["floor"]
    assert np.all(floor > math.pi * 0.1)
    assert np.all(floor < math.pi * np.quantile(values, 0.2))


@pytest.mark.parametrize("noise_level", [0.0, 0.05])
def test_made_file(data, tmp_path, noise_level):
    """A file in MERL's layout, written by another program from published networks."""
    path = tmp_path / "gold-metallic-paint.binary"
    script = data / "merl" / "make_binary.py"
    subprocess.run(
        [sys.executable, str(script), "gold-metallic-paint", str(path), "--noise", str(noise_level)], check=True
    )
    raw = np.fromfile(path, "<f8", offset=12).reshape(3, 90, 90, 180)
    values = (np.moveaxis(raw, 0, -1) * (np.array([1, 1.15, 1.66]) / 1500)).astype(np.float32)
    table = from_merl(values)
    holes = np.mean(~table.measured[:, :, :-1])
    assert holes == pytest.approx(np.mean(values.min(-1) < 0), abs=1e-9)
    i, j, k = some_bins()
    fine = (values[i, j, k] >= 0).all(-1)
    wi, wo = bin_directions(i, j, k)
    np.testing.assert_allclose(table(wi, wo)[fine], values[i, j, k][fine], rtol=1e-4, atol=1e-6)
    assert np.isfinite(table(WI, WO)).all()


def test_refuses():
    with pytest.raises(ReflectanceError, match=r"\(90, 90, 180, 3\)"):
        from_merl(np.zeros((90, 90, 181, 3), np.float32), "odd")
    with pytest.raises(ReflectanceError, match="no measured bin"):
        from_merl(np.full((90, 90, 180, 3), -1, np.float32))
    with pytest.raises(ReflectanceError, match="anisotropic"):
        to_merl(GGX(alpha_x=0.1, alpha_y=0.3))


def test_layout_is_merls():
    theta_h, theta_d, phi_d = (np.degrees(axis.ravel()) for axis in LAYOUT.nodes())
    np.testing.assert_allclose(theta_h, (np.arange(90) / 90) ** 2 * 90, atol=1e-10)
    np.testing.assert_allclose(theta_d, np.arange(90), atol=1e-10)
    np.testing.assert_allclose(phi_d, np.arange(181), atol=1e-10)


def test_measured_stack_averages_the_directions_it_folds():
    """A table whose two mirror halves differ is met in the middle, or kept by a stack without that fold."""
    plain = to_merl(Lambertian(albedo=0.4))
    skewed = plain.copy()
    skewed[:, :, 91:] *= 1.5  # phi_d > 90 degrees: the mirror image of phi_d < 90
    table = from_merl(skewed)
    clear = (WI[:, 2] > 0.4) & (WO[:, 2] > 0.4)
    folded = SliceStack.bake(table, 4096, fold="quarter-turn")(WI, WO)[clear]
    assert np.median(folded / (0.4 / math.pi)) == pytest.approx(1.25, abs=0.02)
    kept = SliceStack.bake(table, 4096)
    assert kept.layout.basis.fold == "half-turn"
    np.testing.assert_allclose(np.median(kept(WI, WO)[clear] / table(WI, WO)[clear]), 1, atol=0.02)


def test_noisy_bins_are_averaged():
    """With noise, spikes and holes added to a file's bins, the stack is nearer to the clean values than the file is."""
    m = Lambertian(albedo=0.3) + GGX(alpha=0.3)
    rng = np.random.default_rng(4)
    clean = to_merl(m)
    noisy = clean * np.exp(0.05 * rng.standard_normal(clean.shape)).astype(np.float32)
    spikes = rng.random(BELOW.shape) < 0.05
    noisy[spikes] *= np.exp(1.5 * rng.standard_normal((spikes.sum(), 1))).astype(np.float32)
    noisy[BELOW | (rng.random(BELOW.shape) < 0.01)] = -1
    table = from_merl(noisy.astype(np.float32))
    assert psnr(m, SliceStack.bake(table), 36) > psnr(m, table, 36) + 12
