"""`brdf.load`: names, files, models, sums."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import brdf
from brdf.errors import BrdfError, FileError, ParameterError, UnknownNameError

WI = np.array([0.48, 0.0, np.sqrt(1 - 0.48**2)])
WO = np.array([-0.28, 0.3, np.sqrt(1 - 0.28**2 - 0.3**2)])


def test_a_factor_is_in_the_name() -> None:
    assert brdf.load("2*Lambertian:albedo=.9").name == "2*Lambertian:albedo=.9"


def test_a_model_by_name_has_its_defaults() -> None:
    assert np.array_equal(brdf.load("GGX")(WI, WO), brdf.models.GGX()(WI, WO))
    assert np.array_equal(brdf.load("ggx")(WI, WO), brdf.models.GGX()(WI, WO))


def test_parameters_colours_and_choices() -> None:
    m = brdf.load("Microfacet:ndf=beckmann,alpha=2e-1,fresnel=conductor,eta=.2/.9/1.1,k=3.9/2.4/2.1")
    assert m.choices["ndf"] == "beckmann"
    assert m.alpha == 0.2
    assert m.k.tolist() == [3.9, 2.4, 2.1]


def test_lobes_add_up_and_factors_multiply() -> None:
    m = brdf.load("Lambertian:albedo=.3/.2/.1 + 0.5*GGX:alpha=1e-1 + 1/0/2e+0*Lambertian:albedo=.25")
    expected = (
        np.array([0.3, 0.2, 0.1]) / np.pi
        + 0.5 * brdf.models.GGX(alpha=0.1)(WI, WO)
        + np.array([1, 0, 2]) * 0.25 / np.pi
    )
    assert np.allclose(m(WI, WO), expected, rtol=1e-12)


def test_an_exponent_is_not_a_sum() -> None:
    m = brdf.load("Microfacet:fresnel=dielectric,eta=+.15e+1,alpha=1.e-1+Lambertian")
    assert m.children["lobe1"].eta == 1.5
    assert m.children["lobe1"].alpha == 0.1
    assert len(m.children) == 2


def test_a_shipped_material_and_its_fits_by_name() -> None:
    m = brdf.load("gold-metallic-paint")
    assert m.name == "gold-metallic-paint"
    for fit in brdf.materials.fits("gold-metallic-paint"):
        value = brdf.load(f"gold-metallic-paint@{fit}")(WI, WO)
        assert value.shape == (3,)
        assert np.all(value > 0)


def test_every_shipped_material_loads() -> None:
    for name in brdf.materials.names():
        assert np.isfinite(brdf.load(name)(WI, WO)).all(), name


def test_a_file_by_text_and_by_path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    m = brdf.models.GGX(alpha=0.3)
    m.save(tmp_path / "x.safetensors")
    monkeypatch.chdir(tmp_path)
    for spec in ("x.safetensors", "./x.safetensors", Path("x.safetensors"), tmp_path / "x.safetensors"):
        assert np.array_equal(brdf.load(spec)(WI, WO), m(WI, WO))


def test_files_take_part_in_sums_and_may_have_odd_names(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    m = brdf.models.GGX(alpha=0.3)
    m.save(tmp_path / "a+b.safetensors")
    m.save(tmp_path / "c.safetensors")
    monkeypatch.chdir(tmp_path)
    assert np.array_equal(brdf.load("a+b.safetensors")(WI, WO), m(WI, WO))
    assert np.allclose(brdf.load("2*c.safetensors + c.safetensors")(WI, WO), 3 * m(WI, WO), rtol=1e-12)


def test_a_name_wins_over_a_file_that_is_called_the_same(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    brdf.models.GGX(alpha=0.3).save(tmp_path / "Lambertian.safetensors")
    (tmp_path / "Lambertian.safetensors").rename(tmp_path / "Lambertian")
    monkeypatch.chdir(tmp_path)
    assert type(brdf.load("Lambertian")).__name__ == "Lambertian"
    assert type(brdf.load("./Lambertian")).__name__ == "GGX"


def test_what_a_model_was_loaded_from_is_its_name() -> None:
    assert brdf.load("GGX:alpha=0.2").name == "GGX:alpha=0.2"
    assert brdf.load("GGX+Lambertian").name == "GGX+Lambertian"


@pytest.mark.parametrize(
    ("spec", "error"),
    [
        ("", ParameterError),
        ("+", ParameterError),
        ("GGX +", ParameterError),
        ("nothing-like-it", UnknownNameError),
        ("GGGX:alpha=.2", UnknownNameError),
        ("gold-metallic-paint@nobody", UnknownNameError),
        ("@bagher_sgd", UnknownNameError),
        ("*GGX", ParameterError),
        ("2*", UnknownNameError),
        ("x.binary", FileError),
        ("a/b", FileError),
        ("x" * 5000, UnknownNameError),
        ("nul\0byte", UnknownNameError),
        ("GGX:=3", ParameterError),
        ("GGX:,", ParameterError),
        ("GGX:alpha=1/2", ParameterError),
        ("GGX:alpha=.2/.3/", ParameterError),
    ],
)
def test_nonsense_is_refused_by_an_error_of_ours(spec: str, error: type[BrdfError]) -> None:
    with pytest.raises(error) as caught:
        brdf.load(spec)
    assert "\n" not in str(caught.value)


def test_a_choice_may_be_named_in_digits():
    assert brdf.load("Disney:masking=2014").choices == brdf.models.Disney(masking="2014").choices
