"""Lobes in the plane of incidence: as polar curves, and over a straight axis."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..color import luminance
from ..geometry.directions import from_spherical
from ..reflectance import Reflectance
from .page import (  # fmt: skip
    COLOURS,
    DASHES,
    LEGEND,
    WIDTH,
    Materials,
    degrees_axis,
    figure_of,
    log_range,
    name_of,
    names_of,
    several,
    titled,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure, FigureBase

HEIGHT, DISC = 3.5, 4.7
"""Inches: the figure, and the diameter of the half disc that the lobes are drawn in."""

DECADES = 6
"""How many powers of ten below the largest value are still figure."""

LIGHT_ANGLES = (0, 30, 60, 80)
"""Polar angles [degrees] of the light."""

COMPARED_ANGLES = (30, 70)
"""The same when several materials share the figure."""

VIEWS = 3597


class Curve(NamedTuple):
    """f over the viewing angles for light from one angle."""

    style: int
    angle: float
    """of the light [degrees]"""
    label: str | None
    values: Any
    """luminance of f [1/sr] at each viewing angle"""
    mirrored: float
    """what a delta distribution reflects into the mirror direction [1]"""


def lobes(m: Materials, angles: Sequence[float] | None = None) -> Figure:
    """f in the plane of incidence for light from several polar `angles` [degrees], as polar curves.

    The radius is the luminance of f [1/sr], logarithmic; a delta distribution is a line to the rim, its share
    in the legend. Light comes from the left, the mirror direction is to the right. Several reflectances lie
    over each other, each in a colour of its own.
    """
    given = several(m)
    height = height_for(given)
    figure = figure_of(height, layout=None)
    titled(figure, f"{names_of(given)}\n{draw_lobes(figure, given, height, angles)}")
    return figure


def cartesian(m: Materials, angles: Sequence[float] | None = None) -> Figure:
    """The same values over the viewer's angle: luminance of f [1/sr], logarithmic, light from the left (-90°).

    A delta distribution is an upright line, its share of the light in the legend.
    """
    given = several(m)
    figure = figure_of(HEIGHT)
    titled(figure, f"{names_of(given)}\n{draw_cartesian(figure, given, angles)}")
    return figure


def height_for(given: list[Reflectance]) -> float:
    """Inches of the polar figure: the names of several materials stand above the disc."""
    return HEIGHT if len(given) == 1 else HEIGHT + 0.21 * len(given)


def draw_lobes(
    figure: FigureBase, given: list[Reflectance], height: float, angles: Sequence[float] | None = None
) -> str:
    # placed by hand: the half disc is drawn across the middle of a square, half of which would stay empty
    box = ((WIDTH - DISC) / 2 / WIDTH, (0.4 - DISC / 4) / height, DISC / WIDTH, DISC / height)
    axes: Any = figure.add_axes(box, projection="polar")
    axes.set_theta_zero_location("N")
    axes.set_theta_direction(-1)
    axes.set_thetamin(-90)
    axes.set_thetamax(90)
    view, curves = _curves(given, angles)
    top, bottom = log_range(np.concatenate([curve.values for curve in curves]), DECADES)
    for k, angle, label, values, mirrored in curves:
        radius = np.log10(np.maximum(values, 10.0**bottom)) - bottom
        colour = COLOURS[k % len(COLOURS)]
        if mirrored > 0:
            axes.plot([math.radians(angle)] * 2, [0, top - bottom], color=colour, ls=DASHES[k % len(DASHES)], lw=1.6)
        axes.plot(view, radius, color=colour, ls=DASHES[k % len(DASHES)], lw=1.6, label=label)
        marker = colour if len(given) == 1 else "0.2"
        axes.plot([-math.radians(angle)], [top - bottom], marker="v", color=marker, ms=7, clip_on=False)
    axes.set_ylim(0, top - bottom)
    powers = range(bottom + 1, math.floor(top) + 1, 1 if top - bottom < 5 else 2)
    axes.set_yticks([power - bottom for power in powers], [f"$10^{{{power}}}$" for power in powers])
    axes.set_rlabel_position(90)
    axes.set_xticks(np.radians(range(-90, 91, 30)), [f"{abs(a)}°" for a in range(-90, 91, 30)])
    axes.tick_params(labelsize=9)
    axes.grid(alpha=0.35)
    title = "light from ▾" if len(given) == 1 else None
    top_of_legend = 0.9 if len(given) == 1 else 1 - 0.42 / height
    figure.legend(title=title, loc="upper left", bbox_to_anchor=(0.01, top_of_legend), **LEGEND)
    return "f in the plane of incidence, luminance [1/sr], logarithmic"


def draw_cartesian(figure: FigureBase, given: list[Reflectance], angles: Sequence[float] | None = None) -> str:
    axes: Any = figure.add_subplot()
    view, curves = _curves(given, angles)
    top, bottom = log_range(np.concatenate([curve.values for curve in curves]), DECADES)
    for k, angle, label, values, mirrored in curves:
        colour = COLOURS[k % len(COLOURS)]
        if mirrored > 0:
            axes.axvline(angle, color=colour, ls=DASHES[k % len(DASHES)], lw=1.6)
        shown = np.where(values > 0, values, np.nan)
        axes.semilogy(np.degrees(view), shown, color=colour, ls=DASHES[k % len(DASHES)], lw=1.6, label=label)
        marker = colour if len(given) == 1 else "0.2"
        axes.plot([-angle], [10.0**top], marker="v", color=marker, ms=7, clip_on=False)
    axes.set_ylim(10.0**bottom, 10.0**top)
    axes.set_ylabel("f [1/sr]")
    degrees_axis(axes, range(-90, 91, 30), "viewer's angle from the normal, light from the left")
    title = "light from ▾" if len(given) == 1 else None
    axes.legend(title=title, **LEGEND)
    return "f in the plane of incidence, luminance"


def _curves(given: list[Reflectance], angles: Sequence[float] | None) -> tuple[Any, list[Curve]]:
    """Viewing angles [rad], and the curves."""
    if angles is None:
        angles = LIGHT_ANGLES if len(given) == 1 else COMPARED_ANGLES
    view = np.radians(np.linspace(-89.9, 89.9, VIEWS))
    wo = from_spherical(view, 0.0)
    curves = []
    for number, m in enumerate(given):
        for k, angle in enumerate(angles):
            wi, opposite = (from_spherical(sign * math.radians(angle), 0.0) for sign in (-1, 1))
            mirrored = float(luminance(m.delta(wi, opposite))) if m.has_delta else 0.0
            if len(given) == 1:
                label: str | None = f"{angle:g}°" + (f": {mirrored:.2g}" if mirrored > 0 else "")
            else:
                label = None if k else name_of(m, 28)
            style = k if len(given) == 1 else number
            curves.append(Curve(style, angle, label, luminance(m(wi, wo)), mirrored))
    return view, curves
