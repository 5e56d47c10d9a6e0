"""Figures of several materials, solids, Fresnel curves, spheres, the white-out, profiles; writing them to files."""

from __future__ import annotations

import io
import warnings
from pathlib import Path

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text

import brdf
from brdf import metrics, models, plot, profiles
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
    "comparison": lambda: plot.comparison(SHINY, DIFFUSE, size=32),
    "comparison of four": lambda: plot.comparison(SHINY, DIFFUSE, SHINY, DIFFUSE, size=32),
    "comparison with black": lambda: plot.comparison(models.Lambertian(albedo=0), DIFFUSE, size=32),
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
    with pytest.raises(UnknownFormatError, match=r"figures are written as \.png, \.svg, \.pdf or \.html"):
        plot.save(plot.cartesian(DIFFUSE), tmp_path / "x.xyz")
    assert not list(tmp_path.iterdir())
    with pytest.raises(ParameterError, match="a figure shows 1 to 6 materials, got 7"):
        plot.lobes([DIFFUSE] * 7)


def test_a_comparison_shows_spheres_differences_and_errors_by_angle() -> None:
    darker = models.Lambertian(albedo=0.48).named("darker")
    figure = plot.comparison(DIFFUSE, darker, SHINY, size=32)
    spheres = [axes for axes in figure.axes if axes.images and not axes.axison]
    assert len(spheres) == 5 * 5  # the reference, and two rows for each of the others
    pixel = [[axes.images[0].get_array()[16, 18] for axes in spheres[5 * row : 5 * row + 5]] for row in range(3)]
    np.testing.assert_allclose(pixel[2], np.clip(10 * np.abs(np.subtract(pixel[0], pixel[1])), 0, 1), atol=1e-6)
    corner = np.stack([axes.images[0].get_array()[0, 0] for axes in spheres])
    np.testing.assert_allclose(corner, 1, atol=1e-6)
    psnr, delta_e = (axes for axes in figure.axes if axes.lines)
    expected = metrics.compare(DIFFUSE, darker)
    np.testing.assert_allclose(psnr.lines[0].get_ydata(), expected.psnr_by_angle)
    np.testing.assert_allclose(delta_e.lines[1].get_ydata(), metrics.compare(DIFFUSE, SHINY).delta_e_by_angle)
    assert [text.get_text() for text in psnr.get_legend().get_texts()] == ["darker", "GGX"]
    maps = [axes for axes in figure.axes if axes.images and axes.axison]
    np.testing.assert_allclose(maps[0].images[0].get_array(), metrics.error_map(DIFFUSE, darker))


def test_identical_materials_are_said_to_be_identical() -> None:
    texts = [t.get_text() for axes in plot.comparison(DIFFUSE, DIFFUSE, size=16).axes for t in axes.texts]
    assert texts == ["identical at every angle"]


def test_no_text_of_a_comparison_leaves_the_page_or_meets_another() -> None:
    long = models.GGX(alpha=0.2).named("GGX:alpha=0.2,F0=1/.78/.34 + Lambertian:albedo=.3")
    for others in ([long], [long, DIFFUSE, SHINY, long]):
        figure = plot.comparison(SHINY, *others, size=16)
        figure.draw_without_rendering()
        renderer, page = FigureCanvasAgg(figure).get_renderer(), figure.bbox
        beyond = {  # ticks outside the axis' range exist and are not drawn
            tick.label1
            for axes in figure.axes
            for axis in (axes.xaxis, axes.yaxis)
            for tick in axis.get_major_ticks()
            if not min(axis.get_view_interval()) <= tick.get_loc() <= max(axis.get_view_interval())
        }
        texts = (t for t in figure.findobj(match=Text) if t not in beyond)
        shown = [t for t in texts if t.get_visible() and t.get_text().strip()]
        boxes = [t.get_window_extent(renderer) for t in shown]
        for text, box in zip(shown, boxes, strict=True):
            assert page.x0 <= box.x0 <= box.x1 <= page.x1, text
            assert page.y0 <= box.y0 <= box.y1 <= page.y1, text
        for i, box in enumerate(boxes):
            for k in range(i):
                assert not box.shrunk(0.9, 0.9).overlaps(boxes[k].shrunk(0.9, 0.9)), (shown[i], shown[k])


def test_a_comparison_with_nothing_or_too_much_is_refused() -> None:
    with pytest.raises(ParameterError, match="1 to 6 materials beside the reference, got 0"):
        plot.comparison(DIFFUSE)
