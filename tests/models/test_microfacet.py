"""Microfacet models freely mixed: every distribution against its integrals, every combination traced and finite."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from scipy.special import beta

import brdf
from brdf.errors import ParameterError
from brdf.formula.bound import Bound, bound_value
from brdf.formula.trace import trace
from brdf.formula.vec import Vec
from brdf.geometry.quadrature import half_vector_rule
from brdf.models import GGX, Microfacet
from brdf.models.terms.fresnel import TERMS
from brdf.models.terms.masking import MASKINGS
from brdf.models.terms.ndf import DISTRIBUTIONS, Distribution
from lobes import direction, half_vectors, random_pairs

H, SOLID_ANGLE = half_vectors(300, 60, 1e-6)

PARTS = {
    f"{name} {values}": DISTRIBUTIONS[name](**values)
    for name, values in [
        *((name, {}) for name in DISTRIBUTIONS),
        ("blinn-phong", {"n": 0.0}), ("blinn-phong", {"n": 1e4}), ("gaussian", {"m": 1.0}), ("gaussian", {"m": 0.01}),
        ("gtr", {"alpha": 1e-3}), ("gtr", {"alpha": 0.3, "gamma": 0.0}), ("gtr", {"alpha": 1.0, "gamma": 7.0}),
        ("gtr", {"alpha": 0.02, "gamma": 10.0}), ("gtr", {"alpha": 0.1, "gamma": 1.5}),
        ("student-t", {"alpha_x": 0.1, "alpha_y": 0.5}), ("student-t", {"gamma": 40.0}),
        ("abc", {"B": 1.0, "C": 1.0}), ("abc", {"B": 1e6, "C": 1.0}), ("abc", {"B": 1e3, "C": 2.0}),
        ("abc", {"B": 50.0, "C": 10.0}), ("sgd", {"alpha": 1e-2, "p": 1.0}), ("sgd", {"alpha": 1.0, "p": 10.0}),
    ]
}  # fmt: skip

ACCURACY = {"beckmann": 4e-3, "curve": 4e-4, "map": 3e-3}
"""Walter's rational Lambda; piecewise linear densities, whose kinks no smooth rule integrates exactly."""


def bound(part: Distribution) -> Bound:
    """A part as the formulas of a model see it."""
    textures, values = part.textures, part.values
    return Bound(part, lambda name: textures[name] if name in textures else bound_value(values[name], float))


def vec(w: np.ndarray) -> Vec:
    return Vec(*np.moveaxis(w, -1, 0))


@pytest.mark.parametrize("case", PARTS)
def test_facets_cover_the_surface_and_mask_each_other_consistently(case: str) -> None:
    part = bound(PARTS[case])
    accuracy = ACCURACY.get(case.split()[0], 2e-5)
    D = part.D(vec(H)) * SOLID_ANGLE
    assert np.sum(D * H[:, 2]) == pytest.approx(1, abs=max(1e-4, 0.1 * accuracy))
    for theta, phi in [(0.0, 0.0), (30.0, 20.0), (70.0, 100.0), (86.0, 35.0)]:
        w = direction(theta, phi)
        # the weak white furnace: what w sees, D G1 <w, h> / cos, with G1 = cos / A(w)
        seen = np.sum(D * np.maximum(H @ w, 0)) / part.projected_area(vec(w))
        assert seen == pytest.approx(1, rel=accuracy, abs=1e-4)


@pytest.mark.parametrize("gamma", [1.6, 2.0, 5.0])
def test_area_at_the_horizon_in_closed_form(gamma: float) -> None:
    part = bound(DISTRIBUTIONS["student-t"](alpha=0.3, gamma=gamma))
    expected = 0.3 * (gamma - 1) ** 1.5 * beta(1.5, gamma - 1.5) / np.pi
    assert part.projected_area(Vec(0.6, 0.8, 0.0)) == pytest.approx(expected, rel=1e-4)


def test_distributions_meet_where_they_should() -> None:
    wi, wo = random_pairs(2000, seed=3)
    ggx = GGX(alpha=0.3, F0=0.7)(wi, wo)
    for other in ({"ndf": "student-t", "gamma": 2.0}, {"ndf": "gtr", "gamma": 2.0}):
        np.testing.assert_allclose(Microfacet(alpha=0.3, F0=0.7, **other)(wi, wo), ggx, rtol=2e-5)
    beckmann = Microfacet(ndf="sgd", alpha=1.0, p=0.0, masking="v-groove")(wi, wo)
    np.testing.assert_allclose(Microfacet(ndf="beckmann", alpha=1.0, masking="v-groove")(wi, wo), beckmann, rtol=1e-9)


def test_a_sampled_distribution_generates_the_reflectance_it_was_sampled_from() -> None:
    theta = np.linspace(0, np.pi / 2, 1500)
    exact = Microfacet(ndf="blinn-phong", n=40.0, masking="smith-separable", F0=1.0)
    generated = Microfacet(ndf="curve", facets=5 * np.cos(theta) ** 40, masking="smith-separable", F0=1.0)
    wi, wo = random_pairs(2000, seed=4)
    np.testing.assert_allclose(generated(wi, wo), exact(wi, wo), rtol=1e-3, atol=1e-5)
    x = (np.arange(256) + 0.5) / 128 - 1
    cosine2 = np.maximum(1 - x[:, None] ** 2 - x**2, 0)
    painted = Microfacet(ndf="map", facets=3 * cosine2**20, masking="smith-separable", F0=1.0)
    np.testing.assert_allclose(painted(wi, wo), exact(wi, wo), rtol=1e-2, atol=1e-3)


@pytest.mark.parametrize(("ndf", "masking"), list(itertools.product(DISTRIBUTIONS, MASKINGS)))
def test_every_combination_is_traced_finite_and_reciprocal(ndf: str, masking: str) -> None:
    grazing = np.array([direction(t, p) for t in (0.0, 45.0, 89.99, 89.999943) for p in (0.0, 90.0, 180.0)])
    wi = np.concatenate([np.repeat(grazing, 12, 0), random_pairs(100)[0]])
    wo = np.concatenate([np.tile(grazing, (12, 1)), random_pairs(100)[1]])
    for fresnel in TERMS:
        m = Microfacet(ndf=ndf, masking=masking, fresnel=fresnel)
        assert len(trace(m).outputs) == 3
        value = m(wi, wo)
        np.testing.assert_allclose(value, m(wo, wi), rtol=1e-8)
        single = m(wi.astype(np.float32), wo.astype(np.float32))
        assert np.isfinite(single).all()
        assert (single >= 0).all()


def test_parameters_of_the_parts_have_names_of_their_own() -> None:
    families = [{name: part() for name, part in family.items()} for family in (DISTRIBUTIONS, MASKINGS, TERMS)]
    names = [{k: [*part.declarations(), *part.textures] for k, part in family.items()} for family in families]
    for combination in itertools.product(*(family.values() for family in names)):
        together = list(itertools.chain(*combination))
        assert len(together) == len(set(together))


@pytest.mark.parametrize("masking", [name for name, term in MASKINGS.items() if "energy" not in term.breaks])
@pytest.mark.parametrize("ndf", DISTRIBUTIONS)
def test_white_facets_reflect_no_more_than_they_receive(ndf: str, masking: str) -> None:
    m = Microfacet(ndf=ndf, masking=masking, F0=1.0)
    for theta in (0.0, 60.0, 86.0):
        rule = half_vector_rule(direction(theta, 35.0), 120, 48)
        albedo = np.sum(m(rule.directions, direction(theta, 35.0))[:, 0] * rule.directions[:, 2] * rule.weights)
        assert 0.01 < albedo < 1.002


@pytest.mark.parametrize(
    ("masking", "values"),
    [("ward", {"ndf": "ggx", "alpha": 0.6}), ("smith-schlick", {"ndf": "gtr", "alpha": 0.2, "gamma": 1.0})],
)
def test_what_is_said_to_break_the_energy_law_does(masking: str, values: dict[str, object]) -> None:
    m = Microfacet(masking=masking, F0=1.0, **values)
    assert "energy" in m.breaks
    rule = half_vector_rule(direction(89.0), 200, 64)
    assert np.sum(m(rule.directions, direction(89.0))[:, 0] * rule.directions[:, 2] * rule.weights) > 1.05


def test_masking_terms_in_closed_form() -> None:
    wi, wo = direction(60.0), direction(20.0, 180.0)
    h = (wi + wo) / np.linalg.norm(wi + wo)
    ci, co, d, hz = wi[2], wo[2], h @ wi, h[2]
    part = bound(DISTRIBUTIONS["beckmann"](alpha=0.5))
    k = np.sqrt(2 * 0.25 / np.pi)
    expected = {
        "v-groove": min(1, 2 * hz * ci / d, 2 * hz * co / d) / (ci * co),
        "kelemen": 2 / (1 + wi @ wo),
        "implicit": 1.0,
        "neumann": 1 / max(ci, co),
        "ashikhmin-shirley": 1 / (d * max(ci, co)),
        "ashikhmin-premoze": 1 / (ci + co - ci * co),
        "ward": 1 / np.sqrt(ci * co),
        "smith-schlick": 1 / ((ci * (1 - k) + k) * (co * (1 - k) + k)),
    }
    assert expected.keys() | {"smith", "smith-separable"} == MASKINGS.keys()
    for name, value in expected.items():
        assert MASKINGS[name]().visibility(part, vec(wi), vec(wo)) == pytest.approx(value, rel=1e-12), name
    # at 80 degrees the grooves do mask
    steep = direction(80.0), direction(75.0)
    assert MASKINGS["v-groove"]().visibility(part, *map(vec, steep)) * steep[0][2] * steep[1][2] < 0.5


def test_visibility_is_another_name_of_masking() -> None:
    assert Microfacet(visibility="kelemen").masking == "kelemen"
    with pytest.raises(ParameterError, match="two names of one choice"):
        Microfacet(visibility="kelemen", masking="smith")


def test_a_painted_distribution_is_saved_with_its_picture(tmp_path) -> None:
    m = Microfacet(ndf="map", facets=np.random.default_rng(0).random((8, 6)), F0=0.5)
    m.save(tmp_path / "m.safetensors")
    back = brdf.load(tmp_path / "m.safetensors")
    wi, wo = random_pairs(100)
    np.testing.assert_array_equal(back(wi, wo), m(wi, wo))
    with pytest.raises(ParameterError, match="facets must hold some facets"):
        _ = Microfacet(ndf="curve", facets=np.zeros(5)).textures
