"""Every registered model, at its defaults and at a few others, and combinations of models obey every law."""

from __future__ import annotations

import pytest

from brdf import Reflectance, laws, mix, models

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
