"""Albedos that tables carry, against a quadrature of another kind and against what is known in closed form."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.helpers import random_directions

from brdf import container
from brdf.errors import CorruptFileError, DirectionError, ReflectanceError
from brdf.geometry.quadrature import half_vector_rule
from brdf.models import GGX, Lambertian, OrenNayar
from brdf.reflectance import Reflectance
from brdf.representations.baking.slice_stack import SliceStack
from brdf.representations.tables.albedo_table import NBYTES
from brdf.representations.tables.table import Table

WO = random_directions(16, 3, least_cosine=0.02)
MODELS = {
    "plastic": Lambertian(albedo=(0.5, 0.3, 0.1)) + GGX(alpha=0.1, F0=0.04),
    "gold": GGX(alpha=0.3, F0=(1.0, 0.78, 0.34)),
    "glossy gold": GGX(alpha=0.06, F0=(1.0, 0.78, 0.34)),
    "Oren-Nayar": OrenNayar(albedo=0.8, sigma=0.5),
}


@pytest.fixture(scope="module", params=MODELS)
def pair(request):
    m = MODELS[request.param]
    stack = SliceStack.bake(m, "8K")
    return m, stack, integrals(stack, WO)


def integrals(m, directions):
    """(N, 3) albedos by a fine rule over wi, each for one viewer."""
    rules = [(wo, half_vector_rule(wo, 120, 64)) for wo in directions]
    return np.stack([np.einsum("n,nc->c", rule.weights, m.f_cos(rule.directions, wo[None])) for wo, rule in rules])


def test_is_within_its_stated_error(pair):
    _, stack, exact = pair
    missed = np.abs(stack.albedo(WO) - exact)
    assert np.all(missed <= 1.2 * stack.albedo_error(WO) + 3e-4), (missed / stack.albedo_error(WO)).max()


def test_stated_error_is_small_and_not_idle(pair):
    _, stack, exact = pair
    error = stack.albedo_error(WO[WO[:, 2] > 0.1])
    missed = np.abs(stack.albedo(WO) - exact)
    assert 0 < error.max() < 0.01
    assert np.median(stack.albedo_error(WO)) < 30 * np.median(missed) + 1e-3


def test_is_near_the_sources(pair):
    m, stack, _ = pair
    clear = WO[WO[:, 2] > 0.1][:12]
    np.testing.assert_allclose(stack.albedo(clear), integrals(m, clear), atol=0.012)


def test_lambert():
    stack = SliceStack.bake(Lambertian(albedo=(0.8, 0.5, 0.2)))
    np.testing.assert_allclose(stack.albedo(WO), np.tile([0.8, 0.5, 0.2], (16, 1)), atol=2e-3)


def test_shapes_and_below_the_horizon():
    stack = SliceStack.bake(Lambertian(albedo=0.5), 4096)
    assert stack.albedo([0.0, 0.0, 1.0]).shape == (3,)
    single = stack.albedo(WO.reshape(4, 4, 3).astype(np.float32))
    assert (single.shape, single.dtype) == ((4, 4, 3), np.float32)
    np.testing.assert_array_equal(stack.albedo([[0.6, 0.0, -0.8]]), [[0.0, 0.0, 0.0]])
    np.testing.assert_array_equal(stack.albedo(WO, samples=16), stack.albedo(WO))
    with pytest.raises(DirectionError):
        stack.albedo([0.0, 0.0, 2.0])


def test_is_saved_counted_and_optional(tmp_path):
    stack = SliceStack.bake(MODELS["gold"], 4096)
    plain = Table(stack.layout, stack.codes, stack.values)
    assert stack.nbytes == plain.nbytes + NBYTES
    stack.save(tmp_path / "with.safetensors")
    plain.save(tmp_path / "without.safetensors")
    back, old = (Reflectance.restore(tmp_path / f"{name}.safetensors") for name in ("with", "without"))
    np.testing.assert_array_equal(back.albedo(WO), stack.albedo(WO))
    np.testing.assert_array_equal(back.albedo_error(WO), stack.albedo_error(WO))
    assert (back.nbytes, old.nbytes) == (stack.nbytes, plain.nbytes)
    sampled, error = old.albedo(WO), old.albedo_error(WO)
    assert np.all(np.abs(sampled - back.albedo(WO)) < 5 * error + 2 * back.albedo_error(WO) + 1e-3)


@pytest.mark.parametrize("broken", ["shape", "type", "nan"])
def test_refuses_a_broken_file(tmp_path, broken):
    header, arrays = SliceStack.bake(Lambertian(albedo=0.5), 4096).state()
    bad = arrays["albedo"].copy()
    bad[0, 0, 0] = math.nan
    arrays["albedo"] = {"shape": arrays["albedo"][:, :5], "type": arrays["albedo"].astype(np.float32), "nan": bad}[
        broken
    ]
    container.save(tmp_path / "m.safetensors", header, arrays)
    with pytest.raises(CorruptFileError, match="albedo"):
        Reflectance.restore(tmp_path / "m.safetensors")


def test_any_isotropic_table():
    table = Table.bake(MODELS["gold"], shape=(32, 16, 4)).with_albedo()
    assert np.all(np.abs(table.albedo(WO) - integrals(table, WO)) <= 1.2 * table.albedo_error(WO) + 3e-4)
    with pytest.raises(ReflectanceError, match="azimuth"):
        SliceStack.bake(GGX(alpha_x=0.3, alpha_y=0.4), 4096, anisotropic=True).with_albedo()
