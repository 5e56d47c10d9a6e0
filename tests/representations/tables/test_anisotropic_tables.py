"""Tables over four angles: their bases, the circle of the azimuth, baking, saving."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from brdf.errors import CorruptFileError, ParameterError, ReflectanceError, UnknownNameError
from brdf.formula import Vec, kernels
from brdf.geometry.warps import Bezier, Circle, TwoSided, uniform
from brdf.models import GGX, Lambertian
from brdf.reflectance import Reflectance
from brdf.representations.tables.anisotropic import AnisotropicHalfBasis, AnisotropicNormalBasis
from brdf.representations.tables.bases import HalfBasis
from brdf.representations.tables.encoding import Encoding
from brdf.representations.tables.layout import Layout
from brdf.representations.tables.layouts import ANISOTROPIC_BASES
from brdf.representations.tables.table import Table
from helpers import random_directions, relative_error

WI, WO = random_directions(600, 1), random_directions(600, 2)
BRUSHED = Lambertian(albedo=(0.1, 0.2, 0.3)) + GGX(alpha_x=0.25, alpha_y=0.6)
NAMED = [(basis, warp) for basis, (_, warps, _) in ANISOTROPIC_BASES.items() for warp in warps]
BASES = [
    *(AnisotropicHalfBasis(fold, turn) for fold in ("half-turn", "quarter-turn") for turn in ("full", "half")),
    *(AnisotropicNormalBasis(fold, turn) for fold in ("none", "half-turn") for turn in ("full", "half")),
]


def angles_of(basis, wi, wo):
    found = [np.arctan2(a.sine, a.cosine) for a in basis.angles(Vec(*wi.T), Vec(*wo.T))]
    return [np.mod(angle, 2 * math.pi) for angle in found]


def layout_of(basis, shape):
    last = TwoSided() if basis.extents[3] > 4 else uniform(basis.extents[3])
    return Layout(basis, (Circle(basis.extents[0]), uniform(), uniform(), last), shape, Encoding())


@pytest.mark.parametrize("basis", BASES, ids=str)
def test_directions_have_the_angles_they_were_made_from(basis):
    rng = np.random.default_rng(3)
    given = [rng.uniform(0.01, extent - 0.01, 400) for extent in (2 * math.pi, *basis.extents[1:])]
    wi, wo = basis.directions(*given)
    np.testing.assert_allclose(np.linalg.norm(wi, axis=-1), 1, atol=1e-12)
    for found, expected in zip(angles_of(basis, wi, wo), given, strict=True):
        np.testing.assert_allclose(found, expected, atol=1e-9)


def test_half_angles_are_rusinkiewicz_rotations():
    """The difference vector by rotating wi with h's azimuth about z, then with h's polar angle about y."""
    h = (WI + WO) / np.linalg.norm(WI + WO, axis=1, keepdims=True)
    theta, phi = np.arccos(h[:, 2]), np.arctan2(h[:, 1], h[:, 0])
    x, y = np.cos(phi) * WI[:, 0] + np.sin(phi) * WI[:, 1], -np.sin(phi) * WI[:, 0] + np.cos(phi) * WI[:, 1]
    dx, dz = np.cos(theta) * x - np.sin(theta) * WI[:, 2], np.sin(theta) * x + np.cos(theta) * WI[:, 2]
    expected = [phi % (2 * math.pi), theta, np.arccos(dz), np.arctan2(y, dx) % math.pi]
    for found, angle in zip(angles_of(AnisotropicHalfBasis(), WI, WO), expected, strict=True):
        np.testing.assert_allclose(found, angle, atol=1e-7)


def test_three_of_the_angles_are_those_of_the_isotropic_basis():
    for fold in ("half-turn", "quarter-turn"):
        for a, b in zip(
            angles_of(AnisotropicHalfBasis(fold), WI, WO)[1:], angles_of(HalfBasis(fold), WI, WO), strict=True
        ):
            np.testing.assert_allclose(a, b, atol=1e-7)


@pytest.mark.parametrize("basis", BASES, ids=str)
def test_images_lie_at_one_place_of_the_grid(basis):
    layout = layout_of(basis, (8, 5, 6, 7))
    images = basis.images(WI, WO)
    swaps = 2 if isinstance(basis, AnisotropicHalfBasis) else 1
    folded = 2 if basis.fold == ("quarter-turn" if swaps == 2 else "half-turn") else 1
    assert len(images) == swaps * folded * (2 if basis.turn == "half" else 1)
    grid = np.random.default_rng(0).uniform(size=(*layout.shape, 1)).reshape(*layout.texture_shape, 1)
    values = [layout.fetch(grid, basis.angles(Vec(*wi.T), Vec(*wo.T)))[0] for wi, wo in images]
    for value in values[1:]:
        np.testing.assert_allclose(value, values[0], atol=1e-7)


def test_fetch_is_linear_in_all_four_positions_and_wraps():
    """Against the definition: 16 corners, the azimuth modulo its number of nodes."""
    basis = AnisotropicNormalBasis("half-turn")
    layout = layout_of(basis, (6, 4, 5, 3))
    grid = np.random.default_rng(1).normal(size=(*layout.shape, 2))
    angles = basis.angles(Vec(*WI.T), Vec(*WO.T))
    positions = np.stack(layout.positions(angles))
    assert positions[0].max() > 5.5
    expected = np.zeros((600, 2))
    for corner in np.ndindex(2, 2, 2, 2):
        index = np.minimum(np.floor(positions).astype(int), np.array([9, 2, 3, 1])[:, None]) + np.array(corner)[:, None]
        weight = np.prod(np.maximum(1 - np.abs(positions - index), 0), axis=0)
        expected += weight[:, None] * grid[index[0] % 6, index[1], index[2], index[3]]
    found = layout.fetch(grid.reshape(*layout.texture_shape, 2), angles)
    np.testing.assert_allclose(np.stack(found.components, -1), expected, atol=1e-12)


@pytest.mark.parametrize(("basis", "warp"), NAMED)
def test_constant_is_exact_and_nodes_keep_their_values(basis, warp):
    flat = Table.bake(Lambertian(albedo=(0.2, 0.5, 0.9)), basis, warp, (4, 5, 6, 5), "float32")
    np.testing.assert_allclose(flat(WI, WO), np.tile(np.array([0.2, 0.5, 0.9]) / math.pi, (600, 1)), rtol=3e-7)
    table = Table.bake(BRUSHED, basis, warp, (5, 6, 7, 8), "float32")
    assert not table.isotropic
    wi, wo = (w.reshape(-1, 3) for w in table.layout.basis.directions(*table.layout.nodes()))
    clear = (wi[:, 2] > 0.05) & (wo[:, 2] > 0.05)
    first = np.broadcast_to(table.layout.nodes()[1], table.layout.shape).ravel()
    clear &= first > 0  # at the pole the azimuth of a node is one of many names for one place
    np.testing.assert_allclose(table(wi[clear], wo[clear]), BRUSHED(wi[clear], wo[clear]), rtol=3e-5)


@pytest.mark.parametrize("basis", ["half", "normal"])
def test_error_falls_with_resolution(basis):
    clear = (WI[:, 2] > 0.2) & (WO[:, 2] > 0.2)
    wi, wo = WI[clear], WO[clear]
    m = Lambertian(albedo=0.3) + GGX(alpha_x=0.5, alpha_y=0.8)
    tables = [Table.bake(m, basis, "uniform", (n, n, n, n), "float32") for n in (8, 24)]
    errors = [np.sqrt(np.mean((table(wi, wo) - m(wi, wo)) ** 2)) for table in tables]
    assert errors[1] < 0.35 * errors[0]


def test_half_turn_of_the_azimuth_needs_half_the_nodes():
    """A microfacet lobe is the same turned by half a turn: the same nodes, the same values."""
    full = layout_of(AnisotropicHalfBasis("half-turn", "full"), (12, 8, 8, 8))
    half = layout_of(AnisotropicHalfBasis("half-turn", "half"), (6, 8, 8, 8))
    from brdf.representations.baking.bake import bake_points

    np.testing.assert_allclose(bake_points(BRUSHED, half)(WI, WO), bake_points(BRUSHED, full)(WI, WO), rtol=1e-6)


def test_half_basis_is_reciprocal():
    table = Table.bake(BRUSHED, shape=(8, 9, 8, 7))
    np.testing.assert_allclose(table(WI, WO), table(WO, WI), rtol=1e-9)


@pytest.mark.parametrize("basis", ["half", "normal"])
def test_continuous_where_azimuths_are_not_defined(basis):
    """Around the normal, and around equal directions, the choice of an arbitrary azimuth does not show."""
    table = Table.bake(BRUSHED, basis, "uniform", (16, 17, 17, 33), "float32")
    n, w = np.array([0.0, 0.0, 1.0]), np.array([0.48, 0.36, 0.8])
    mirror = w * [-1, -1, 1]
    for wi, wo in ((n, w), (w, n), (w, mirror), (n, n)):
        phi = np.linspace(0, 2 * math.pi, 50)
        near = wi + 1e-5 * np.stack([np.cos(phi), np.sin(phi), 0 * phi], -1)
        near /= np.linalg.norm(near, axis=1, keepdims=True)
        np.testing.assert_allclose(table(near, wo), np.tile(table(wi, wo), (50, 1)), rtol=2e-2)
        single = table(near.astype("f4"), np.tile(wo, (50, 1)).astype("f4"))
        np.testing.assert_allclose(single, table(near, wo), rtol=4e-3)


@pytest.mark.parametrize("basis", ["half", "normal"])
def test_kernels_agree_with_numpy(basis):
    table = Table.bake(BRUSHED, basis, shape=(7, 6, 5, 8))
    exact = table(WI, WO)
    np.testing.assert_allclose(kernels.evaluate(table, WI, WO, True), exact, rtol=1e-9)
    single = kernels.evaluate(table, WI.astype("f4"), WO.astype("f4"), True)
    assert np.quantile(relative_error(single, exact), 0.99) < 2e-4


def test_masks_know_all_four_axes():
    layout = layout_of(AnisotropicHalfBasis(), (4, 4, 4, 4))
    measured = np.ones(layout.shape, np.bool_)
    measured[1] = False
    table = Table(layout, np.ones((*layout.shape, 3), np.float32), measured=measured)
    phi_h = angles_of(layout.basis, WI, WO)[0] / (math.pi / 2)
    np.testing.assert_array_equal(table.valid(WI, WO), np.abs(phi_h - 1) >= 0.5)


@pytest.mark.parametrize(("basis", "warp"), NAMED)
def test_saved_and_restored_is_the_same(tmp_path, basis, warp):
    table = Table.bake(BRUSHED, basis, warp, (4, 5, 6, 7))
    table.save(tmp_path / "t.safetensors")
    back = Reflectance.restore(tmp_path / "t.safetensors")
    assert (back.layout, back.nbytes) == (table.layout, table.nbytes)
    np.testing.assert_array_equal(back(WI, WO), table(WI, WO))


def test_a_lying_header_is_a_corrupt_file(tmp_path):
    from brdf import container

    header, arrays = Table.bake(BRUSHED, shape=(4, 5, 6, 7)).state()
    for damage in ({"shape": [4, 5, 6, 8]}, {"shape": [5, 6, 7]}, {"warps": header["layout"]["warps"][1:]}):
        broken = header | {"layout": header["layout"] | damage}
        container.save(tmp_path / "t.safetensors", broken, arrays)
        with pytest.raises(CorruptFileError, match=r"t\.safetensors"):
            Reflectance.restore(tmp_path / "t.safetensors")


def test_refuses_what_does_not_fit():
    with pytest.raises(ReflectanceError, match="anisotropic"):
        Table.bake(BRUSHED, shape=(8, 8, 8))
    with pytest.raises(UnknownNameError, match="warp of the half basis"):
        Table.bake(BRUSHED, warp="identity", shape=(4, 4, 4, 4))
    layout = layout_of(AnisotropicHalfBasis(), (4, 4, 4, 4))
    with pytest.raises(ReflectanceError, match="Circle"):
        dataclasses.replace(layout, warps=(uniform(), *layout.warps[1:]))
    with pytest.raises(ReflectanceError, match="extent"):
        dataclasses.replace(layout, warps=(Circle(math.pi), *layout.warps[1:]))
    with pytest.raises(ReflectanceError, match="4 axes"):
        dataclasses.replace(layout, shape=(4, 4, 4))
    for make in (
        lambda: AnisotropicHalfBasis("thrice"),
        lambda: AnisotropicNormalBasis("quarter-turn"),
        lambda: AnisotropicHalfBasis(turn="double"),
        lambda: Circle(1.0),
        lambda: TwoSided(half=uniform()),
        lambda: TwoSided(math.pi, Bezier(math.pi)),
    ):
        with pytest.raises(ParameterError):
            make()
