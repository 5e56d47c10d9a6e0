"""Microfacet models against Mitsuba's rough conductor and dielectric: 10,000 random pairs of directions each."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from brdf.formula.bound import Bound, bound_value
from brdf.models import Microfacet
from brdf.models.terms.fresnel import Dielectric
from lobes import random_pairs

COUNT = 10_000
LOWEST = 0.01
"""Cosine from which on pairs are compared.

Mitsuba computes in single precision (its wheels have no other): F of a cosine that is off by 1e-7 is off by up to
1e-7 over that cosine, relatively; at 0.001 that is 3e-4.
"""
NOUGHT = 1e-16
"""Mitsuba takes D cos below 1e-20 for zero."""


def compared(mi: Any, ours: Microfacet, scene: dict[str, Any]) -> None:
    """f cos at `COUNT` or more pairs, half of them near-mirror ones, to 1e-4 relative."""
    theirs = mi.load_dict(scene)
    wi, wo = (w.astype(np.float32).astype(np.float64) for w in random_pairs(12_000))
    above = (wi[:, 2] > LOWEST) & (wo[:, 2] > LOWEST)
    wi, wo = wi[above], wo[above]
    assert len(wi) > COUNT
    interaction, context = mi.SurfaceInteraction3f(), mi.BSDFContext()
    expected = np.empty_like(wi)
    for i in range(len(wi)):
        interaction.wi = wo[i].tolist()
        expected[i] = np.array(theirs.eval(context, interaction, wi[i].tolist()))
    assert (expected > 1e-3).mean() > 0.2
    np.testing.assert_allclose(ours.f_cos(wi, wo), expected, rtol=1e-4, atol=NOUGHT)


@pytest.mark.parametrize("ndf", ["ggx", "beckmann"])
@pytest.mark.parametrize("widths", [(0.3, 0.3), (0.3, 0.15), (0.05, 0.05), (0.9, 0.9)])
def test_rough_conductor(mi: Any, ndf: str, widths: tuple[float, float]) -> None:
    eta, k = (0.2, 0.92, 1.1), (3.91, 2.45, 2.14)
    ours = Microfacet(
        ndf=ndf, masking="smith-separable", fresnel="conductor", alpha_x=widths[0], alpha_y=widths[1], eta=eta, k=k
    )
    theirs = {
        "type": "roughconductor", "distribution": ndf, "alpha_u": widths[0], "alpha_v": widths[1],
        "eta": {"type": "rgb", "value": list(eta)}, "k": {"type": "rgb", "value": list(k)},
    }  # fmt: skip
    compared(mi, ours, theirs)


@pytest.mark.parametrize("ndf", ["ggx", "beckmann"])
@pytest.mark.parametrize(("alpha", "eta"), [(0.3, 1.5), (0.1, 1.33), (0.6, 2.0)])
def test_reflection_of_a_rough_dielectric(mi: Any, ndf: str, alpha: float, eta: float) -> None:
    ours = Microfacet(ndf=ndf, masking="smith-separable", fresnel="dielectric", alpha=alpha, eta=eta)
    theirs = {"type": "roughdielectric", "distribution": ndf, "alpha": alpha, "int_ior": eta, "ext_ior": 1.0}
    compared(mi, ours, theirs)


def test_dielectric_fresnel(mi: Any) -> None:
    cosines = np.linspace(0.01, 1, 50)
    part = Dielectric(eta=1.5)
    F = Bound(part, lambda name: bound_value(part.values[name], float)).F(cosines)[0]
    np.testing.assert_allclose(F, [mi.fresnel(float(c), 1.5)[0] for c in cosines], rtol=1e-5)
