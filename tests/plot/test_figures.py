"""Figures of several materials, solids, Fresnel curves, spheres, the white-out, profiles; writing them to files."""

from __future__ import annotations

import io
import warnings
from pathlib import Path

import numpy as np
import pytest

import brdf
from brdf import models, plot, profiles
from brdf.color import srgb_encode
from brdf.errors import ParameterError, ReflectanceError, UnknownFormatError

SHINY = models.GGX(alpha=0.2, F0=(1, 0.78, 0.34))
DIFFUSE = models.Lambertian(albedo=0.5)
BURLEY, DIPOLE = profiles.get("burley")(), profiles.get("dipole")()
DRAWN = {
    "lobes of two": lambda: plot.lobes([SHINY, DIFFUSE]),
    "albedo of two": lambda: plot.albedo([SHINY, DIFFUSE], samples=256),
    "cartesian": lambda: plot.cartesian(SHINY),
    "cartesian of two": lambda: plot.cartesian([SHINY, DIFFUSE]),
    "overview of two": lambda: plot.overview([SHINY, DIFFUSE]),
    "solid": lambda: plot.solid(SHINY, size=31),
    "spheres": lambda: plot.spheres([SHINY, DIFFUSE], size=32),
    "fresnel": plot.fresnel,
    "white-out": lambda: plot.white_out(size=40),
    "profile": lambda: plot.profile(BURLEY),
    "profiles": lambda: plot.profile([BURLEY, DIPOLE]),
    "black": lambda: plot.cartesian(models.Lambertian(albedo=0)),
    "no scattering": lambda: plot.profile(profiles.get("burley")(A=0)),
}


@pytest.mark.parametrize("what", DRAWN)
def test_figures_are_600_pixels_wide_and_draw_without_a_warning(what: str) -> None:
    from PIL import Image

    buffer = io.BytesIO()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        DRAWN[what]().savefig(buffer, format="png")
    assert Image.open(buffer).width == 600


@pytest.mark.parametrize("what", ["cartesian", "fresnel", "profile", "albedo of two"])
def test_axes_have_units(what: str) -> None:
    axes = DRAWN[what]().axes[0]
    assert "[" in axes.get_ylabel()
    assert "mm" in axes.get_xlabel() or any("°" in t.get_text() for t in axes.get_xticklabels())


def test_laid_over_each_other_every_material_is_named_once() -> None:
    for draw in (plot.cartesian, plot.albedo):
        legend = draw([SHINY, DIFFUSE]).axes[0].get_legend()
        assert [text.get_text() for text in legend.get_texts()] == ["GGX", "Lambertian"]
    (legend,) = plot.lobes([SHINY, DIFFUSE]).legends
    assert [text.get_text() for text in legend.get_texts()] == ["GGX", "Lambertian"]


def test_cartesian_curves_are_f() -> None:
    line = plot.cartesian(DIFFUSE, angles=(10,)).axes[0].lines[0]
    np.testing.assert_allclose(line.get_ydata(), 0.5 / np.pi, rtol=1e-12)


def test_fresnel_of_glass_both_ways() -> None:
    outside, inside = (line.get_xydata() for line in plot.fresnel(metal=()).axes[0].lines)
    assert outside[0, 1] == pytest.approx(0.04)
    assert inside[0, 1] == pytest.approx(0.04)
    brewster = np.interp(np.degrees(np.arctan(1.5)), *outside.T)
    assert brewster == pytest.approx(((1.5**2 - 1) / (1.5**2 + 1)) ** 2 / 2, rel=1e-3)  # only s is reflected
    critical = np.degrees(np.arcsin(1 / 1.5))
    assert (inside[inside[:, 0] > critical + 0.2, 1] == 1).all()
    assert (inside[inside[:, 0] < critical - 0.2, 1] < 0.7).all()


def test_fresnel_of_materials_is_their_own_term() -> None:
    lines = plot.fresnel(brdf.load("GGX:F0=0.2")).axes[0].lines
    assert lines[0].get_ydata()[0] == pytest.approx(0.2)
    assert lines[0].get_ydata()[-1] == pytest.approx(1)
    gold = {line.get_ydata()[0] for line in plot.fresnel(brdf.load("metal/gold")).axes[0].lines}
    assert len(gold) == 3
    assert max(gold) > 0.9
    with pytest.raises(ReflectanceError, match="Lambertian has no Fresnel term"):
        plot.fresnel(DIFFUSE)


def test_spheres_show_pi_f_cos() -> None:
    picture = plot.spheres(DIFFUSE, angles=(0,), size=64).axes[0].images[0].get_array()
    assert picture[32, 32, 0] == pytest.approx(float(srgb_encode(np.array(0.5))), abs=1e-3)
    np.testing.assert_allclose(picture[0, 0], 1, atol=1e-6)
    lit = plot.spheres(DIFFUSE, angles=(90,), size=64).axes[0].images[0].get_array()
    assert lit[32, 50, 0] > 0.5 > lit[32, 14, 0] == 0


def test_snow_under_an_overcast_sky_shows_no_shape() -> None:
    overcast, lamp = (axes.images[0].get_array() for axes in plot.white_out(size=60).axes)
    assert np.ptp(overcast) < 1e-6
    assert np.ptp(lamp) > 0.3


def test_profiles_are_drawn_as_they_are() -> None:
    axes = plot.profile(DIPOLE).axes[0]
    r, value = axes.lines[0].get_data()
    np.testing.assert_allclose(value, DIPOLE(r)[:, 0])


@pytest.mark.parametrize("extension", ["png", "svg", "html", "pdf"])
def test_saved_by_extension(extension: str, tmp_path: Path) -> None:
    path = tmp_path / f"figure.{extension}"
    plot.save(plot.cartesian(models.Lambertian().named("<b> & co")), path)
    start = {"png": b"\x89PNG", "svg": b"<?xml", "html": b"<!DOCTYPE html>", "pdf": b"%PDF"}[extension]
    content = path.read_bytes()
    assert content.startswith(start)
    if extension == "html":
        assert b"<svg" in content
        assert b"<title>&lt;b&gt; &amp; co" in content
        for outside in (b"<link", b"<script", b'src="http', b'xlink:href="http'):
            assert outside not in content


@pytest.mark.parametrize("extension", ["png", "svg", "html", "pdf"])
def test_the_same_figure_is_the_same_file(extension: str, tmp_path: Path) -> None:
    paths = [tmp_path / f"{name}.{extension}" for name in "ab"]
    for path in paths:
        plot.save(plot.albedo([SHINY, DIFFUSE], samples=64), path)
    first, second = (path.read_bytes() for path in paths)
    assert first == second
    assert b"<dc:date>" not in first
    assert b"/CreationDate" not in first


def test_bad_input(tmp_path: Path) -> None:
    with pytest.raises(UnknownFormatError, match=r"figures are written as .*\.html, .*\.svg"):
        plot.save(plot.cartesian(DIFFUSE), tmp_path / "x.xyz")
    assert not list(tmp_path.iterdir())
    with pytest.raises(ParameterError, match="a figure shows 1 to 6 materials, got 7"):
        plot.lobes([DIFFUSE] * 7)
