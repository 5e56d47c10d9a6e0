"""A table fitted to scattered samples: exact where it can be, quiet in noise, the prior where nothing is known."""

from __future__ import annotations

import numpy as np
import pytest
from tests.helpers import random_directions, relative_error

from brdf import metrics
from brdf.errors import ParameterError, ReflectanceError
from brdf.models import GGX, Lambertian
from brdf.representations.baking.bake_scattered import bake_scattered
from brdf.representations.baking.slice_stack import SliceStack
from brdf.representations.tables.interpolation import reading

LAYOUT = SliceStack.layouts("4K")[0]
PLASTIC = Lambertian(albedo=(0.5, 0.3, 0.1)) + GGX(alpha=0.3, F0=0.05)
WI, WO = random_directions(20_000, 1, 0.05), random_directions(20_000, 2, 0.05)
FLOOR = np.array([0.25, 0.15, 0.05])
TEST = random_directions(2000, 3, 0.2), random_directions(2000, 4, 0.2)


def test_the_shares_are_those_of_linear_interpolation() -> None:
    from brdf.formula import texture3d

    grid = np.random.default_rng(1).random((4, 5, 6, 1)).astype(np.float64)
    u = np.random.default_rng(2).random((3, 100))
    used, shares = reading(list(u), (4, 5, 6))
    np.testing.assert_allclose(shares.sum(1), 1)
    np.testing.assert_allclose(shares @ grid.reshape(-1)[used], texture3d(grid, *u)[0], atol=1e-12)


def test_a_model_comes_back_from_samples_anywhere() -> None:
    table = bake_scattered(WI, WO, PLASTIC(WI, WO), LAYOUT, floor=FLOOR)
    assert np.median(relative_error(table(*TEST), PLASTIC(*TEST))) < 0.01
    assert table.nbytes <= 4096


def test_noise_is_averaged_and_gross_errors_are_left_out() -> None:
    rng = np.random.default_rng(7)
    exact = PLASTIC(WI, WO)
    noisy = exact * rng.lognormal(0, 0.1, exact.shape)
    noisy[rng.random(len(noisy)) < 0.01] = 5.0
    table = bake_scattered(WI, WO, noisy, LAYOUT, floor=FLOOR, prior=Lambertian(albedo=0.3))
    assert np.median(relative_error(table(*TEST), PLASTIC(*TEST))) < 0.03  # single samples are off by 7 % in the median


def test_what_is_not_seen_continues_the_prior() -> None:
    """Samples of near retroreflection alone: elsewhere the table is the prior, scaled as there."""
    prior = Lambertian(albedo=0.4) + GGX(alpha=0.3, F0=0.05)
    near = np.einsum("ni,ni->n", WI, WO) > np.cos(0.7)
    table = bake_scattered(WI[near], WO[near], prior(WI[near], WO[near]), LAYOUT, floor=FLOOR, prior=prior)
    assert metrics.psnr(prior, table, 48) > 45
    other = bake_scattered(WI[near], WO[near], 1.3 * prior(WI[near], WO[near]), LAYOUT, floor=FLOOR, prior=prior)
    far = np.einsum("ni,ni->n", *TEST) < np.cos(1.2)
    ratio = other(*TEST)[far] / prior(*TEST)[far]
    assert 1.0 < np.median(ratio) < 1.5


def test_weights_say_whom_to_believe() -> None:
    values = np.where((np.arange(len(WI)) % 2)[:, None], 0.1, 0.3)
    for trusted, value in ((1, 0.1), (0, 0.3)):
        weight = np.where(np.arange(len(WI)) % 2 == trusted, 1.0, 1e-6)
        table = bake_scattered(WI, WO, np.broadcast_to(values, WI.shape), LAYOUT, weight=weight)
        np.testing.assert_allclose(np.median(table(*TEST)), value, rtol=0.01)


def test_a_scattered_bake_repeats_itself_to_the_bit() -> None:
    one, two = (bake_scattered(WI, WO, PLASTIC(WI, WO), LAYOUT) for _ in range(2))
    np.testing.assert_array_equal(one.codes, two.codes)


def test_refuses() -> None:
    values = PLASTIC(WI, WO)
    with pytest.raises(ParameterError, match="values must have the directions' shape"):
        bake_scattered(WI, WO, values[:, 0], LAYOUT)
    with pytest.raises(ParameterError, match="weight must be"):
        bake_scattered(WI, WO, values, LAYOUT, weight=np.ones(3))
    with pytest.raises(ParameterError, match="must be finite"):
        bake_scattered(WI, WO, values * np.nan, LAYOUT)
    with pytest.raises(ParameterError, match="not below 0"):
        bake_scattered(WI, WO, values, LAYOUT, weight=-np.ones(len(WI)))
    with pytest.raises(ParameterError, match="smoothness and pull"):
        bake_scattered(WI, WO, values, LAYOUT, smoothness=0)
    with pytest.raises(ReflectanceError, match="no sample to bake"):
        bake_scattered(WI * [1, 1, -1], WO, values, LAYOUT)
