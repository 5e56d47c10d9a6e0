"""Figures of a reflectance: lobes, slices, directional albedo.

Every function returns a matplotlib figure without touching matplotlib's global state, so it works in a server or a
thread; `figure.savefig("x.png")` writes it. Sizes are made for 600 pixels of width (100 dpi).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from .color import luminance, srgb_encode
from .geometry.directions import from_half_difference, from_spherical
from .reflectance import Reflectance

if TYPE_CHECKING:
    from matplotlib.figure import Figure, FigureBase

WIDTH = 6.0
"""Inches; at 100 dpi this is the page's 600 pixels."""

LOBE_HEIGHT, SLICE_HEIGHT, ALBEDO_HEIGHT, DISC = 3.5, 3.2, 3.2, 4.7
"""Inches: the three figures, and the diameter of the half disc that the lobes are drawn in."""

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00")
"""Distinct with any colour vision. Reference: Okabe2008."""

DASHES: tuple[Any, ...] = ("-", (0, (5, 1.5)), (0, (1, 1)), "-.", (0, (3, 1, 1, 1, 1, 1)), (0, (8, 3)))
"""Second key to the curves, for print without colour."""

LOBE_DECADES, SLICE_DECADES = 6, 4
"""How many powers of ten below the largest value are still figure."""

LEGEND: dict[str, Any] = {"fontsize": 9, "title_fontsize": 9, "frameon": False}


LIGHT_ANGLES = (0, 30, 60, 80)
"""Polar angles [degrees] of the light in the figure of lobes."""


def lobes(m: Reflectance, angles: Sequence[float] = LIGHT_ANGLES) -> Figure:
    """f in the plane of incidence for light from several polar `angles` [degrees], as polar curves.

    The radius is the luminance of f [1/sr], logarithmic. Light comes from the left, the mirror direction is to the
    right.
    """
    figure = _figure(LOBE_HEIGHT, layout=None)
    _title(figure, f"{_name(m)}\n{_draw_lobes(figure, m, LOBE_HEIGHT, angles)}")
    return figure


def slices(m: Reflectance, phi_d: float = 90.0, size: int = 192) -> Figure:
    """f over half and difference angle at one azimuth `phi_d` [degrees]: in colour, and its luminance on a log scale.

    theta_h runs to the right, spread by a square root so that narrow highlights show; theta_d runs up. Below the
    horizon nothing is figure.
    """
    figure = _figure(SLICE_HEIGHT)
    _title(figure, f"{_name(m)}\n{_draw_slices(figure, m, phi_d, size)}")
    return figure


def albedo(m: Reflectance, samples: int = 4096) -> Figure:
    """Directional albedo over the polar angle of the light, each channel with twice its estimated error as a band.

    Where the line at 1 is crossed, more light leaves than arrives. An anisotropic reflectance is lit along its tangent.
    """
    figure = _figure(ALBEDO_HEIGHT)
    _title(figure, f"{_name(m)}\n{_draw_albedo(figure, m, samples)}")
    return figure


def overview(m: Reflectance) -> Figure:
    """Lobes, slices and albedo on one page."""
    heights = (LOBE_HEIGHT, SLICE_HEIGHT, ALBEDO_HEIGHT)
    page = _figure(sum(heights))
    page.suptitle(_name(m), fontsize=12, parse_math=False)
    first, second, third = page.subfigures(3, 1, height_ratios=heights, squeeze=False).flat
    _title(first, _draw_lobes(first, m, LOBE_HEIGHT))
    _title(second, _draw_slices(second, m))
    _title(third, _draw_albedo(third, m))
    return page


# ---- drawing into a figure or a part of one; each returns its title ------------------------------------------------


def _draw_lobes(figure: FigureBase, m: Reflectance, height: float, angles: Sequence[float] = LIGHT_ANGLES) -> str:
    # placed by hand: the half disc is drawn across the middle of a square, half of which would stay empty
    box = ((WIDTH - DISC) / 2 / WIDTH, (0.4 - DISC / 4) / height, DISC / WIDTH, DISC / height)
    axes: Any = figure.add_axes(box, projection="polar")
    axes.set_theta_zero_location("N")
    axes.set_theta_direction(-1)
    axes.set_thetamin(-90)
    axes.set_thetamax(90)
    view = np.radians(np.linspace(-89.9, 89.9, 3597))
    wo = from_spherical(view, 0.0)
    curves = [luminance(m(from_spherical(-math.radians(angle), 0.0), wo)) for angle in angles]
    top, bottom = _log_range(np.concatenate(curves), LOBE_DECADES)
    for k, (angle, curve) in enumerate(zip(angles, curves, strict=True)):
        radius = np.log10(np.maximum(curve, 10.0**bottom)) - bottom
        colour = COLOURS[k % len(COLOURS)]
        axes.plot(view, radius, color=colour, ls=DASHES[k % len(DASHES)], lw=1.6, label=f"{angle:g}°")
        axes.plot([-math.radians(angle)], [top - bottom], marker="v", color=colour, ms=7, clip_on=False)
    axes.set_ylim(0, top - bottom)
    powers = range(bottom + 1, math.floor(top) + 1, 1 if top - bottom < 5 else 2)
    axes.set_yticks([power - bottom for power in powers], [f"$10^{{{power}}}$" for power in powers])
    axes.set_rlabel_position(90)
    axes.set_xticks(np.radians(range(-90, 91, 30)), [f"{abs(a)}°" for a in range(-90, 91, 30)])
    axes.tick_params(labelsize=9)
    axes.grid(alpha=0.35)
    figure.legend(title="light from ▾", loc="upper left", bbox_to_anchor=(0.01, 0.9), **LEGEND)
    return "f in the plane of incidence, luminance [1/sr], logarithmic"


def _draw_slices(figure: FigureBase, m: Reflectance, phi_d: float = 90.0, size: int = 192) -> str:
    from matplotlib.colors import LogNorm

    colour_axes, log_axes = figure.subplots(1, 2, sharey=True)
    spread = (np.arange(size) + 0.5) / size
    theta_h, theta_d = np.meshgrid(spread**2 * math.pi / 2, spread * math.pi / 2)
    wi, wo = from_half_difference(theta_h, 0.0, theta_d, math.radians(phi_d))
    value = m(wi, wo)
    below = (wi[..., 2] <= 0) | (wo[..., 2] <= 0)
    extent = (0.0, 1.0, 0.0, 90.0)
    picture = np.where(below[..., None], 1.0, srgb_encode(math.pi * value))
    colour_axes.imshow(picture, origin="lower", extent=extent, aspect="auto")
    colour_axes.set_title("πf as a colour (sRGB, clipped)", fontsize=10)
    bright = np.ma.masked_array(luminance(value), below)
    # the few nodes next to grazing incidence would take the whole scale
    shown = bright.compressed()
    top, bottom = _log_range(shown[shown <= np.quantile(shown, 0.99)], SLICE_DECADES)
    norm = LogNorm(10.0**bottom, 10.0**top)
    mapped = log_axes.imshow(bright, origin="lower", extent=extent, aspect="auto", cmap="cividis", norm=norm)
    log_axes.set_title("luminance of f", fontsize=10)
    figure.colorbar(mapped, ax=log_axes, label="f [1/sr]", extend="both")
    ticks = (0, 2, 10, 25, 50, 90)
    for axes in (colour_axes, log_axes):
        axes.set_xticks([math.sqrt(t / 90) for t in ticks], [f"{t}°" for t in ticks])
        axes.set_yticks(range(0, 91, 30), [f"{t}°" for t in range(0, 91, 30)])
        axes.set_xlabel("half angle θh")
        axes.tick_params(labelsize=9)
    colour_axes.set_ylabel("difference angle θd")
    return f"slice at φd = {phi_d:g}°"


def _draw_albedo(figure: FigureBase, m: Reflectance, samples: int = 4096) -> str:
    axes = figure.add_subplot()
    degrees = np.array([*range(0, 81, 5), 83, 86, 88])
    wo = from_spherical(np.radians(degrees), 0.0)
    value, error = m.albedo(wo, samples), 2 * m.albedo_error(wo, samples)
    axes.axhline(1, color="0.4", lw=0.8)
    for channel, (name, colour, dash) in enumerate(
        zip(("red", "green", "blue"), (COLOURS[1], COLOURS[2], COLOURS[0]), DASHES, strict=False)
    ):
        mean, band = value[:, channel], error[:, channel]
        axes.plot(degrees, mean, color=colour, ls=dash, lw=1.8, label=name)
        axes.fill_between(degrees, mean - band, mean + band, color=colour, alpha=0.2, lw=0)
    axes.set_xlim(0, 90)
    axes.set_ylim(0, 1.05 * max(1.0, float((value + error).max())))
    axes.set_xticks(range(0, 91, 15), [f"{t}°" for t in range(0, 91, 15)])
    axes.set_xlabel("polar angle of the light")
    axes.set_ylabel("directional albedo [1]")
    axes.tick_params(labelsize=9)
    axes.grid(alpha=0.35)
    axes.legend(**LEGEND)
    return "share of the light that is reflected"


def _figure(height: float, layout: Literal["constrained"] | None = "constrained") -> Figure:
    from matplotlib.figure import Figure

    return Figure((WIDTH, height), dpi=100, layout=layout)


def _name(m: Reflectance) -> str:
    name = m.name or type(m).__name__
    return name if len(name) <= 60 else name[:57] + "…"


def _title(figure: FigureBase, text: str) -> None:
    figure.suptitle(text, fontsize=11, parse_math=False)


def _log_range(values: Any, decades: int) -> tuple[float, int]:
    """log10 of an axis' upper end, just above the largest value, and of its lower end, a whole number."""
    positive = values[np.isfinite(values) & (values > 0)]
    if not positive.size:
        return 0.0, -2
    top = math.log10(positive.max()) + 0.1
    bottom = max(math.floor(math.log10(positive.min())), math.floor(top) - decades)
    return top, min(bottom, math.floor(top) - 2)
