"""Metals: provenance, the published index, the three channels that stand in for it, the lecture's values."""

from __future__ import annotations

from importlib import resources
from pathlib import Path

import numpy as np
import pytest

from brdf import laws, load, materials
from brdf.color import spectrum_to_rgb
from brdf.errors import UnknownNameError
from brdf.materials import metals
from brdf.models import Microfacet, SmoothConductor
from brdf.models.terms.fresnel import conductor
from lobes import direction

NAMES = metals.names()


def at_normal_incidence(n: np.ndarray, k: np.ndarray) -> np.ndarray:
    return ((n - 1) ** 2 + k**2) / ((n + 1) ** 2 + k**2)


def test_names() -> None:
    assert {"metal/gold", "metal/silver", "metal/copper", "metal/aluminium", "metal/brass"} <= set(NAMES)
    assert set(NAMES) <= set(materials.names())
    assert materials.fits("metal/gold") == ["ground", "polished"]


@pytest.mark.parametrize(
    ("metal", "nm", "n", "k"),
    [("gold", 616.8, 0.21, 3.272), ("silver", 495.9, 0.05, 3.093), ("copper", 616.8, 0.3, 3.205)],
)
def test_index_is_the_published_one(metal: str, nm: float, n: float, k: float) -> None:
    """Rows of Johnson and Christy's table, at 2.01, 2.50 and 2.01 eV."""
    s = metals.spectrum(f"metal/{metal}")
    row = int(np.argmin(np.abs(s.nm - nm)))
    assert (s.nm[row], s.n[row], s.k[row]) == pytest.approx((nm, n, k))


@pytest.mark.parametrize(("metal", "nm", "lecture"), [("gold", 560, 0.82), ("silver", 560, 0.95)])
def test_reflectance_of_the_lecture(metal: str, nm: float, lecture: float) -> None:
    """Gold 0.82, silver 0.95 at normal incidence, where the eye is most sensitive; without tarnish silver has more."""
    s = metals.spectrum(f"metal/{metal}")
    assert np.interp(nm, s.nm, at_normal_incidence(s.n, s.k)) == pytest.approx(lecture, abs=0.04)


@pytest.mark.parametrize("name", NAMES)
def test_three_channels_reflect_as_the_spectrum(name: str) -> None:
    """Equal to the integral over the spectrum at normal incidence, but for channels beyond what an index reflects."""
    s, m = metals.spectrum(name), load(f"{name}@polished")
    assert isinstance(m, SmoothConductor)
    for theta, tolerance in ((0, 1e-5), (45, 0.003), (75, 0.015)):
        wo = direction(theta)
        expected = np.minimum(spectrum_to_rgb(conductor(wo[2], s.n, s.k), s.nm), 0.999)
        np.testing.assert_allclose(m.albedo(wo, 16), expected, atol=tolerance)


def test_no_metal_but_gold_leaves_the_gamut() -> None:
    for name in NAMES:
        s = metals.spectrum(name)
        brightest = spectrum_to_rgb(at_normal_incidence(s.n, s.k), s.nm).max()
        assert (brightest > 0.999) == (name == "metal/gold")


def test_mean_reflectance_of_a_dielectric_in_closed_form() -> None:
    """Walsh's formula for index 1.5, as given by Duntley: 0.0918."""
    assert metals.mean_reflectance(1.5, 0.0) == pytest.approx(0.0918, abs=1e-4)


def test_ground_and_polished() -> None:
    ground = materials.get("metal/copper")
    assert isinstance(ground, Microfacet)
    assert repr(ground) == repr(materials.get("metal/copper@ground")) == repr(materials.get("metal/copper", "ground"))
    assert ground.name == "metal/copper"
    np.testing.assert_array_equal(ground.eta, materials.get("metal/copper@polished").eta)
    assert ground.replaced(alpha=0.3).alpha == 0.3
    assert laws.check(ground).passed


def test_provenance() -> None:
    bibliography = (Path(__file__).parents[2] / "docs" / "references.bib").read_text("utf-8")
    for name in NAMES:
        key = metals._row(name)["source"]
        assert f"{{{key}," in bibliography
        assert key in materials.get(name).source
        assert "CC0" in materials.get(name).source
    licence = resources.files("brdf.materials").joinpath("data/LICENSE.metals").read_text("utf-8")
    assert "CC0 1.0 Universal" in licence


def test_unknown_names() -> None:
    with pytest.raises(UnknownNameError, match="unknown material 'metal/golt': did you mean 'metal/gold'"):
        materials.get("metal/golt")
    with pytest.raises(UnknownNameError, match="unknown surface of metal/gold 'polish': did you mean 'polished'"):
        load("metal/gold@polish")
