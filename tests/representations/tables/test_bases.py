"""Bases of tables: maps there and back, what they assume, what they weigh, what they waste."""

from __future__ import annotations

import math

import numpy as np
import pytest

from brdf.formula import Vec
from brdf.geometry.warps import Bezier, Chord, Circle, identity, square_root, uniform
from brdf.models import GGX, Lambertian
from brdf.representations.baking.bake import bake_points
from brdf.representations.tables.anisotropic import AnisotropicHalfBasis, AnisotropicNormalBasis
from brdf.representations.tables.bases import HalfBasis, NormalBasis, basis_from
from brdf.representations.tables.encoding import Encoding, Log
from brdf.representations.tables.layout import Layout
from brdf.representations.tables.specular import AnisotropicSpecularBasis, SpecularBasis
from brdf.representations.tables.triangle_bases import MarschnerBasis, ShearedBasis, StarkBasis
from helpers import random_directions

HALF_PI = math.pi / 2
WI, WO = random_directions(500, 1), random_directions(500, 2)
TRIANGLES = [ShearedBasis(), MarschnerBasis(), StarkBasis()]
ISOTROPIC = [HalfBasis("half-turn"), HalfBasis("quarter-turn"), NormalBasis(), SpecularBasis(), *TRIANGLES]
ANISOTROPIC = [
    AnisotropicHalfBasis("half-turn", "full"),
    AnisotropicHalfBasis("quarter-turn", "half"),
    AnisotropicNormalBasis("none", "full"),
    AnisotropicNormalBasis("half-turn", "half"),
    AnisotropicSpecularBasis(),
]


def angles_of(basis, wi, wo):
    return [np.arctan2(a.sine, a.cosine) for a in basis.angles(Vec(*wi.T), Vec(*wo.T))]


@pytest.mark.parametrize("basis", TRIANGLES, ids=str)
def test_directions_have_the_angles_they_were_made_from(basis):
    rng = np.random.default_rng(3)
    given = [rng.uniform(0.01, extent - 0.01, 1000) for extent in basis.extents]
    wi, wo = basis.directions(*given)
    assert min(wi[:, 2].min(), wo[:, 2].min()) > 0
    np.testing.assert_allclose(np.linalg.norm(wi, axis=-1), 1, atol=1e-12)
    for angle, expected in zip(angles_of(basis, wi, wo), given, strict=True):
        np.testing.assert_allclose(angle, expected, atol=1e-7)


@pytest.mark.parametrize("basis", ISOTROPIC, ids=str)
def test_angles_tell_the_directions_up_to_the_images(basis):
    wi, wo = basis.directions(*angles_of(basis, WI, WO))
    invariants = np.stack([wi[:, 2], wo[:, 2], np.einsum("ij,ij->i", wi, wo)])
    expected = np.stack([WI[:, 2], WO[:, 2], np.einsum("ij,ij->i", WI, WO)])
    if len(basis.images(WI, WO)) == 4 or basis == HalfBasis("half-turn"):
        invariants[:2].sort(axis=0), expected[:2].sort(axis=0)
    np.testing.assert_allclose(invariants, expected, atol=1e-9)


@pytest.mark.parametrize("basis", TRIANGLES, ids=str)
def test_images_have_the_same_angles(basis):
    images = basis.images(WI, WO)
    assert len(images) == 4
    for image in images:
        np.testing.assert_allclose(angles_of(basis, *image), angles_of(basis, WI, WO), atol=1e-9)


@pytest.mark.parametrize("basis", ISOTROPIC, ids=str)
def test_jacobian_is_the_volume_of_a_cell(basis):
    """Of (wi, wo), whose measure is d cos_i d cos_o d phi_delta times the common azimuth, by differences."""
    rng = np.random.default_rng(5)
    at = np.stack([rng.uniform(0.15, 0.85, 200) * extent for extent in basis.extents])
    wi, wo = basis.directions(*at)
    clear = (wi[:, 2] > 0.05) & (wo[:, 2] > 0.05)

    def measured(angles):
        wi, wo = basis.directions(*angles)
        sines = np.hypot(wi[:, 0], wi[:, 1]) * np.hypot(wo[:, 0], wo[:, 1])
        cross, across = wi[:, 0] * wo[:, 1] - wi[:, 1] * wo[:, 0], np.einsum("ij,ij->i", wi[:, :2], wo[:, :2])
        return np.stack([wi[:, 2], wo[:, 2], np.arctan2(cross / sines, across / sines)])

    step = 1e-5
    columns = []
    for axis in range(3):
        shift = step * np.eye(3)[axis][:, None]
        columns.append((measured(at + shift) - measured(at - shift)) / (2 * step))
    volume = np.abs(np.linalg.det(np.stack(columns).transpose(2, 0, 1)))
    kink = np.abs(np.tan(at[0]) * np.tan(at[1]) - 1) < 1e-3 if isinstance(basis, StarkBasis) else np.zeros(200, bool)
    use = clear & ~kink
    np.testing.assert_allclose(volume[use], np.broadcast_to(basis.jacobian(*at), 200)[use], rtol=1e-4)


@pytest.mark.parametrize("basis", [*ISOTROPIC, *ANISOTROPIC], ids=str)
def test_jacobian_integrates_to_both_hemispheres(basis):
    x, w = np.polynomial.legendre.leggauss(96)
    first, second, third = (extent * (x + 1) / 2 for extent in basis.extents[-3:])
    grid = first[:, None, None], second[None, :, None], third[None, None, :]
    azimuth = () if basis.isotropic else (np.zeros(1),)
    wi, wo = basis.directions(*azimuth, *grid)
    above = (wi[..., 2] > 0) & (wo[..., 2] > 0)
    weights = np.einsum("i,j,k->ijk", w, w, w) * np.prod(basis.extents[-3:]) / 8
    total = np.sum(weights * above * basis.jacobian(*azimuth, *grid))
    turn = 2 * math.pi if basis.isotropic else basis.extents[0]
    assert turn * total * len(basis.images(WI, WO)) == pytest.approx((2 * math.pi) ** 2, rel=4e-3)


def layout(basis, *warps):
    return Layout(basis, warps, (8,) * len(warps), Encoding())


def test_waste_of_the_half_vector_grid():
    """More than 38 % for even angles, as published; 64 % for even cosines; nothing for the other bases."""
    quarter, half = HalfBasis("quarter-turn"), HalfBasis("half-turn")
    assert layout(quarter, uniform(), uniform(), uniform()).wasted == pytest.approx(0.382709, abs=1e-6)
    assert layout(half, square_root(), uniform(), uniform(math.pi)).wasted == pytest.approx(0.248285, abs=1e-6)
    assert layout(quarter, identity(), identity(), uniform()).wasted == pytest.approx(2 / math.pi, abs=1e-6)
    crowded = layout(quarter, Chord(), Bezier(alpha=0.65), Bezier(alpha=0.75))
    u = np.random.default_rng(0).uniform(size=(3, 400_000))
    wi, wo = quarter.directions(*(warp.angle(x) for warp, x in zip(crowded.warps, u, strict=True)))
    assert crowded.wasted == pytest.approx(np.mean((wi[:, 2] < 0) | (wo[:, 2] < 0)), abs=2e-3)
    anisotropic = layout(AnisotropicHalfBasis(), Circle(), uniform(), uniform(), uniform(math.pi))
    assert anisotropic.wasted == pytest.approx(0.382709, abs=1e-6)
    for basis in (NormalBasis(), *TRIANGLES):
        assert layout(basis, uniform(), uniform(), uniform(basis.extents[2])).wasted == pytest.approx(0, abs=1e-12)


def test_waste_of_merls_nodes():
    h = (np.arange(90) / 90) ** 2 * HALF_PI
    d, p = np.radians(np.arange(90.0)), np.radians(np.arange(180.0))
    wi, wo = HalfBasis("half-turn").directions(h[:, None, None], d[:, None], p)
    assert np.mean((wi[..., 2] <= 1e-12) | (wo[..., 2] <= 1e-12)) == pytest.approx(0.2377, abs=5e-5)


@pytest.mark.parametrize("basis", TRIANGLES, ids=str)
def test_tables_over_triangles(basis):
    m = Lambertian(albedo=0.3) + GGX(alpha=0.4)
    warps = (uniform(), uniform(), uniform(basis.extents[2]))
    clear = (WI[:, 2] > 0.2) & (WO[:, 2] > 0.2)
    wi, wo = WI[clear], WO[clear]
    errors = []
    for n in (10, 30):
        table = bake_points(m, Layout(basis, warps, (n, n, n), Encoding(Log(1e-3))))
        assert basis_from(table.layout.basis.state) == basis
        np.testing.assert_allclose(table(wi, wo), table(wo, wi), rtol=1e-7)
        errors.append(np.sqrt(np.mean((table(wi, wo) - m(wi, wo)) ** 2)))
    assert errors[1] < 0.25 * errors[0]
