"""Linear lookups: the definition on NumPy, and the same in kernels of either precision."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.ndimage

from brdf.errors import UnknownNameError
from brdf.formula import Vec, kernels, texture1d, texture2d, texture3d
from brdf.formula.textures import FILTERS
from brdf.reflectance import Reflectance
from helpers import random_directions, relative_error

rng = np.random.default_rng(11)


def reference(data, coordinates):
    """The definition through scipy: texel centres at (i + 0.5) / n, edges extended."""
    at = [np.clip(u * n - 0.5, 0, n - 1) for u, n in zip(coordinates, data.shape, strict=False)]
    channels = [scipy.ndimage.map_coordinates(data[..., c], at, order=1) for c in range(data.shape[-1])]
    return np.stack(channels, -1)


@pytest.mark.parametrize(("lookup", "shape"), [(texture1d, (7, 2)), (texture2d, (7, 4, 3)), (texture3d, (3, 5, 4, 3))])
def test_lookup_on_numpy(lookup, shape):
    data = rng.normal(size=shape)
    coordinates = rng.uniform(-0.2, 1.2, (len(shape) - 1, 500))
    value = np.stack(lookup(data, *coordinates).components, -1)
    np.testing.assert_allclose(value, reference(data, coordinates), atol=1e-12)


CUBIC = {"b-spline": lambda t: np.where(t < 1, 2 / 3 - t**2 + t**3 / 2, (2 - t) ** 3 / 6 * (t < 2)),
         "catmull-rom": lambda t: np.where(t < 1, 1 - 2.5 * t**2 + 1.5 * t**3,
                                           (2 - 4 * t + 2.5 * t**2 - 0.5 * t**3) * (t < 2))}  # fmt: skip
"""The kernels over the distance from a texel, as published."""


def direct(data, coordinates, kernel):
    """The sum over all texels of the texture continued by reflection, weighted by the kernel's product."""
    value = np.zeros((coordinates.shape[1], data.shape[-1]))
    padded = np.pad(data, [(3, 3)] * (data.ndim - 1) + [(0, 0)], mode="reflect")
    at = [np.clip(u * n - 0.5, 0, n - 1) + 3 for u, n in zip(coordinates, data.shape, strict=False)]
    for place in np.ndindex(padded.shape[:-1]):
        weight = np.prod([kernel(np.abs(x - i)) for x, i in zip(at, place, strict=True)], axis=0)
        value += weight[:, None] * padded[place]
    return value


@pytest.mark.parametrize("filter", CUBIC)
@pytest.mark.parametrize(("lookup", "shape"), [(texture1d, (7, 2)), (texture2d, (4, 5, 3)), (texture3d, (5, 4, 6, 3))])
def test_cubic_lookup_is_the_sum_over_the_kernel(lookup, shape, filter):
    data = rng.normal(size=shape)
    coordinates = rng.uniform(-0.2, 1.2, (len(shape) - 1, 60))
    value = np.stack(lookup(data, *coordinates, filter=filter).components, -1)
    np.testing.assert_allclose(value, direct(data, coordinates, CUBIC[filter]), atol=1e-12)


@pytest.mark.parametrize("prefiltered", [False, True])
def test_b_spline_is_scipys(prefiltered):
    data = rng.normal(size=(6, 7, 5, 1))
    coordinates = rng.uniform(0, 1, (3, 300))
    at = [np.clip(u * n - 0.5, 0, n - 1) for u, n in zip(coordinates, data.shape, strict=False)]
    expected = scipy.ndimage.map_coordinates(data[..., 0], at, order=3, mode="mirror", prefilter=prefiltered)
    stored = scipy.ndimage.spline_filter(data[..., 0], 3, mode="mirror")[..., None] if prefiltered else data
    np.testing.assert_allclose(texture3d(stored, *coordinates, filter="b-spline")[0], expected, atol=1e-12)


def test_nearest_lookup():
    data = rng.normal(size=(5, 2))
    value = texture1d(data, np.array([-1, 0.05, 0.19, 0.21, 0.5, 0.99, 2.0]), filter="nearest")
    np.testing.assert_array_equal(value[0], data[[0, 0, 0, 1, 2, 4, 4], 0])


def test_refuses_an_unknown_filter():
    with pytest.raises(UnknownNameError, match="texture filter"):
        texture1d(np.zeros((3, 1)), np.array([0.5]), filter="cubist")


def test_one_texel_is_constant():
    value = texture2d(np.full((1, 1, 1), 4.0), np.array([0.0, 0.3]), np.array([1.0, 0.2]))
    np.testing.assert_array_equal(value[0], 4.0)


class Textured(Reflectance):
    """Looks a texture up where another one says."""

    def __init__(self, filter: str = "linear") -> None:
        self.filter = filter
        self._textures = {
            "shift": rng.uniform(0, 1, (5, 1)).astype("f4"),
            "table": rng.uniform(0, 2, (4, 1, 6, 3)).astype("f4"),
        }

    @property
    def structure(self):
        return (Textured, self.filter)

    @property
    def textures(self):
        return self._textures

    def f(self, wi: Vec, wo: Vec) -> Vec:
        u = texture1d(self.shift, wi.z)[0]
        table = texture3d(self.table, u, wi.x, wo.z, filter=self.filter)
        return table * wo.z

    def _state(self):
        return {}, {}


def test_dependent_lookups_in_kernels():
    m = Textured()
    wi, wo = random_directions(30_000, 1), random_directions(30_000, 2)
    shift, table = m.textures["shift"].astype(float), m.textures["table"].astype(float)
    u = reference(shift, [wi[:, 2]])[:, 0]
    expected = reference(table, [u, wi[:, 0], wo[:, 2]]) * wo[:, 2:]
    np.testing.assert_allclose(kernels.evaluate(m, wi, wo, True), expected, rtol=1e-12)
    np.testing.assert_allclose(m(wi[:100], wo[:100]), expected[:100], rtol=1e-12)
    assert relative_error(m(wi.astype("f4"), wo.astype("f4")), expected).max() < 2e-5


@pytest.mark.parametrize("filter", [f for f in FILTERS if f != "b-spline"])  # which differs in its weights alone
def test_every_filter_in_kernels(filter):
    m = Textured(filter)
    m.textures["table"][:] = rng.uniform(0, 2, (4, 1, 6, 3))
    wi, wo = random_directions(3000, 1), random_directions(3000, 2)
    expected = m(wi, wo)
    np.testing.assert_allclose(kernels.evaluate(m, wi, wo, True), expected, rtol=1e-12, atol=1e-15)
    single = kernels.evaluate(m, wi.astype("f4"), wo.astype("f4"), True)
    assert np.quantile(relative_error(single, expected), 0.99) < 1e-4


@pytest.mark.parametrize("filter", FILTERS)
def test_every_filter_in_jax(filter):
    jnp = pytest.importorskip("jax.numpy")
    data, coordinates = rng.normal(size=(5, 4, 6, 2)).astype("f4"), rng.uniform(-0.1, 1.1, (3, 200)).astype("f4")
    value = texture3d(jnp.asarray(data), *map(jnp.asarray, coordinates), filter=filter)
    expected = texture3d(data, *coordinates, filter=filter)
    for a, b in zip(value, expected, strict=True):
        np.testing.assert_allclose(a, b, atol=2e-5)


@pytest.mark.parametrize("place", [np.nan, -np.inf, np.inf, -1e30, 1e30])
def test_no_place_whatever_reads_beyond_the_texture(place):
    data = np.arange(12.0).reshape(4, 3)
    value = texture1d(data, np.array([place]))
    np.testing.assert_array_equal(value[0], [9.0 if place > 0 else 0.0])
