"""A fit beside its data: lit spheres, curves in the plane of incidence, where it is off, and its parameters."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ..color import srgb_encode
from ..fit import FitResult
from ..geometry.directions import from_spherical
from ..reflectance import Reflectance
from .page import COLOURS, DASHES, LEGEND, degrees_axis, figure_of, log_range
from .pictures import sphere_picture

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SPHERE_ANGLES = (20, 60, 100, 140)
"""Degrees between light and viewer."""
INCIDENT = (10, 45, 70)
"""Degrees from the normal to the light, a curve each."""
MAP_END = 1.0
"""Of the residual map's scale: a factor of e too bright or too dark."""
MOST_LINES = 18
"""Parameters that are listed; a fit may have dozens."""
SPHERES, CURVES, MAP, LINE = 2.5, 2.3, 2.5, 0.155
"""Inches: heights of the panels and of a line of parameters."""


def fitted(result: FitResult, data: Reflectance | None = None, size: int = 160) -> Figure:
    """The figure of a fit.

    Above: spheres of the data and of the fit in one light each, radiance pi f cos as sRGB. Then f cos in the plane of
    incidence, mean over the channels, for three angles of the light: data as lines, the fit dashed. Below: the mean of
    ln (f_fit cos / f_data cos) (1e-3 / sr added to both) over half and difference angle; parameters with their standard
    errors and every metric. `data` is the reflectance that was fitted, if it was one.
    """
    shown = [data, result.reflectance] if data is not None else [result.reflectance]
    texts = _lines(result)
    heights = [SPHERES * len(shown) / 2, CURVES, MAP, LINE * (math.ceil(len(texts) / 2) + 1)]
    figure = figure_of(sum(heights) + 0.7)
    figure.suptitle(
        f"{result.data or 'data'} by {result.model}, metric {result.metric}",
        fontsize=11,
        parse_math=False,
    )
    parts: Any = figure.subfigures(4, 1, height_ratios=heights)
    _draw_spheres(parts[0], shown, size)
    _draw_curves(parts[1], shown)
    _draw_map(parts[2], result)
    axes = parts[3].subplots()
    axes.set_axis_off()
    half = math.ceil(len(texts) / 2)
    for x, column in ((0.0, texts[:half]), (0.52, texts[half:])):
        text: dict[str, Any] = {
            "va": "top",
            "fontsize": 7,
            "family": "monospace",
            "transform": axes.transAxes,
            "parse_math": False,
        }
        axes.text(x, 1.0, "\n".join(column), **text)
    return figure


def _lines(result: FitResult) -> list[str]:
    rows = result.rows()
    listed = [f"{name[:22]:22} {value:>10} {error}" for name, value, error in rows[:MOST_LINES]]
    if len(rows) > MOST_LINES:
        listed.append(f"… and {len(rows) - MOST_LINES} more")
    return [*listed, *(f"{name[:22]:22} {value:10.4g}" for name, value in result.errors.items())]


def _draw_spheres(part: Any, shown: list[Reflectance], size: int) -> None:
    grid = part.subplots(len(shown), len(SPHERE_ANGLES), squeeze=False)
    for row, (m, label) in enumerate(zip(shown, ("data", "fit")[-len(shown) :], strict=True)):
        for axes, angle in zip(grid[row], SPHERE_ANGLES, strict=True):
            axes.imshow(np.clip(srgb_encode(sphere_picture(m, math.radians(angle), size)), 0, 1))
            axes.set(xticks=[], yticks=[])
            axes.spines[:].set_visible(False)
            if row == 0:
                axes.set_title(f"light {angle}°", fontsize=9)
        grid[row][0].set_ylabel(label, fontsize=9)


def _draw_curves(part: Any, shown: list[Reflectance]) -> None:
    axes = part.subplots()
    theta = np.linspace(-89, 89, 713)
    wo = from_spherical(np.radians(theta), np.zeros_like(theta))
    values = []
    for k, incident in enumerate(INCIDENT):
        wi = from_spherical(math.radians(incident), math.pi)
        for m, dash, width in zip(shown[::-1], (DASHES[1], "-"), (2.2, 1.2), strict=False):
            value = np.asarray(m(wi, wo)).mean(-1) * wo[:, 2]
            values.append(value)
            label = f"light {incident}°" if m is shown[0] else None
            axes.plot(theta, np.maximum(value, 1e-9), color=COLOURS[k], ls=dash, lw=width, label=label)
    top, bottom = log_range(np.array(values), 4)
    axes.set_yscale("log")
    axes.set_ylim(10.0**bottom, 10.0**top)
    degrees_axis(axes, range(-90, 91, 30), "angle of the viewer in the plane of incidence" + _key(shown))
    axes.set_ylabel("f cos θo [1/sr]", fontsize=9)
    axes.legend(loc="lower center", ncols=3, **LEGEND)


def _key(shown: list[Reflectance]) -> str:
    return " (data: line, fit: dashes)" if len(shown) == 2 else ""


def _draw_map(part: Any, result: FitResult) -> None:
    axes = part.subplots()
    axes.set_facecolor("0.85")
    drawn = axes.imshow(
        result.residual_map, origin="lower", extent=(0, 1, 0, 90), aspect="auto", cmap="RdBu_r", vmin=-MAP_END,
        vmax=MAP_END, interpolation="nearest",
    )  # fmt: skip
    ticks = (0, 2, 10, 25, 50, 90)
    axes.set_xticks([math.sqrt(t / 90) for t in ticks], [f"{t}°" for t in ticks])
    axes.set_yticks(range(0, 91, 30), [f"{t}°" for t in range(0, 91, 30)])
    axes.tick_params(labelsize=9)
    axes.set_xlabel("half angle θh", fontsize=9)
    axes.set_ylabel("difference angle θd", fontsize=9)
    bar = part.colorbar(drawn, ax=axes, extend="both")
    bar.set_label("ln (fit / data): red too bright", fontsize=9)
    bar.ax.tick_params(labelsize=9)
