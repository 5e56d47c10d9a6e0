"""Storages: round trips within the error each promises, and what each refuses."""

from __future__ import annotations

import math

import numpy as np
import pytest

from brdf.color import srgb_encode
from brdf.errors import ParameterError, UnknownNameError
from brdf.models import GGX, Lambertian
from brdf.representations.storage import STORAGES, UNSIGNED, storage
from brdf.representations.tables.table import Table


def wide_range(count=20_000, seed=1):
    """Positive colours over 12 powers of ten, with zeros."""
    rng = np.random.default_rng(seed)
    values = 10.0 ** rng.uniform(-8, 4, (count, 3))
    return np.where(rng.random((count, 3)) < 0.05, 0, values)


def round_trip(name, values):
    codes, constants = storage(name).pack(values)
    texels = storage(name).texels(codes)
    return constants.get("low", 0) + constants.get("span", 1) * texels.astype(np.float64)


def test_shared_exponent_errs_by_half_a_step_of_its_largest_channel():
    values = wide_range()
    largest = values.max(-1, keepdims=True)
    error = np.abs(round_trip("rgb9e5", values) - values)
    assert np.all(error <= np.maximum(largest * 2.0**-9, 2.0**-25))
    assert np.max(error / largest, where=largest > 1e-3, initial=0) > 0.9 * 2.0**-9, "the bound is not idle"


@pytest.mark.parametrize(
    ("value", "word"),
    [
        ((0, 0, 0), 0),
        ((1, 0.5, 0.25), 16 << 27 | 64 << 18 | 128 << 9 | 256),
        ((65408, 0, 65408), 31 << 27 | 511 << 18 | 511),
        ((1e9, 0, 0), 31 << 27 | 511),
        ((511.6, 0, 0), 25 << 27 | 256),  # 511.6 rounds up to 512, so the exponent grows
        ((2**-24, 0, 2**-25), 1),  # the smallest step; half of it rounds to even
    ],
)
def test_shared_exponent_words_are_those_of_the_specification(value, word):
    codes, constants = storage("rgb9e5").pack(np.array([value], np.float64))
    assert (codes.dtype, constants) == (np.uint32, {})
    assert int(codes[0]) == word


def test_shared_exponent_repeats_itself_exactly():
    once = round_trip("rgb9e5", wide_range())
    np.testing.assert_array_equal(round_trip("rgb9e5", once), once)


def test_standard_bytes_err_by_half_a_step_on_the_srgb_curve():
    values = np.random.default_rng(2).random((5000, 3))
    codes, _ = storage("srgb8").pack(values)
    assert (codes.dtype, codes.nbytes) == (np.uint8, 15_000)
    back = round_trip("srgb8", values)
    assert np.abs(srgb_encode(back) - srgb_encode(values)).max() <= 0.5 / 255 + 1e-6
    np.testing.assert_allclose(round_trip("srgb8", np.array([[0.0, 1.0, 7.0]])), [[0, 1, 1]], atol=1e-7)
    middle = storage("srgb8").texels(np.array([[188, 188, 188]], np.uint8))
    np.testing.assert_allclose(middle, 0.502886, atol=1e-5)


def test_spread_bytes_err_by_half_a_step_of_each_channels_range():
    values = np.random.default_rng(5).normal(size=(40, 50, 3)) * [1, 10, 0.1]
    codes, constants = storage("8-8-8").pack(values)
    assert (codes.dtype, codes.nbytes) == (np.uint8, 6000)
    assert np.all(np.abs(round_trip("8-8-8", values) - values) <= constants["span"] / 255 / 2 * 1.001 + 1e-6)
    np.testing.assert_allclose(round_trip("8-8-8", np.full((2, 2, 3), 0.7)), 0.7, rtol=1e-6)


@pytest.mark.parametrize("name", UNSIGNED)
@pytest.mark.parametrize("bad", [-0.25, math.nan])
def test_unsigned_storages_refuse_negative_numbers(name, bad):
    values = np.ones((2, 3))
    values[1, 2] = bad
    with pytest.raises(ParameterError, match=rf"'{name}' holds no negative numbers.*choose half"):
        storage(name).pack(values)


@pytest.mark.parametrize("name", STORAGES)
def test_codes_of_another_storage_are_refused(name):
    with pytest.raises(ValueError, match="expected"):
        storage(name).texels(np.zeros((4, 3), np.int16))


def test_unknown_storage_names_the_known_ones():
    with pytest.raises(UnknownNameError, match="did you mean 'rgb9e5'"):
        storage("rgb9e6")


def test_tables_use_them():
    m = Lambertian(albedo=(0.3, 0.5, 0.1)) + GGX(alpha=0.5, F0=0.5)
    wi, wo = (np.array([[math.sin(t), 0, math.cos(t)]]) for t in (0.3, -0.7))
    plain = Table.bake(m, "normal", "bezier", (8, 8, 8), "float32")
    step = np.ptp(plain.codes.reshape(-1, 3), axis=0) / 2
    bounds = {"rgb9e5": plain(wi, wo).max() * 2**-8, "8-8-8": step / 255, "10-10-10": step / 1023}
    for name, bound in bounds.items():
        stored = Table.bake(m, "normal", "bezier", (8, 8, 8), name)
        assert np.all(np.abs(stored(wi, wo) - plain(wi, wo)) <= bound * 1.01), name
    with pytest.raises(ParameterError, match="no negative numbers"):
        Table.bake(m, "half", storage="rgb9e5")  # logarithms are stored


def test_bytes_a_texel():
    m = Lambertian()
    sizes = {name: Table.bake(m, "normal", "bezier", (4, 5, 6), name).nbytes / 120 for name in STORAGES}
    constants = 4 * 6 / 120
    expected = {"float32": 12, "half": 6, "10-10-10": 4 + constants, "8-8-8": 3 + constants, "rgb9e5": 4, "srgb8": 3}
    assert sizes == pytest.approx(expected)
