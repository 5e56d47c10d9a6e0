"""Microfacet models against Mitsuba's roughconductor, an independent implementation of the same equations."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from brdf.formula.bound import Bound, bound_value
from brdf.models import Microfacet
from brdf.models.terms.fresnel import Dielectric
from lobes import random_pairs


@pytest.fixture(scope="module")
def mi() -> Any:
    mitsuba = pytest.importorskip("mitsuba")
    before = mitsuba.variant()
    mitsuba.set_variant("scalar_rgb")
    yield mitsuba
    if before is not None:
        mitsuba.set_variant(before)


@pytest.mark.parametrize("ndf", ["ggx", "beckmann"])
@pytest.mark.parametrize("widths", [(0.3, 0.3), (0.3, 0.15), (0.05, 0.05), (0.9, 0.9)])
def test_rough_conductor(mi: Any, ndf: str, widths: tuple[float, float]) -> None:
    eta, k = (0.2, 0.92, 1.1), (3.91, 2.45, 2.14)
    theirs = mi.load_dict(
        {
            "type": "roughconductor",
            "distribution": ndf,
            "alpha_u": widths[0],
            "alpha_v": widths[1],
            "eta": {"type": "rgb", "value": list(eta)},
            "k": {"type": "rgb", "value": list(k)},
        }
    )
    ours = Microfacet(
        ndf=ndf, masking="smith-separable", fresnel="conductor", alpha_x=widths[0], alpha_y=widths[1], eta=eta, k=k
    )
    wi, wo = (w.astype(np.float32).astype(np.float64) for w in random_pairs(600))
    above = (wi[:, 2] > 0.05) & (wo[:, 2] > 0.05)  # nearer the horizon, single precision costs Mitsuba a digit
    wi, wo = wi[above], wo[above]
    interaction, context = mi.SurfaceInteraction3f(), mi.BSDFContext()
    expected = np.empty_like(wi)
    for i in range(len(wi)):
        interaction.wi = wo[i].tolist()
        expected[i] = np.array(theirs.eval(context, interaction, wi[i].tolist()))
    assert expected.max() > 0.1
    # Mitsuba computes in single precision and returns f cos
    np.testing.assert_allclose(ours.f_cos(wi, wo), expected, rtol=1e-4, atol=1e-6)


def test_dielectric_fresnel(mi: Any) -> None:
    cosines = np.linspace(0.01, 1, 50)
    part = Dielectric(eta=1.5)
    F = Bound(part, lambda name: bound_value(part.values[name], float)).F(cosines)[0]
    np.testing.assert_allclose(F, [mi.fresnel(float(c), 1.5)[0] for c in cosines], rtol=1e-5)
