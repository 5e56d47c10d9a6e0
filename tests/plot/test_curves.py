"""Figures: what they show is what the reflectance is."""

from __future__ import annotations

import io
from collections.abc import Callable

import numpy as np
import pytest

from brdf import models, plot
from brdf.color import luminance
from brdf.reflectance import Reflectance

SHINY = models.GGX(alpha=0.2, F0=(1, 0.78, 0.34))
FIGURES = (plot.lobes, plot.slices, plot.albedo, plot.overview)


def saved(figure: object) -> bytes:
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png")  # type: ignore[attr-defined]
    return buffer.getvalue()


@pytest.mark.parametrize("draw", FIGURES)
@pytest.mark.parametrize(
    "m", [SHINY, models.GGX(alpha_x=0.05, alpha_y=0.5), models.Lambertian(albedo=0)], ids=["iso", "aniso", "black"]
)
def test_a_figure_is_600_pixels_wide_and_has_no_warning(draw: Callable[[Reflectance], object], m: Reflectance) -> None:
    from PIL import Image

    picture = Image.open(io.BytesIO(saved(draw(m))))
    assert picture.width == 600
    assert len(np.unique(np.asarray(picture.convert("L")))) > 10


def test_no_global_state_of_matplotlib_is_touched() -> None:
    from matplotlib import _pylab_helpers

    for draw in FIGURES:
        draw(SHINY)
    assert not _pylab_helpers.Gcf.figs


def test_lobes_are_the_luminance_of_f_in_the_plane_of_incidence() -> None:
    (axes,) = plot.lobes(SHINY, angles=(30,)).axes
    view, radius = axes.lines[0].get_data()
    lowest = int(axes.get_yticklabels()[0].get_text()[5:-2]) - axes.get_yticks()[0]
    peak = view[np.argmax(radius)]
    assert np.degrees(peak) == pytest.approx(30, abs=8)  # off-specular: towards grazing, to the right
    wi = np.array([-0.5, 0, np.sqrt(0.75)])
    wo = np.array([np.sin(peak), 0, np.cos(peak)])
    assert radius.max() + lowest == pytest.approx(np.log10(luminance(SHINY(wi, wo))), abs=1e-6)


def test_lobe_of_a_mirror_like_material_is_narrow_and_to_the_right() -> None:
    (axes,) = plot.lobes(models.GGX(alpha=0.01), angles=(45,)).axes
    view, radius = axes.lines[0].get_data()
    assert np.degrees(view[np.argmax(radius)]) == pytest.approx(45, abs=0.2)


def test_slices_show_the_colour_of_a_diffuser_everywhere() -> None:
    figure = plot.slices(models.Lambertian(albedo=(0.5, 0.2, 0.1)))
    picture = figure.axes[0].images[0].get_array()
    # sRGB of 0.5, 0.2, 0.1 (IEC 61966-2-1)
    assert np.allclose(picture, [0.73536, 0.48453, 0.34919], atol=1e-4)
    assert np.allclose(figure.axes[1].images[0].get_array(), luminance(np.array([0.5, 0.2, 0.1])) / np.pi)


def test_slices_run_from_the_highlight_to_the_right_and_leave_out_what_is_below_the_horizon() -> None:
    bright = plot.slices(SHINY).axes[1].images[0].get_array()
    assert np.all(np.diff(bright[60, :100]) < 0)
    tilted = plot.slices(SHINY, phi_d=0).axes[1].images[0].get_array()
    assert np.ma.is_masked(tilted[-1, -1])
    assert not np.ma.is_masked(tilted[0, 0])


def test_albedo_curves_are_the_albedo_of_each_channel() -> None:
    (axes,) = plot.albedo(models.Lambertian(albedo=(0.5, 0.2, 0.1))).axes
    curves = {line.get_label(): line.get_ydata() for line in axes.lines}
    for name, value in (("red", 0.5), ("green", 0.2), ("blue", 0.1)):
        assert np.allclose(curves[name], value, atol=1e-3)
    assert {"red", "green", "blue"} <= set(curves)


def test_names_with_mathematics_in_them_are_printed_as_they_are() -> None:
    saved(plot.albedo(models.Lambertian().named("50$ paint_x^{2 \\alpha $")))


def test_angles_and_axes_are_labelled_with_units() -> None:
    for draw in (plot.slices, plot.albedo):
        texts = [axes.get_xlabel() + axes.get_ylabel() for axes in draw(SHINY).axes]
        assert all(texts)
        assert any("°" in t.get_text() for t in draw(SHINY).axes[0].get_xticklabels())
    assert "[1/sr]" in plot.lobes(SHINY).get_suptitle()


def test_a_mirror_is_a_line_in_the_mirror_direction() -> None:
    glass = 0.5 * models.SmoothDielectric(eta=1.5)
    (angle, _), (_, rim) = plot.lobes(glass, angles=(30,)).axes[0].lines[0].get_data()
    assert angle == pytest.approx(np.radians(30))
    assert rim > 0
    figure = plot.lobes(glass, angles=(0,))
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["0°: 0.02"]
    straight = plot.cartesian([SHINY, models.Mirror()], angles=(30,)).axes[0]
    assert [30, 30] in [list(line.get_xdata()) for line in straight.lines]
    assert len(plot.lobes(SHINY, angles=(30,)).axes[0].lines) == 2  # the curve and the light
