"""What `Table.bake` offers: modes by name, filters, projection, packing for graphics cards, refusals."""

from __future__ import annotations

import math

import numpy as np
import pytest

from brdf.errors import ParameterError, ReflectanceError, UnknownNameError
from brdf.formula import Vec, kernels, texture2d, texture3d
from brdf.geometry.warps import Bezier
from brdf.laws.sampling import sampling
from brdf.models import GGX, Lambertian
from brdf.reflectance import Reflectance
from brdf.representations.baking.bake import bake_points
from brdf.representations.baking.projection import bake_projection
from brdf.representations.tables.filters import FILTERS
from brdf.representations.tables.layouts import BASES, ENCODINGS, named_layout, shape_of
from brdf.representations.tables.packing import pack_slices, unpack_slices
from brdf.representations.tables.table import Table
from helpers import random_directions

WI, WO = random_directions(500, 1), random_directions(500, 2)
GLOSSY = Lambertian(albedo=(0.1, 0.2, 0.3)) + GGX(alpha=0.35)


def test_presets_hold_the_same_number_of_nodes():
    assert shape_of("normal", 16) == (16, 16, 32)
    assert shape_of("half", 16) == (32, 32, 8)
    assert shape_of("normal", 8, isotropic=False) == (16, 8, 8, 16)
    assert all(math.prod(shape_of(basis, 12)) == 2 * 12**3 for basis in BASES)
    assert Table.bake(GLOSSY, shape=8).layout.shape == (16, 16, 4)
    assert Table.bake(GGX(alpha_x=0.3, alpha_y=0.5), shape=4).layout.shape == (8, 8, 8, 2)


def test_alpha_reaches_its_warps():
    warps = Table.bake(GLOSSY, "normal", "bezier", 6, alpha=(0.3, 0.0)).layout.warps
    assert warps == (Bezier(alpha=0.3), Bezier(alpha=0.3), Bezier(math.pi, 0.0))
    assert Table.bake(GLOSSY, shape=6, alpha=(0.4, 0.5)).layout.warps[1:] == (Bezier(alpha=0.4), Bezier(alpha=0.5))


@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("basis", BASES)
def test_every_encoding_in_every_basis(basis, encoding):
    table = Table.bake(GLOSSY, basis, "uniform", 16, "float32", encoding=encoding)
    clear = (WI[:, 2] > 0.3) & (WO[:, 2] > 0.3)
    wi, wo = WI[clear], WO[clear]
    error = np.sqrt(np.mean((table(wi, wo) - GLOSSY(wi, wo)) ** 2) / np.mean(GLOSSY(wi, wo) ** 2))
    assert error < 0.08


@pytest.mark.parametrize("filter", FILTERS)
def test_every_filter_is_kept_and_bakes(tmp_path, filter):
    table = Table.bake(GLOSSY, shape=12, storage="float32", filter=filter)
    table.save(tmp_path / "t.safetensors")
    back = Reflectance.restore(tmp_path / "t.safetensors")
    assert back.layout.filter == filter
    np.testing.assert_array_equal(back(WI, WO), table(WI, WO))
    clear = (WI[:, 2] > 0.1) & (WO[:, 2] > 0.1)
    exact = GLOSSY(WI, WO)[clear]
    error = np.sqrt(np.mean((table(WI, WO)[clear] - exact) ** 2) / np.mean(exact**2))
    assert error < (0.3 if filter == "nearest" else 0.06)


def test_cubic_tables_in_kernels():
    table = Table.bake(GLOSSY, shape=8, filter="catmull-rom")
    np.testing.assert_allclose(kernels.evaluate(table, WI, WO, True), table(WI, WO), rtol=1e-9)


def test_a_table_that_does_not_name_its_filter_is_linear(tmp_path):
    from brdf import container

    header, arrays = Table.bake(GLOSSY, shape=6).state()
    header["layout"].pop("filter")
    container.save(tmp_path / "t.safetensors", header, arrays)
    assert Reflectance.restore(tmp_path / "t.safetensors").layout.filter == "linear"


# ---- projection --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("basis", "warp"), [("half", "bezier"), ("normal", "bezier"), ("normal", "uniform")])
def test_projection_of_a_table_is_that_table(basis, warp):
    """What the grid can hold comes back."""
    layout = named_layout(basis, warp, (6, 7, 8), "float32", encoding="f")
    rng = np.random.default_rng(3)
    if basis == "half":  # a basis whose grid reaches below the horizon is seen above it alone
        source = bake_points(Lambertian(albedo=0.4), layout)
    else:
        source = Table.encoded(layout, rng.uniform(0.5, 1, (6, 7, 8, 3)))
        source.codes[-1] = source.codes[:, -1] = 0.5
    clear = (WI[:, 2] > 0.05) & (WO[:, 2] > 0.05)
    back = bake_projection(source, layout)
    np.testing.assert_allclose(back(WI, WO)[clear], source(WI, WO)[clear], rtol=0.03)
    if basis == "half":
        np.testing.assert_allclose(back.codes, source.codes, rtol=1e-6)


def test_shrinking_keeps_integrals():
    """A lobe narrower than a cell: its share of the grid's volume stays, where reading it at the nodes loses it."""

    class Ridge(Reflectance):
        structure = ("ridge",)

        def f(self, wi, wo):
            u = 1.0 - Bezier(alpha=1.0).coordinate(_polar(wi))
            value = np.exp(-(((u - 0.46) / 0.03) ** 2))
            return Vec(value, value, value)

        def _state(self):
            raise NotImplementedError

    def _polar(w):
        from brdf.geometry.warps import Angle

        return Angle(np.sqrt(w.x * w.x + w.y * w.y), w.z)

    m = Ridge()
    fine = named_layout("normal", "identity", (129, 4, 4), "float32")
    coarse = named_layout("normal", "identity", (9, 4, 4), "float32")
    source = bake_points(m, fine)

    def integral(table):
        u = (np.arange(20_000) + 0.5) / 20_000
        wi = np.stack([np.sqrt(1 - u * u), 0 * u, u], -1)
        return table.raw(wi, np.array([0.6, 0, 0.8]))[:, 0].mean()

    exact = 0.03 * math.sqrt(math.pi)
    assert integral(source) == pytest.approx(exact, rel=2e-3)
    assert integral(bake_projection(source, coarse)) == pytest.approx(exact, rel=0.01)
    assert abs(integral(bake_points(source, coarse)) / exact - 1) > 0.3


@pytest.mark.parametrize("basis", ["half", "normal"])
def test_projection_is_nearer_than_points(basis):
    """In what is projected: logarithms, over the volume of the grid."""
    layout = named_layout(basis, "uniform", (16, 16, 16), "float32", encoding="log")
    rng = np.random.default_rng(0)
    wi, wo = layout.basis.directions(*(warp.angle(rng.uniform(0, 1, 40_000)) for warp in layout.warps))
    clear = (wi[:, 2] > 0.02) & (wo[:, 2] > 0.02)
    wi, wo = wi[clear], wo[clear]
    exact = np.log(GLOSSY(wi, wo) + 1e-3)
    error = [np.mean((np.log(b(GLOSSY, layout)(wi, wo) + 1e-3) - exact) ** 2) for b in (bake_projection, bake_points)]
    assert error[0] < 0.7 * error[1]


def test_projection_of_an_anisotropic_source():
    m = Lambertian(albedo=0.3) + GGX(alpha_x=0.4, alpha_y=0.7)
    table = Table.bake(m, "half", "uniform", (12, 10, 10, 10), "float32", method="projection")
    clear = (WI[:, 2] > 0.2) & (WO[:, 2] > 0.2)
    np.testing.assert_allclose(table(WI, WO)[clear], m(WI, WO)[clear], rtol=0.15)


# ---- sampling ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("filter", ["linear", "catmull-rom"])
def test_sampling_is_unbiased(filter):
    """Chi-squared: directions are drawn with the density that is claimed."""
    table = Table.bake(GLOSSY, shape=10, filter=filter)
    assert sampling(table).passed


# ---- packing -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("columns", [None, 1, 5])
def test_slices_packed_and_back(columns):
    grid = np.random.default_rng(0).uniform(size=(3, 4, 5, 6, 3)).astype("f4")
    picture = pack_slices(grid, columns)
    np.testing.assert_array_equal(unpack_slices(picture, (3, 4, 5, 6)), grid)
    if columns == 5:
        assert picture.shape == (15, 30, 3)
        np.testing.assert_array_equal(picture[10:15, 6:12], grid[2, 3])  # slice 11: row 2, column 1


def test_an_atlas_is_near_a_square():
    assert pack_slices(np.zeros((16, 16, 16, 32, 3), "f4")).shape == (384, 352, 3)


def test_packing_refuses():
    with pytest.raises(ParameterError, match="larger"):
        pack_slices(np.zeros((4, 20_000, 2, 3), "u1"))
    with pytest.raises(ParameterError, match="column"):
        pack_slices(np.zeros((4, 2, 2, 3)), 0)
    with pytest.raises(ParameterError, match="does not hold"):
        unpack_slices(np.zeros((6, 6, 3)), (3, 4, 5))


# ---- refusals ----------------------------------------------------------------------------------------------------


class Broken(Reflectance):
    structure = ("broken",)

    def f(self, wi, wo):
        value = np.where(wi.z > 0.9, np.nan, wi.z)
        return Vec(value, value, value)

    def _state(self):
        raise NotImplementedError


@pytest.mark.parametrize("method", ["points", "projection"])
@pytest.mark.parametrize("storage", ["float32", "half", "10-10-10"])
def test_nan_is_refused_never_stored(method, storage):
    with pytest.raises(ReflectanceError, match="NaN"):
        Table.bake(Broken(), shape=6, storage=storage, method=method)


def test_refusals_name_the_cause():
    for arguments, error, words in (
        ({"alpha": (1.2, 0.1)}, ParameterError, r"\[0, 1\]"),
        ({"alpha": (0.2, -0.1)}, ParameterError, r"\[0, 1\]"),
        ({"alpha": (0.2, 0.1), "warp": "uniform"}, ParameterError, "no effect"),
        ({"filter": "cubist"}, UnknownNameError, "table filter"),
        ({"encoding": "cube"}, UnknownNameError, "table encoding"),
        ({"method": "magic"}, UnknownNameError, "bake method"),
        ({"shape": 3}, ParameterError, "at least 4"),
        ({"shape": (4, 4)}, ReflectanceError, "3 axes"),
        ({"shape": (4, 4, 4, 4), "filter": "catmull-rom"}, ReflectanceError, "four angles"),
    ):
        with pytest.raises(error, match=words):
            Table.bake(Lambertian(), **arguments)
    with pytest.raises(ParameterError, match="samples"):
        bake_projection(Lambertian(), named_layout("half", "bezier", (4, 4, 4)), samples=1)


def test_bilinear_lookups_in_an_atlas_are_the_trilinear_lookup():
    """As a shader reads it: two tiles, mixed; no lookup reaches across a tile's edge."""
    shape, columns = (6, 5, 7), 4
    rng = np.random.default_rng(1)
    grid = rng.normal(size=(*shape, 3))
    atlas = pack_slices(grid, columns)
    x, y, z = (np.append(rng.uniform(0, n - 1, 300), [0.0, n - 1.0]) for n in shape)
    below = np.minimum(np.floor(x), shape[0] - 2)

    def tile(k):
        rows, across = (k // columns) * shape[1] + y, (k % columns) * shape[2] + z
        return texture2d(atlas, (rows + 0.5) / atlas.shape[0], (across + 0.5) / atlas.shape[1])

    expected = texture3d(grid, *((p + 0.5) / n for p, n in zip((x, y, z), shape, strict=True)))
    for low, high, value in zip(tile(below), tile(below + 1), expected, strict=True):
        np.testing.assert_allclose(low + (high - low) * (x - below), value, atol=1e-12)


@pytest.mark.parametrize("basis", ["half", "normal"])
def test_jax_agrees_on_an_anisotropic_table(basis):
    jnp = pytest.importorskip("jax.numpy")
    table = Table.bake(GGX(alpha_x=0.3, alpha_y=0.6), basis, shape=4)
    single = np.asarray(table(jnp.asarray(WI, "float32"), jnp.asarray(WO, "float32")))
    exact = table(WI, WO)
    clear = (WI[:, 2] > 0.05) & (WO[:, 2] > 0.05)
    assert np.quantile(np.abs(single - exact)[clear] / (exact[clear] + 1e-3), 0.99) < 1e-3


def test_sampling_of_an_anisotropic_table_is_unbiased():
    assert sampling(Table.bake(GGX(alpha_x=0.3, alpha_y=0.6), shape=5)).passed
