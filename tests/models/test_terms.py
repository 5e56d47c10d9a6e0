"""The parts of microfacet models against closed forms, integrals and complex arithmetic."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest

from brdf.formula.bound import Bound, bound_value
from brdf.formula.vec import Vec
from brdf.models.terms.fresnel import Conductor, Dielectric, Schlick
from brdf.models.terms.masking import SmithCorrelated, SmithSeparable
from brdf.models.terms.ndf import GGX, Beckmann, Distribution
from brdf.models.terms.powers import power_of_one_minus
from lobes import direction, half_vectors

WIDTHS = [{"alpha": 0.05}, {"alpha": 0.5}, {"alpha_x": 0.1, "alpha_y": 0.4}, {"alpha": 1.0}]


def bound(part: object, number: type = float) -> Bound:
    """A part as the formulas of a model see it."""
    return Bound(part, lambda name: bound_value(part.values[name], number))


def vec(w: np.ndarray) -> Vec:
    return Vec(*np.moveaxis(w, -1, 0))


@pytest.mark.parametrize("ndf", [GGX, Beckmann])
@pytest.mark.parametrize("widths", WIDTHS, ids=repr)
def test_distribution_integrates_to_one(ndf: type[Distribution], widths: dict[str, float]) -> None:
    h, solid_angle = half_vectors(200, 60, 1e-5)
    assert np.sum(bound(ndf(**widths)).D(vec(h)) * h[:, 2] * solid_angle) == pytest.approx(1, abs=1e-6)


@pytest.mark.parametrize("ndf", [GGX, Beckmann])
@pytest.mark.parametrize("widths", WIDTHS, ids=repr)
@pytest.mark.parametrize("theta", [0, 40, 75, 89, 90])
def test_projected_area_is_that_of_the_facets(ndf: type[Distribution], widths: dict[str, float], theta: float) -> None:
    w = direction(theta, 35.0)
    part = bound(ndf(**widths))
    h, solid_angle = half_vectors(200, 180, 1e-4)
    integral = np.sum(part.D(vec(h)) * np.maximum(h @ w, 0) * solid_angle)
    tolerance = 5e-4 if ndf is GGX else 4e-3  # Walter's rational Lambda is good to 0.35 %
    assert part.projected_area(vec(w)) == pytest.approx(integral, rel=tolerance)


@pytest.mark.parametrize("ndf", [GGX, Beckmann])
@pytest.mark.parametrize("masking", [SmithCorrelated, SmithSeparable])
def test_masking_lies_between_nothing_and_the_worse_direction(ndf: type[Distribution], masking: type) -> None:
    rng = np.random.default_rng(2)
    cosine, phi = rng.uniform(1e-3, 1, (2, 5000)), rng.uniform(0, 7, (2, 5000))
    sine = np.sqrt(1 - cosine**2)
    wi, wo = (Vec(sine[i] * np.cos(phi[i]), sine[i] * np.sin(phi[i]), cosine[i]) for i in (0, 1))
    part = bound(ndf(alpha=0.4))
    G = masking().visibility(part, wi, wo) * wi.z * wo.z
    G1 = [w.z / part.projected_area(w) for w in (wi, wo)]
    assert (G > 0).all()
    # Walter's rational Lambda dips to -6e-5 where it meets 0
    assert (np.minimum(*G1) * (1 + 1e-4) >= G).all()
    # G1 G1 is the least: heights that go together unmask each other
    assert (np.multiply(*G1) * (1 - 1e-4) <= G).all()


def test_correlated_masking_in_closed_form() -> None:
    # GGX, alpha = 1: Lambda = (1/cos - 1) / 2
    wi, wo = direction(60.0), direction(45.0)
    lambdas = [(1 / w[2] - 1) / 2 for w in (wi, wo)]
    visibility = SmithCorrelated().visibility(bound(GGX(alpha=1.0)), vec(wi), vec(wo))
    assert visibility * wi[2] * wo[2] == pytest.approx(1 / (1 + sum(lambdas)), rel=1e-14)


@pytest.mark.parametrize("ndf", [GGX, Beckmann])
def test_terms_stay_finite_at_the_horizon_in_single_precision(ndf: type[Distribution]) -> None:
    tiny = np.float32([1e-3, 1e-6, 1e-12, 1e-20])
    w = Vec(np.float32(1), np.float32(0), tiny)
    for alpha in (1e-4, 1.0):
        part = bound(ndf(alpha=alpha), np.float32)
        assert np.isfinite(part.D(w)).all()
        assert (part.projected_area(w) > 0).all()
        for masking in (SmithCorrelated(), SmithSeparable()):
            assert np.isfinite(masking.visibility(part, w, Vec(np.float32(0), np.float32(0), np.float32(1)))).all()


COSINES = np.array([1e-6, 1e-3, 0.1, 0.35, 0.6, 0.9, 0.999999, 1.0])


@pytest.mark.parametrize("eta", [1.0, 1.0001, 1.33, 1.5, 4.0])
def test_dielectric_against_snell_and_fresnel(eta: float) -> None:
    theta_i = np.arccos(COSINES)
    cos_t = np.cos(np.arcsin(np.sin(theta_i) / eta))
    r_s = (COSINES - eta * cos_t) / (COSINES + eta * cos_t)
    r_p = (eta * COSINES - cos_t) / (eta * COSINES + cos_t)
    F = bound(Dielectric(eta=eta)).F(COSINES)
    np.testing.assert_allclose(F[0], (r_s**2 + r_p**2) / 2, rtol=1e-7, atol=1e-9)
    single = bound(Dielectric(eta=np.float32(eta)), np.float32).F(COSINES.astype(np.float32))
    double = bound(Dielectric(eta=np.float32(eta))).F(COSINES.astype(np.float32).astype(float))
    np.testing.assert_allclose(single[0], double[0], rtol=1e-5)


@pytest.mark.parametrize(("eta", "k"), [(0.2, 3.91), (0.05, 4.2), (1.5, 0.0), (2.9, 3.1), (0.5, 0.1), (20.0, 20.0)])
def test_conductor_against_complex_arithmetic(eta: float, k: float) -> None:
    n = complex(eta, k)
    cos_t = np.sqrt(1 - (1 - COSINES**2) / n**2)
    r_s = (COSINES - n * cos_t) / (COSINES + n * cos_t)
    r_p = (n * COSINES - cos_t) / (n * COSINES + cos_t)
    expected = (np.abs(r_s) ** 2 + np.abs(r_p) ** 2) / 2
    np.testing.assert_allclose(bound(Conductor(eta=eta, k=k)).F(COSINES)[1], expected, rtol=1e-10)
    single = bound(Conductor(eta=eta, k=k), np.float32).F(COSINES.astype(np.float32))[1]
    np.testing.assert_allclose(single, expected, rtol=2e-5)


def test_schlick_ends() -> None:
    F = bound(Schlick(F0=(0.04, 0.5, 1.0))).F(np.array([0.0, 0.5, 1.0]))
    np.testing.assert_allclose(F[0], [1.0, 0.04 + 0.96 / 32, 0.04])
    np.testing.assert_allclose(F[2], 1.0)


@pytest.mark.parametrize("part", [Schlick(), Dielectric(), Dielectric(eta=1.0), Conductor(), Conductor(eta=1e-3, k=0)])
def test_fresnel_takes_a_cosine_rounded_past_one(part: object) -> None:
    cosine = np.float32([0, 1e-30, 1e-7, 1, 1.0000001])[1:]
    for channel in bound(part, np.float32).F(cosine):
        assert ((channel >= 0) & (channel <= 1.000001)).all()


@pytest.mark.parametrize("n", [0.0, 0.5, 3.0, 400.0, 1.2e5])
def test_power_of_one_minus_against_many_digits(n: float) -> None:
    d = np.concatenate([10.0 ** np.arange(-9, 0), [0.0, 0.0499, 0.0501, 0.3, 0.9, 1.0]])
    expected = [float(mpmath.power(1 - mpmath.mpf(x), n)) for x in d]
    expected[-1] = 0.0 if n > 0.5 else expected[-1]
    np.testing.assert_allclose(power_of_one_minus(d[:-1], n), expected[:-1], rtol=1e-11, atol=1e-300)
    d32 = d.astype(np.float32)[:-1]
    exact = [float(mpmath.power(1 - mpmath.mpf(float(x)), n)) for x in d32]
    np.testing.assert_allclose(power_of_one_minus(d32, np.float32(n)), exact, rtol=3e-5, atol=1e-12)
