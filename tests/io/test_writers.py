"""What is written is read back as the same reflectance, as closely as the format's angles allow."""

from __future__ import annotations

import re

import numpy as np
import pytest
from tests.io.samples import csail, utia, zemax

import brdf
from brdf import io
from brdf.errors import ReflectanceError, UnknownNameError
from brdf.metrics.albedo import directional_albedo
from brdf.models import GGX, Lambertian
from helpers import random_directions

PLASTIC = Lambertian(albedo=(0.1, 0.2, 0.3)) + GGX(alpha=0.25)
BRUSHED = Lambertian(albedo=(0.1, 0.2, 0.3)) + GGX(alpha_x=0.25, alpha_y=0.5)
WI, WO = random_directions(4000, 1, 0.15), random_directions(4000, 2, 0.15)

FORMATS = {
    "UTIA": (".bin", 0.1),
    "MIT CSAIL": (".csail", 0.01),
    "ALTA text": (".alta", 0.02),
    "ASTM E1392 text": (".astm", 0.02),
    "Zemax text": (".bsdf", 0.02),
    "RGL": (".bsdf", 0.01),
    "MERL": (".binary", 0.01),
    "safetensors": (".safetensors", 1e-6),
}
"""Extension, and the mean error over the mean value that its angles allow."""


def error(m, model):
    return np.abs(m(WI, WO) - model(WI, WO)).mean() / model(WI, WO).mean()


def test_every_writer_is_tested():
    assert {f.name for f in io.formats() if f.writes} - {"sphere images"} == set(FORMATS)


@pytest.mark.parametrize("name", FORMATS)
def test_isotropic(name, tmp_path):
    extension, allowed = FORMATS[name]
    io.write(PLASTIC, tmp_path / f"m{extension}", name)
    assert io.registry.format_of(tmp_path / f"m{extension}").name == name
    assert error(io.read(tmp_path / f"m{extension}"), PLASTIC) < allowed


@pytest.mark.parametrize("name", ["UTIA", "MIT CSAIL", "Zemax text"])
def test_anisotropic(name, tmp_path):
    extension, allowed = FORMATS[name]
    io.write(BRUSHED, tmp_path / f"m{extension}", name)
    m = io.read(tmp_path / f"m{extension}")
    assert not m.isotropic
    assert error(m, BRUSHED) < allowed
    turned = brdf.models.GGX(alpha_x=0.5, alpha_y=0.25) + Lambertian(albedo=(0.1, 0.2, 0.3))
    assert error(m, turned) > 2 * error(m, BRUSHED)


@pytest.mark.parametrize(
    ("content", "extension", "name", "poles"),
    [
        (utia, ".bin", "UTIA", np.s_[:, 1:, 1:]),
        (csail, ".csail", "MIT CSAIL", np.s_[:]),
        (zemax, ".bsdf", "Zemax text", np.s_[:, 1:]),
    ],
)
def test_a_table_gives_its_own_values_back(content, extension, name, poles, tmp_path):
    """But at the poles, where an azimuth means nothing and the made-up values differ all the same."""
    (tmp_path / f"m{extension}").write_bytes(content())
    m = io.read(tmp_path / f"m{extension}")
    io.write(m, tmp_path / f"again{extension}", name)
    again = io.read(tmp_path / f"again{extension}")
    assert again.layout.shape == m.layout.shape
    both = (m.measured & again.measured)[poles]
    assert both.mean() > 0.6
    np.testing.assert_allclose(again.codes[poles][both], m.codes[poles][both], rtol=1e-4)


def test_the_integral_that_zemax_text_states_is_the_albedo(tmp_path):
    io.write(Lambertian(albedo=0.4), tmp_path / "m.bsdf", "zemax-text")
    text = (tmp_path / "m.bsdf").read_text()
    assert "Monochrome" in text
    stated = [float(x) for x in re.findall(r"^TIS\s(\S+)", text, re.MULTILINE)]
    assert len(stated) == 18
    np.testing.assert_allclose(stated, 0.4, rtol=0.03)


@pytest.mark.parametrize("spec", ["Minnaert", "Ward:ks=.4,alpha=.2", "chrome"])
def test_zemax_text_keeps_albedos_of_what_grows_towards_the_horizon_or_is_narrow(spec, tmp_path):
    m = brdf.load(spec)
    io.write(m, tmp_path / "m.bsdf", "Zemax text")
    written = io.read(tmp_path / "m.bsdf")
    for angle in (0, 30, 60, 80):
        albedo = directional_albedo(m, angle)
        np.testing.assert_allclose(directional_albedo(written, angle), albedo, rtol=0.06, atol=0.015)


def test_spectra_are_written_where_there_are_any(data, tmp_path):
    m = io.read(data / "gonio" / "cornell" / "garnet_red.brdf")
    io.write(m, tmp_path / "m.astm")
    again = io.read(tmp_path / "m.astm")
    np.testing.assert_array_equal(again.wavelengths, m.wavelengths)
    spectrum = m.spectrum(WI, WO)
    assert np.abs(again.spectrum(WI, WO) - spectrum).mean() / spectrum.mean() < 0.05


@pytest.mark.parametrize("extension", [".alta", ".astm"])
def test_text_that_is_read_as_isotropic_holds_nothing_else(extension, tmp_path):
    with pytest.raises(ReflectanceError, match="is anisotropic, which such text does not hold"):
        io.write(BRUSHED, tmp_path / f"m{extension}")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("name", [n for n in FORMATS if n not in ("safetensors",)])
def test_a_mirror_has_no_values(name, tmp_path):
    with pytest.raises(ReflectanceError, match="mirrors like a polished surface"):
        io.write(brdf.models.SmoothConductor(), tmp_path / f"m{FORMATS[name][0]}", name)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("name", "spec", "said"),
    [
        ("UTIA", "GGX:alpha=.001,F0=1", "reaches .* and a UTIA file holds values below 1e\\+06 alone"),
        ("Zemax text", "Lambertian:albedo=0", "is black, which Zemax text takes for no measurement"),
        *((name, "1e200*Lambertian", "holds values below 1e\\+30") for name in ("Zemax text", "MIT CSAIL")),
        *((name, "1e200*Lambertian", "holds values below 1e\\+30") for name in ("ALTA text", "ASTM E1392 text")),
    ],
)
def test_what_no_reader_would_take_is_not_written(name, spec, said, tmp_path):
    file = tmp_path / "kept"
    file.write_text("the work of last week")
    with pytest.raises(ReflectanceError, match=said):
        io.write(brdf.load(spec), file, name)
    assert file.read_text() == "the work of last week"
    assert list(tmp_path.iterdir()) == [file]


def test_a_format_that_is_not_written(tmp_path):
    with pytest.raises(UnknownNameError, match="unknown format that is written 'zemax': did you mean 'zemax-text'"):
        io.write(PLASTIC, tmp_path / "m.bsdf", "zemax")
