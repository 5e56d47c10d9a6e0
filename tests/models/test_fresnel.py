"""Fresnel terms beside the exact ones of `test_terms`: from inside, Schlick with F90, F0 to eta, painted curves."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from brdf import Reflectance
from brdf.errors import ParameterError
from brdf.formula.bound import Bound, bound_value
from brdf.models import Microfacet
from brdf.models.terms.fresnel import TERMS, CookTorranceF0, Dielectric, SchlickF90, Table
from lobes import direction, random_pairs

COSINES = np.array([1e-6, 1e-3, 0.1, 0.35, 0.6, 0.9, 0.999999, 1.0])


def F(part: Any, cosine: np.ndarray, number: type = float) -> np.ndarray:
    """(3, N) the term as the formulas of a model see it."""

    def lookup(name: str) -> Any:
        return bound_value(part.values[name], number) if name in part.values else part.textures[name]

    return np.array([np.broadcast_to(channel, cosine.shape) for channel in Bound(part, lookup).F(cosine)])


def exact(cosine: np.ndarray, n: complex) -> np.ndarray:
    """Unpolarised reflectance by the textbook's amplitudes, in complex arithmetic."""
    cos_t = np.sqrt(1 - (1 - cosine**2) / n**2 + 0j)
    r_s, r_p = (cosine - n * cos_t) / (cosine + n * cos_t), (n * cosine - cos_t) / (n * cosine + cos_t)
    return (np.abs(r_s) ** 2 + np.abs(r_p) ** 2) / 2


@pytest.mark.parametrize("eta", [0.25, 0.5, 0.75, 0.999])
def test_dielectric_from_inside(eta: float) -> None:
    cosines = np.linspace(1e-3, 1, 400)
    values = F(Dielectric(eta=eta), cosines)[0]
    np.testing.assert_allclose(values, exact(cosines, eta), rtol=1e-9)
    beyond = cosines < np.sqrt(1 - eta**2)
    assert beyond.any()
    np.testing.assert_array_equal(values[beyond], 1)
    single = F(Dielectric(eta=eta), cosines.astype(np.float32), np.float32)[0]
    assert np.isfinite(single).all()
    off_critical = np.abs(cosines**2 - (1 - eta**2)) > 1e-3
    np.testing.assert_allclose(single[off_critical], values[off_critical], rtol=1e-3)


def test_dielectric_reflects_alike_from_both_sides() -> None:
    """At the two ends of one refracted ray the reflectance is the same."""
    inside = np.sqrt(1 - (1 - COSINES**2) / 1.5**2)
    np.testing.assert_allclose(F(Dielectric(eta=1.5), COSINES), F(Dielectric(eta=1 / 1.5), inside), rtol=1e-5)


def test_schlick_with_f90() -> None:
    part = SchlickF90(F0=(0.04, 0.5, 0.2), F90=(0.3, 1.0, 0.2))
    np.testing.assert_allclose(F(part, np.array([0.0, 0.5, 1.0]))[0], [0.3, 0.04 + 0.26 / 32, 0.04])
    np.testing.assert_allclose(F(part, COSINES)[2], 0.2)
    np.testing.assert_allclose(F(SchlickF90(F0=0.1), COSINES), F(TERMS["schlick"](F0=0.1), COSINES))


@pytest.mark.parametrize("F0", [0.001, 0.04, 0.2, 0.5, 0.9])
def test_cook_torrance_is_the_dielectric_through_f0(F0: float) -> None:
    eta = (1 + np.sqrt(F0)) / (1 - np.sqrt(F0))
    values = F(CookTorranceF0(F0=F0), COSINES)
    np.testing.assert_allclose(values[1], exact(COSINES, eta), rtol=1e-9)
    np.testing.assert_allclose(values[0][-1], F0, rtol=1e-12)
    # the paper's own form of the same curve
    g = np.sqrt(eta**2 + COSINES**2 - 1)
    ratio = (COSINES * (g + COSINES) - 1) / (COSINES * (g - COSINES) + 1)
    np.testing.assert_allclose(values[2], 0.5 * ((g - COSINES) / (g + COSINES)) ** 2 * (1 + ratio**2), rtol=1e-8)


@pytest.mark.parametrize("number", [np.float32, np.float64])
def test_cook_torrance_at_the_ends_of_its_bounds(number: type) -> None:
    cosines = COSINES.astype(number)
    np.testing.assert_array_equal(F(CookTorranceF0(F0=0.0), cosines, number), 0)
    perfect = F(CookTorranceF0(F0=1.0), cosines, number)
    assert np.isfinite(perfect).all()
    np.testing.assert_allclose(perfect[:, -1], 1, atol=2e-6)


def test_table_is_linear_between_its_samples() -> None:
    curve = np.random.default_rng(0).random((7, 3)).astype(np.float32)
    cosines = np.linspace(0, 1, 101)
    expected = [np.interp(cosines, np.linspace(0, 1, 7), channel) for channel in curve.T.astype(float)]
    np.testing.assert_allclose(F(Table(table=curve), cosines), expected, atol=1e-6)
    np.testing.assert_allclose(F(Table(table=curve), np.array([-0.1, 1.1])).T, curve[[0, -1]], atol=1e-6)


PAINTED = np.linspace([0.9, 0.1, 0.9], [0.1, 0.8, 0.1], 9)


def test_microfacet_with_a_painted_curve(tmp_path: object) -> None:
    m = Microfacet(fresnel="table", table=PAINTED, alpha=0.3)
    wi, wo = direction(40), direction(40, 180)
    mirror = Microfacet(fresnel="schlick", F0=1.0, alpha=0.3)(wi, wo)
    cosine = np.cos(np.radians(40))
    np.testing.assert_allclose(m(wi, wo), mirror * (PAINTED[0] + cosine * (PAINTED[-1] - PAINTED[0])), rtol=1e-6)
    m.save(f"{tmp_path}/m.safetensors")
    back = Reflectance.restore(f"{tmp_path}/m.safetensors")
    np.testing.assert_array_equal(back(wi, wo), m(wi, wo))
    np.testing.assert_array_equal(m.replaced(alpha=0.1).table, PAINTED.astype(np.float32))


def test_painted_curve_compiles() -> None:
    m = Microfacet(fresnel="table", table=PAINTED, alpha=0.3)
    wi, wo = random_pairs(24_000)
    np.testing.assert_allclose(m(wi, wo)[:9000], m(wi[:9000], wo[:9000]), rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize(
    "table", [np.ones((4, 2)), np.ones(5), [[0.1] * 3], np.full((3, 3), 1.5), np.full((3, 3), np.nan)]
)
def test_no_curve(table: Any) -> None:
    with pytest.raises(ParameterError, match="table must"):
        Microfacet(fresnel="table", table=table)
    with pytest.raises(ParameterError, match="table has no effect with fresnel='schlick'; it belongs to"):
        Microfacet(table=PAINTED)


@pytest.mark.parametrize("name", TERMS)
def test_every_term_stays_within_bounds(name: str) -> None:
    values = F(TERMS[name](), np.float32([1e-30, 1e-7, 0.5, 1, 1.0000001]), np.float32)
    assert ((values >= 0) & (values <= 1.000001)).all()
