"""Tables: interpolation on the grid, bases, encodings, storages, saving."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from tests.helpers import random_directions

from brdf.errors import CorruptFileError, ParameterError, ReflectanceError, UnknownNameError
from brdf.formula import Vec
from brdf.geometry.warps import square_root, uniform
from brdf.models import GGX, Lambertian
from brdf.reflectance import Reflectance
from brdf.representations.baking.bake import bake_points
from brdf.representations.storage import STORAGES, UNSIGNED, storage
from brdf.representations.tables.bases import HalfBasis, NormalBasis, cos_difference
from brdf.representations.tables.encoding import Encoding, Log, Plain, Root
from brdf.representations.tables.layout import Layout
from brdf.representations.tables.layouts import BASES, named_layout
from brdf.representations.tables.table import Table

HALF_PI = math.pi / 2
WI, WO = random_directions(500, 1), random_directions(500, 2)
SIGNED = [name for name in STORAGES if name not in UNSIGNED]
NAMED = [(basis, warp) for basis, (_, warps, _) in BASES.items() for warp in warps]


class Multilinear(Reflectance):
    """A made-up reflectance that is linear in theta_h, theta_d and folded phi_d each."""

    structure = ("multilinear",)

    def f(self, wi, wo):
        h, d, p = (np.arctan2(a.sine, a.cosine) for a in HalfBasis("quarter-turn").angles(wi, wo))
        value = (1 + h) * (2 - d) * (0.5 + p)
        return Vec(value, 2 * value, 0 * value + 0.25)

    def _state(self):
        raise NotImplementedError


def uniform_half(encoding=None, shape=(5, 6, 7), storage="float32"):
    return Layout(HalfBasis("quarter-turn"), (uniform(), uniform(), uniform()), shape, encoding or Encoding(), storage)


# ---- bases -------------------------------------------------------------------------------------------------------


def test_half_angles_of_a_worked_example():
    # wi at (30 deg, azimuth 0), wo at (60 deg, azimuth 90)
    wi = Vec(math.sin(math.radians(30)), 0.0, math.cos(math.radians(30)))
    wo = Vec(0.0, math.sin(math.radians(60)), math.cos(math.radians(60)))
    angles = [math.atan2(a.sine, a.cosine) for a in HalfBasis("quarter-turn").angles(wi, wo)]
    assert angles == pytest.approx([0.63191431, 0.56148196, 0.94973129], abs=1e-8)


FOLDS = ("half-turn", "mirror", "quarter-turn")


@pytest.mark.parametrize("basis", [*map(HalfBasis, FOLDS), NormalBasis()], ids=str)
def test_directions_have_the_angles_they_were_made_from(basis):
    rng = np.random.default_rng(3)
    given = [rng.uniform(0.01, extent - 0.01, 400) for extent in basis.extents]
    wi, wo = basis.directions(*given)
    np.testing.assert_allclose(np.linalg.norm(wi, axis=-1), 1, atol=1e-12)
    for angle, expected in zip(basis.angles(Vec(*wi.T), Vec(*wo.T)), given, strict=True):
        np.testing.assert_allclose(np.arctan2(angle.sine, angle.cosine), expected, atol=1e-9)
        np.testing.assert_allclose(angle.sine**2 + angle.cosine**2, 1, atol=1e-12)


def test_half_angles_are_rusinkiewicz_rotations():
    """phi_d by rotating wi with h's azimuth about z and then h's polar angle about y, as in the paper."""
    h = (WI + WO) / np.linalg.norm(WI + WO, axis=1, keepdims=True)
    theta, phi = np.arccos(h[:, 2]), np.arctan2(h[:, 1], h[:, 0])
    x = np.cos(phi) * WI[:, 0] + np.sin(phi) * WI[:, 1]
    y = -np.sin(phi) * WI[:, 0] + np.cos(phi) * WI[:, 1]
    dx = np.cos(theta) * x - np.sin(theta) * WI[:, 2]
    folded = np.mod(np.arctan2(y, dx), math.pi)
    theta_h, theta_d, phi_d = HalfBasis("half-turn").angles(Vec(*WI.T), Vec(*WO.T))
    np.testing.assert_allclose(np.arctan2(theta_h.sine, theta_h.cosine), theta, atol=1e-9)
    np.testing.assert_allclose(theta_d.cosine, np.einsum("ij,ij->i", h, WI), atol=1e-12)
    np.testing.assert_allclose(np.arctan2(phi_d.sine, phi_d.cosine), folded, atol=1e-7)


@pytest.mark.parametrize("basis", [HalfBasis("half-turn"), NormalBasis()], ids=str)
def test_moves_nodes_above_the_horizon(basis):
    axes = [np.linspace(0, e, 20) for e in basis.extents]
    grid = np.meshgrid(*axes, indexing="ij")
    wi, wo = basis.directions(*basis.above_horizon(*grid, margin=0.004))
    assert min(wi[..., 2].min(), wo[..., 2].min()) > 0
    kept_wi, kept_wo = basis.directions(*grid)
    clear = (kept_wi[..., 2] > 0.1) & (kept_wo[..., 2] > 0.1)
    np.testing.assert_allclose(wi[clear], kept_wi[clear], atol=1e-12)


@pytest.mark.parametrize("basis", [*map(HalfBasis, FOLDS), NormalBasis()], ids=str)
def test_images_have_the_same_angles(basis):
    expected = [np.arctan2(a.sine, a.cosine) for a in basis.angles(Vec(*WI.T), Vec(*WO.T))]
    images = basis.images(WI, WO)
    assert len(images) == {"half-turn": 2, "quarter-turn": 4}.get(getattr(basis, "fold", ""), 2)
    for wi, wo in images:
        angles = basis.angles(Vec(*wi.T), Vec(*wo.T))
        for angle, value in zip(angles, expected, strict=True):
            np.testing.assert_allclose(np.arctan2(angle.sine, angle.cosine), value, atol=1e-9)


def test_cos_difference():
    cosine = cos_difference(Vec(*WI.T), Vec(*WO.T))
    np.testing.assert_allclose(2 * cosine**2 - 1, np.einsum("ij,ij->i", WI, WO), atol=1e-12)


# ---- interpolation -----------------------------------------------------------------------------------------------


def test_reproduces_what_is_linear_along_its_axes():
    layout, m = uniform_half(), Multilinear()
    h, d, p = layout.nodes()
    grid = (1 + h) * (2 - d) * (0.5 + p)
    table = Table.encoded(layout, np.stack([grid, 2 * grid, 0 * grid + 0.25], -1))
    np.testing.assert_allclose(table(WI, WO), m(WI, WO), rtol=2e-6)


@pytest.mark.parametrize(("basis", "warp"), NAMED)
def test_constant_is_exact_in_every_layout(basis, warp):
    table = Table.bake(Lambertian(albedo=(0.2, 0.5, 0.9)), basis, warp, (4, 5, 6), "float32")
    np.testing.assert_allclose(table(WI, WO), np.tile(np.array([0.2, 0.5, 0.9]) / math.pi, (500, 1)), rtol=3e-7)


@pytest.mark.parametrize(("basis", "warp"), NAMED)
def test_nodes_keep_their_values(basis, warp):
    m = Lambertian(albedo=0.3) + GGX(alpha=0.4)
    table = Table.bake(m, basis, warp, (6, 7, 8), "float32")
    wi, wo = (w.reshape(-1, 3) for w in table.layout.basis.directions(*table.layout.nodes()))
    clear = (wi[:, 2] > 0.05) & (wo[:, 2] > 0.05)
    np.testing.assert_allclose(table(wi[clear], wo[clear]), m(wi[clear], wo[clear]), rtol=2e-5)


@pytest.mark.parametrize(("basis", "warp"), NAMED)
def test_error_falls_with_resolution(basis, warp):
    m = Lambertian(albedo=0.3) + GGX(alpha=0.4)
    clear = (WI[:, 2] > 0.2) & (WO[:, 2] > 0.2)
    wi, wo = WI[clear], WO[clear]
    errors = [
        np.sqrt(np.mean((Table.bake(m, basis, warp, (n, n, n), "float32")(wi, wo) - m(wi, wo)) ** 2)) for n in (8, 24)
    ]
    assert errors[1] < 0.35 * errors[0]


def test_half_basis_is_reciprocal():
    table = Table.bake(Lambertian(albedo=0.3) + GGX(alpha=0.4), shape=(9, 8, 7))
    np.testing.assert_allclose(table(WI, WO), table(WO, WI), rtol=1e-10)


def test_float32_in_float32_out_and_close():
    table = Table.bake(GGX(alpha=0.4), shape=(16, 16, 8))
    single = table(WI.astype(np.float32), WO.astype(np.float32))
    assert single.dtype == np.float32
    np.testing.assert_allclose(single, table(WI, WO), rtol=2e-4, atol=1e-6)


def test_finite_at_degenerate_directions():
    table = Table.bake(GGX(alpha=0.4), shape=(9, 8, 7))
    n, grazing = [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]
    for wi, wo in ((n, n), ([0.6, 0, 0.8], [0.6, 0, 0.8]), ([0.6, 0, 0.8], [-0.6, 0, 0.8]), (n, grazing)):
        for dtype in (np.float32, np.float64):
            assert np.isfinite(table(np.array(wi, dtype), np.array(wo, dtype))).all()


# ---- encodings and storages --------------------------------------------------------------------------------------


@pytest.mark.parametrize("transform", [Plain(), Log(1e-3), Root(2), Root(3)], ids=str)
@pytest.mark.parametrize(("power", "scale"), [(0.0, 1.0), (1.0, math.pi), (1.5, math.pi), (0.7, 1.0)])
def test_encoding_comes_back(transform, power, scale):
    rng = np.random.default_rng(4)
    encoding, floor = Encoding(transform, power, scale), np.array([0.1, 0.2, 0.0])
    f = (floor + rng.gamma(0.5, 2.0, (50, 3))) / scale
    cos_d = rng.uniform(0.05, 1, 50)
    stored = encoding.encode(f, cos_d, floor)
    decoded = encoding.decode(Vec(*stored.T), cos_d, Vec(*floor))
    np.testing.assert_allclose(np.stack(decoded.components, -1), f, rtol=1e-10)


def test_values_below_the_floor_come_back_as_the_floor():
    encoding = Encoding(Log(1e-3), 1.5, math.pi)
    stored = encoding.encode(np.zeros((1, 3)), np.array([0.5]), np.full(3, 0.2))
    decoded = encoding.decode(Vec(*stored.T), np.array([0.5]), 0.2)
    np.testing.assert_allclose(np.stack(decoded.components, -1), 0.2 / math.pi, rtol=1e-12)


def test_packed_codes_are_within_half_a_step():
    values = np.random.default_rng(5).normal(size=(4, 5, 6, 3)) * [1, 10, 0.1]
    packed = storage("10-10-10")
    codes, constants = packed.pack(values)
    assert codes.dtype == np.uint32
    assert codes.nbytes == 4 * 4 * 5 * 6
    back = constants["low"] + constants["span"] * packed.texels(codes)
    assert np.all(np.abs(back - values) <= constants["span"] / 1023 / 2 * 1.001 + 1e-6)
    assert np.all(codes >> 30 == 0)


def test_half_storage_clips_what_it_cannot_hold():
    codes, _ = storage("half").pack(np.array([[1e6, 1.0, -1e6]]))
    assert codes.dtype == np.float16
    np.testing.assert_array_equal(codes, [[65504, 1, -65504]])


@pytest.mark.parametrize("name", SIGNED)
def test_storages_agree_on_a_table(name):
    m = Lambertian(albedo=0.3) + GGX(alpha=0.4)
    layout = dataclasses.replace(named_layout("half", "merl", (12, 10, 6), "float32"), storage=name)
    exact, stored = Table.bake(m, "half", "merl", (12, 10, 6), "float32"), bake_points(m, layout)
    clear = (WI[:, 2] > 0.1) & (WO[:, 2] > 0.1)
    np.testing.assert_allclose(stored(WI, WO)[clear], exact(WI, WO)[clear], rtol=0.05 if name == "8-8-8" else 0.012)


def test_bytes_count_what_is_stored():
    m = Lambertian()
    sizes = {name: Table.bake(m, shape=(4, 5, 6), storage=name).nbytes for name in SIGNED}
    assert sizes == {"float32": 12 * 120, "half": 6 * 120, "10-10-10": 4 * 120 + 4 * 6, "8-8-8": 3 * 120 + 4 * 6}


# ---- saving, refusing --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("basis", "warp"), NAMED)
@pytest.mark.parametrize("name", SIGNED)
def test_saved_and_restored_is_the_same(tmp_path, basis, warp, name):
    table = Table.bake(Lambertian(albedo=0.3) + GGX(alpha=0.4), basis, warp, (6, 5, 4), name).named("t", "made up")
    table.save(tmp_path / "t.safetensors")
    back = Reflectance.restore(tmp_path / "t.safetensors")
    assert (back.name, back.source, back.layout, back.nbytes) == ("t", "made up", table.layout, table.nbytes)
    np.testing.assert_array_equal(back(WI, WO), table(WI, WO))


@pytest.mark.parametrize(
    "damage",
    [
        lambda h, a: h["layout"].update(shape=[6, 5, 5]),
        lambda h, a: h["layout"].update(shape=[6, 5]),
        lambda h, a: h["layout"].update(storage="papyrus"),
        lambda h, a: h["layout"]["basis"].update(kind="Spherical"),
        lambda h, a: h["layout"]["warps"][0].update(extent="wide"),
        lambda h, a: h["layout"]["warps"].pop(),
        lambda h, a: h["layout"]["encoding"].pop("scale"),
        lambda h, a: h["constants"].pop("low"),
        lambda h, a: a.pop("codes"),
        lambda h, a: a.update(codes=a["codes"].astype(np.float64)),
    ],
)
def test_broken_header_is_a_corrupt_file(tmp_path, damage):
    from brdf import container

    table = Table.bake(Lambertian(), shape=(6, 5, 4), storage="10-10-10")
    header, arrays = table.state()
    damage(header, arrays)
    container.save(tmp_path / "t.safetensors", header, arrays)
    with pytest.raises(CorruptFileError, match=r"t\.safetensors"):
        Reflectance.restore(tmp_path / "t.safetensors")


def test_refuses_anisotropic_sources():
    with pytest.raises(ReflectanceError, match="anisotropic"):
        Table.bake(GGX(alpha_x=0.1, alpha_y=0.3))


def test_refuses_unknown_names_and_impossible_shapes():
    with pytest.raises(UnknownNameError, match="basis"):
        Table.bake(Lambertian(), basis="quarter")
    with pytest.raises(UnknownNameError, match="warp of the normal basis"):
        Table.bake(Lambertian(), basis="normal", warp="merl")
    with pytest.raises(UnknownNameError, match="storage"):
        Table.bake(Lambertian(), storage="papyrus")
    with pytest.raises(ReflectanceError, match="2 nodes"):
        Table.bake(Lambertian(), shape=(4, 1, 4))
    with pytest.raises(ParameterError, match="fold"):
        HalfBasis("twice")
    with pytest.raises(ParameterError, match="offset"):
        Log(0.0)
    with pytest.raises(ParameterError, match="degree"):
        Root(4)


def test_layout_repeats_in_its_structure():
    """Tables of one layout share one compiled kernel; other layouts do not."""
    a, b = (Table.bake(Lambertian(albedo=x), shape=(4, 5, 6)) for x in (0.1, 0.9))
    assert a.structure == b.structure
    assert hash(a.structure) == hash(b.structure)
    assert a.structure != Table.bake(Lambertian(), shape=(4, 5, 7)).structure
    merl = dataclasses.replace(a.layout, warps=(square_root(), uniform(), uniform()))
    assert Table(merl, a.codes).structure != a.structure
