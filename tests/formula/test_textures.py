"""Linear lookups: the definition on NumPy, and the same in kernels of either precision."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.ndimage

from brdf.formula import Vec, kernels, texture1d, texture2d, texture3d
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


def test_one_texel_is_constant():
    value = texture2d(np.full((1, 1, 1), 4.0), np.array([0.0, 0.3]), np.array([1.0, 0.2]))
    np.testing.assert_array_equal(value[0], 4.0)


class Textured(Reflectance):
    """Looks a texture up where another one says."""

    def __init__(self) -> None:
        self._textures = {
            "shift": rng.uniform(0, 1, (5, 1)).astype("f4"),
            "table": rng.uniform(0, 2, (4, 1, 6, 3)).astype("f4"),
        }

    @property
    def structure(self):
        return (Textured,)

    @property
    def textures(self):
        return self._textures

    def f(self, wi: Vec, wo: Vec) -> Vec:
        u = texture1d(self.shift, wi.z)[0]
        table = texture3d(self.table, u, wi.x, wo.z)
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


@pytest.mark.parametrize("place", [np.nan, -np.inf, np.inf, -1e30, 1e30])
def test_no_place_whatever_reads_beyond_the_texture(place):
    data = np.arange(12.0).reshape(4, 3)
    value = texture1d(data, np.array([place]))
    np.testing.assert_array_equal(value[0], [9.0 if place > 0 else 0.0])
