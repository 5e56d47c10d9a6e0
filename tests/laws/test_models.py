"""Every registered model, at its defaults and at a few others, and combinations of models obey every law."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from brdf import Reflectance, laws, mix, models
from brdf.geometry.sampling import TabulatedSampler
from brdf.loading import load

LAWS = {law.name: law for law in laws.ALL}

GGX, Lambertian, Microfacet = models.GGX, models.Lambertian, models.Microfacet

CASES: dict[str, Reflectance] = {
    **{name: models.get(name)() for name in models.names()},
    "ggx, sharp": GGX(alpha=0.02),
    "ggx, rough": GGX(alpha=0.9, F0=0.9),
    "ggx, anisotropic": GGX(alpha_x=0.08, alpha_y=0.4),
    "beckmann, tabulated sampler": Microfacet(ndf="beckmann", alpha=0.1),
    "sum": 0.5 * Lambertian() + 0.5 * GGX(alpha=0.1),
    "mix": mix(GGX(alpha=0.3), Microfacet(ndf="beckmann", alpha=0.05), 0.3),
}


@pytest.mark.parametrize("law", laws.ALL, ids=lambda law: law.name)
@pytest.mark.parametrize("case", CASES)
def test_obeys_law_or_declares_the_breach(case: str, law: laws.Law) -> None:
    result = law(CASES[case])
    assert result.status != "breaks", result


def drawn(model: type[models.Model], seed: int) -> Reflectance:
    """The model with parameters drawn within their declared bounds, unbounded ones within a tenth to ten."""
    rng = np.random.default_rng(seed)
    values = {}
    for name, declared in model().declarations().items():
        low, high = max(declared.low, 0.02), min(declared.high, 10.0)
        if declared.follows is None and low < high:
            values[name] = rng.uniform(low, high, declared.size).squeeze()
    return model(**values)


def white(model: type[models.Model]) -> Reflectance:
    """The model at its defaults, but with every colour that is an albedo at 1."""
    declared = model().declarations()
    return model(**{name: 1.0 for name, p in declared.items() if (p.size, p.low, p.high) == (3, 0.0, 1.0)})


@pytest.mark.parametrize("law", ["positivity", "reciprocity", "isotropy", "weight"])
@pytest.mark.parametrize("name", models.names())
def test_obeys_law_for_any_parameters(name: str, law: str) -> None:
    for seed in range(3):
        model = drawn(models.get(name), seed)
        result = LAWS[law](model)
        assert result.status != "breaks", (model, result)


@pytest.mark.parametrize("name", models.names())
def test_a_declared_breach_is_real(name: str) -> None:
    model = models.get(name)
    for law in model.breaks:
        cases = [model(), white(model), *(drawn(model, seed) for seed in range(6))]
        assert any(not LAWS[law](case).passed for case in cases), f"{name} obeys {law} after all"


@pytest.mark.parametrize("file", ["cc_green_malachite_rgb.bsdf", "irid_flake_paint1_rgb.bsdf"])
def test_measured_material_obeys_laws_with_its_own_and_with_the_tabulated_sampler(data: Path, file: str) -> None:
    measured = load(data / "rgl" / file)
    report = laws.check(measured)
    assert report.passed, str(report)
    measured.__dict__["_sampler"] = TabulatedSampler(measured, isotropic=True)
    for law in ("sampling", "density", "weight"):
        result = LAWS[law](measured)
        assert result.status == "holds", result
