"""Parameters that change over the surface, two sides, copies for fitting."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import brdf
from brdf import laws
from brdf.combinators import Scaled, SpatiallyVarying, Sum, TwoSided
from brdf.errors import DirectionError, ParameterError, ReflectanceError, UnknownNameError
from brdf.formula import engine
from brdf.models import GGX, Lambertian, Microfacet, Mirror, OrenNayar, SmoothDielectric
from brdf.reflectance import Reflectance
from lobes import direction, random_pairs

LAWS = {law.name: law for law in laws.ALL}
RNG = np.random.default_rng(3)
ALPHA, COLOUR = RNG.uniform(0.05, 0.8, (4, 5)), RNG.uniform(0, 1, (3, 2, 3))
MIXED = SpatiallyVarying(0.5 * Lambertian() + GGX(), lobe2_alpha=ALPHA, lobe1_base_albedo=COLOUR)


def test_texel_centres_have_the_texels_values_first_row_at_the_top() -> None:
    m = SpatiallyVarying(Lambertian(), albedo=COLOUR)
    for row in range(3):
        for column in range(2):
            uv = ((column + 0.5) / 2, 1 - (row + 0.5) / 3)
            np.testing.assert_allclose(m(direction(20), direction(50), uv), COLOUR[row, column] / np.pi, rtol=1e-6)


def test_between_texels_parameters_are_linear_and_not_values() -> None:
    m = SpatiallyVarying(GGX(), alpha=[[0.1, 0.5]])
    wi, wo = direction(10), direction(20, 180)
    np.testing.assert_allclose(m(wi, wo, (0.5, 0.3)), GGX(alpha=0.3)(wi, wo), rtol=1e-6)
    assert repr(m.at((0.5, 0.3))) == repr(GGX(alpha=float(np.float32(0.1) + (np.float32(0.5) - np.float32(0.1)) / 2)))


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_kernel_formula_and_single_places_agree(dtype: type) -> None:
    wi, wo = (w.astype(dtype) for w in random_pairs(engine.SMALL))
    uv = RNG.random((len(wi), 2)).astype(dtype)
    compiled = MIXED(wi, wo, uv)
    assert compiled.dtype == dtype
    some = np.arange(0, len(wi), 97)
    np.testing.assert_allclose(
        MIXED(wi[some], wo[some], uv[some]), compiled[some], rtol=1e-10 if dtype is np.float64 else 2e-4
    )
    if dtype is np.float64:
        for i in some[:40]:
            np.testing.assert_allclose(MIXED.at(uv[i])(wi[i], wo[i]), compiled[i], rtol=1e-9)


def test_foreign_arrays_vary_too() -> None:
    jnp = pytest.importorskip("jax.numpy")
    wi, wo = random_pairs(50)
    uv = RNG.random((50, 2))
    theirs = MIXED(*(jnp.asarray(a, jnp.float32) for a in (wi, wo, uv)))
    np.testing.assert_allclose(np.asarray(theirs), MIXED(wi, wo, uv), rtol=2e-3, atol=1e-5)


def test_without_a_place_the_middle_counts_and_sums_hand_places_on() -> None:
    wi, wo = random_pairs(20)
    np.testing.assert_array_equal(MIXED(wi, wo), MIXED(wi, wo, (0.5, 0.5)))
    total = 0.3 * MIXED + OrenNayar()
    uv = RNG.random((20, 2))
    assert total.varies
    np.testing.assert_allclose(total(wi, wo, uv), 0.3 * MIXED(wi, wo, uv) + OrenNayar()(wi, wo), rtol=1e-12)


@pytest.mark.parametrize("uv", [(0.1, 0.9), (0.9, 0.1)])
def test_samples_integrate_to_the_albedo_of_the_place(uv: tuple[float, float]) -> None:
    wo = direction(40)
    drawn = MIXED.sample(wo, RNG.random((40_000, 2)), uv)
    error = drawn.weight.std(0) / 200
    assert (np.abs(drawn.weight.mean(0) - MIXED.at(uv).albedo(wo, 16384)) < 5 * error + 1e-3).all()
    np.testing.assert_array_equal(drawn.pdf, MIXED.pdf(drawn.wi, wo, uv))


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("m", [MIXED, TwoSided(GGX(alpha=0.3), Lambertian()), TwoSided(Mirror())], ids=lambda m: m.name)
def test_laws_hold(m: Reflectance, law: str) -> None:
    assert LAWS[law](m).status == "holds"


def test_saved_and_restored(tmp_path: Path) -> None:
    wi, wo = random_pairs(30)
    uv = RNG.random((30, 2))
    for m in (MIXED, TwoSided(MIXED, GGX(alpha=0.2)), TwoSided(GGX())):
        m.save(tmp_path / "m.safetensors")
        np.testing.assert_array_equal(Reflectance.restore(tmp_path / "m.safetensors")(wi, wo, uv), m(wi, wo, uv))


def test_a_rendered_checkerboard_is_one() -> None:
    board = SpatiallyVarying(Lambertian(), albedo=[[0.0, 1.0], [1.0, 0.0]])
    image = brdf.render(board, mesh="plane", env=1.0, size=(64, 64), samples=4, shadows=False, background=(0, 0, 0))
    pixels = image.pixels[..., 1]
    assert pixels.max() > 0.8
    seen = pixels > 0
    assert np.mean(pixels[seen] < 0.3) > 0.1


def test_what_cannot_vary_is_refused() -> None:
    with pytest.raises(UnknownNameError, match="unknown parameter to vary 'alfa': did you mean 'alpha'"):
        SpatiallyVarying(GGX(), alfa=[[0.1]])
    with pytest.raises(ParameterError, match=r"the map of alpha must lie in \[0.0001, 1\]"):
        SpatiallyVarying(GGX(), alpha=[[0.1, 2.0]])
    with pytest.raises(ParameterError, match=r"the map of alpha must be \(rows, columns, 1\), got \(2,\)"):
        SpatiallyVarying(GGX(), alpha=[0.1, 0.2])
    with pytest.raises(ParameterError, match="a map for at least one"):
        SpatiallyVarying(GGX())
    with pytest.raises(ReflectanceError, match="no delta events"):
        SpatiallyVarying(0.5 * Mirror() + GGX(), lobe2_alpha=[[0.1]])
    with pytest.raises(DirectionError, match=r"uv must have shape \(..., 2\), got \(3,\)"):
        MIXED(direction(0), direction(0), (0, 0, 0))


# ---- two sides ---------------------------------------------------------------------------------------------------


def test_each_side_is_its_material_and_nothing_passes() -> None:
    front, back = GGX(alpha_x=0.1, alpha_y=0.4), OrenNayar(sigma=0.6)
    m, flip = TwoSided(front, back), np.array([1, 1, -1])
    wi, wo = random_pairs(300)
    np.testing.assert_allclose(m(wi, wo), front(wi, wo), rtol=1e-12)
    np.testing.assert_allclose(m(wi * flip, wo * flip), back(wi, wo), rtol=1e-12)
    assert (m(wi * flip, wo) == 0).all()
    assert (m(wi, wo * flip) == 0).all()
    alike = TwoSided(front)
    np.testing.assert_allclose(alike(wi * flip, wo * flip), front(wi, wo), rtol=1e-12)


def test_sides_must_not_transmit() -> None:
    with pytest.raises(ReflectanceError, match="the back of a two-sided reflectance must not transmit"):
        TwoSided(GGX(), SmoothDielectric())


# ---- copies ------------------------------------------------------------------------------------------------------


def test_copies_are_the_whole_and_have_parameters_of_their_own() -> None:
    m = Microfacet(ndf="beckmann", alpha=0.2).lobes(3)
    wi, wo = random_pairs(50)
    np.testing.assert_allclose(m(wi, wo), Microfacet(ndf="beckmann", alpha=0.2)(wi, wo), rtol=1e-12, atol=1e-300)
    assert isinstance(m, Sum)
    assert {"lobe1_scale", "lobe3_base_alpha"} <= m.values.keys()
    assert all(isinstance(lobe, Scaled) for lobe in m.children.values())
    for count in (0, 1.5):
        with pytest.raises(ParameterError, match="lobes must be a whole number"):
            GGX().lobes(count)
