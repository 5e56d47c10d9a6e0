"""White rough metals in a white furnace: what microfacets lose is put back, reciprocally, and saved with the rest."""

from __future__ import annotations

import numpy as np
import pytest

import brdf
from brdf import laws
from brdf.errors import ParameterError
from brdf.formula.trace import trace
from brdf.geometry.quadrature import half_vector_rule, hemisphere_rule
from brdf.models import EnergyCompensated, Lambertian, Microfacet
from brdf.models.terms.fresnel import TERMS
from lobes import direction, random_pairs


def albedo(base: Microfacet, m: EnergyCompensated, theta: float) -> np.ndarray:
    """Directional albedo: the lobe by a rule over half vectors, what is added by an even one."""
    wo = direction(theta, 35.0)
    dense, even = half_vector_rule(wo, 300, 96), hemisphere_rule(48, 48)
    lobe = base(dense.directions, wo) * (dense.directions[:, 2] * dense.weights)[:, None]
    added = (m(even.directions, wo) - base(even.directions, wo)) * (even.directions[:, 2] * even.weights)[:, None]
    return lobe.sum(0) + added.sum(0)


@pytest.mark.parametrize(
    "values",
    [
        *({"alpha": alpha} for alpha in (0.1, 0.3, 0.6, 1.0)),
        {"ndf": "beckmann", "alpha": 0.5},
        {"ndf": "gtr", "alpha": 0.3},
        {"alpha": 0.5, "masking": "smith-separable"},
        {"alpha": 0.3, "masking": "kelemen"},
    ],
    ids=repr,
)
def test_white_facets_pass_the_furnace(values: dict[str, object]) -> None:
    base = Microfacet(F0=1.0, **values)
    m = EnergyCompensated(base)
    for theta in (0.0, 30.0, 60.0, 80.0, 89.0):
        np.testing.assert_allclose(albedo(base, m, theta), 1, atol=1e-3)
    if values.get("alpha") == 1.0:
        assert albedo(base, m, 0.0)[0] - albedo(base, base, 0.0)[0] > 0.3  # the base alone loses that much


def test_an_anisotropic_white_metal_passes_too() -> None:
    base = Microfacet(F0=1.0, alpha_x=0.2, alpha_y=0.8)
    m = EnergyCompensated(base)
    assert not m.isotropic
    for theta in (0.0, 45.0, 80.0, 88.0):
        np.testing.assert_allclose(albedo(base, m, theta), 1, atol=1e-2)


def test_coloured_facets_gain_saturation_and_stay_below_one() -> None:
    base = Microfacet(F0=(0.9, 0.5, 0.2), alpha=0.8)
    m = EnergyCompensated(base)
    before, after = albedo(base, base, 40.0), albedo(base, m, 40.0)
    assert (after > before).all()
    assert (after < 1).all()
    assert after[0] / after[2] > before[0] / before[2]


@pytest.mark.parametrize("fresnel", TERMS)
def test_traced_reciprocal_and_equal_when_compiled(fresnel: str) -> None:
    m = EnergyCompensated(Microfacet(fresnel=fresnel, alpha=0.5))
    assert len(trace(m).outputs) == 3
    wi, wo = random_pairs(500)
    np.testing.assert_allclose(m(wi, wo), m(wo, wi), rtol=1e-9)
    assert np.isfinite(m(wi.astype(np.float32), wo.astype(np.float32))).all()


def test_compiled_equals_numpy_and_a_file_brings_everything_back(tmp_path) -> None:
    m = EnergyCompensated(Microfacet(ndf="student-t", alpha=0.4, F0=(0.9, 0.6, 0.3)))
    wi, wo = random_pairs(20_000)
    np.testing.assert_allclose(m(wi, wo)[:200], m(wi[:200], wo[:200]), rtol=1e-9)
    m.save(tmp_path / "m.safetensors")
    np.testing.assert_allclose(brdf.load(tmp_path / "m.safetensors")(wi[:200], wo[:200]), m(wi[:200], wo[:200]))
    assert laws.check(m).passed


def test_only_microfacet_models_are_compensated() -> None:
    with pytest.raises(ParameterError, match="energy is compensated for a Microfacet model, got Lambertian"):
        EnergyCompensated(Lambertian())
