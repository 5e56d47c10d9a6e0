"""Directional albedo against angle, and profiles of subsurface scattering against distance."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..color import luminance
from ..geometry.directions import from_spherical
from ..profiles import Profile
from ..reflectance import Reflectance
from .page import COLOURS, DASHES, LEGEND, Materials, degrees_axis, figure_of, name_of, names_of, several, titled

if TYPE_CHECKING:
    from matplotlib.figure import Figure, FigureBase

HEIGHT = 3.2
CHANNELS = (("red", COLOURS[1]), ("green", COLOURS[2]), ("blue", COLOURS[0]))


def albedo(m: Materials, samples: int = 4096) -> Figure:
    """Directional albedo over the polar angle of the light, each channel with twice its estimated error as a band.

    Where the line at 1 is crossed, more light leaves than arrives. An anisotropic reflectance is lit along its tangent.
    Of several reflectances the luminance of the albedo is drawn.
    """
    given = several(m)
    figure = figure_of(HEIGHT)
    titled(figure, f"{names_of(given)}\n{draw_albedo(figure, given, samples)}")
    return figure


def draw_albedo(figure: FigureBase, given: list[Reflectance], samples: int = 4096) -> str:
    axes: Any = figure.add_subplot()
    degrees = np.array([*range(0, 81, 5), 83, 86, 88])
    wo = from_spherical(np.radians(degrees), 0.0)
    axes.axhline(1, color="0.4", lw=0.8)
    highest = 1.0
    for number, m in enumerate(given):
        value, error = m.albedo(wo, samples), 2 * m.albedo_error(wo, samples)
        if len(given) == 1:
            curves = [(name, colour, value[:, c], error[:, c]) for c, (name, colour) in enumerate(CHANNELS)]
        else:
            curves = [(name_of(m, 28), COLOURS[number], luminance(value), luminance(error))]
        for k, (name, colour, mean, band) in enumerate(curves, number):
            axes.plot(degrees, mean, color=colour, ls=DASHES[k % len(DASHES)], lw=1.8, label=name)
            axes.fill_between(degrees, mean - band, mean + band, color=colour, alpha=0.2, lw=0)
            highest = max(highest, float((mean + band).max()))
    axes.set_ylim(0, 1.05 * highest)
    axes.set_ylabel("directional albedo [1]")
    degrees_axis(axes, range(0, 91, 15), "polar angle of the light")
    axes.legend(**LEGEND)
    return "share of the light that is reflected"


def profile(p: Profile | Sequence[Profile]) -> Figure:
    """R(r) [1/mm2] against distance [mm], both logarithmic, a curve a channel; of several profiles their means."""
    given = [p] if isinstance(p, Profile) else list(p)
    figure = figure_of(HEIGHT)
    axes: Any = figure.add_subplot()
    reach = max(float(one.reach().max()) for one in given)
    r = np.geomspace(1e-3 * reach, 10 * reach, 400)
    values = [one(r) for one in given]
    for number, (one, value) in enumerate(zip(given, values, strict=True)):
        if len(given) == 1:
            total = one.total()
            curves = [
                (f"{name}, total {total[c]:.3g}", colour, value[:, c]) for c, (name, colour) in enumerate(CHANNELS)
            ]
        else:
            curves = [(f"{name_of(one, 28)}, total {one.total().mean():.3g}", COLOURS[number], value.mean(-1))]
        for k, (label, colour, curve) in enumerate(curves, number):
            axes.loglog(
                r, np.where(curve > 0, curve, np.nan), color=colour, ls=DASHES[k % len(DASHES)], lw=1.8, label=label
            )
    highest = max(float(value.max()) for value in values)
    if highest > 0:
        axes.set_ylim(1e-8 * highest, 2 * highest)
    axes.set_xlim(r[0], r[-1])
    axes.set_xlabel("distance r from where the light enters [mm]")
    axes.set_ylabel("R(r) [1/mm²]")
    axes.tick_params(labelsize=9)
    axes.grid(alpha=0.35)
    axes.legend(**LEGEND)
    titled(figure, f"{names_of(given)}\nradiant exitance per flux that enters at one point")
    return figure
