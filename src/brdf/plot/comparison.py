"""Reflectances against a reference: lit spheres and their differences, errors over the angles that matter."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..color import srgb_encode
from ..errors import ParameterError
from ..metrics import LIGHT_ANGLES, Comparison, compare, error_map
from ..reflectance import Reflectance
from .page import COLOURS, DASHES, LEGEND, WIDTH, degrees_axis, figure_of, name_of
from .pictures import disc, sphere_picture

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SPHERE_ANGLES = (18, 54, 90, 126, 162)
"""Degrees between light and viewer of the spheres: each stands above its own place on the axis of the curves."""

GAIN = 10
"""How many times larger than they are differences are drawn."""

ERROR_RANGE = (1e-3, 1.0)
"""The ends of the error map's scale, the same in all figures so that they can be compared."""

LEFT, RIGHT = 1.18, 5.8
"""Inches: all panels begin and end here; on the left stand their names."""
GAP, TITLE, CURVE, MAP, AXIS, LINE = 0.06, 0.55, 1.1, 1.45, 0.52, 0.2
"""Inches: between spheres, the title, heights of a curve and of a map, an axis with its label, a line of text."""
BAR, BETWEEN = 0.7, 0.3
"""Inches: from the right that the scale of the maps takes, from map to map."""


def comparison(reference: Reflectance, *others: Reflectance, size: int = 192) -> Figure:
    """One or several reflectances against a reference, in one figure.

    Above: spheres in one light each, radiance pi f cos as sRGB, and ten times their absolute differences in sRGB.
    Middle: PSNR and mean CIEDE2000 of the sphere's picture against the angle between light and viewer. Below: the
    mean of |ln f_a cos / f_b cos| (1e-3 / sr added to both) over half and difference angle, over all azimuths above
    the horizon. `size`: pixels across a sphere. Raises ParameterError for no others, or more than colours tell apart.
    """
    return compared([compare(reference, other) for other in others], size)


def compared(comparisons: Sequence[Comparison], size: int = 192) -> Figure:
    """The figure of `comparison` for what `brdf.compare` and `brdf.metrics.rank` return, with the same reference."""
    count = len(comparisons)
    if not 1 <= count <= len(COLOURS):
        raise ParameterError(f"a comparison shows 1 to {len(COLOURS)} materials beside the reference, got {count}")
    sphere = (RIGHT - LEFT + GAP) / len(SPHERE_ANGLES)
    legend = LINE * math.ceil(count / 2) if count > 1 else 0.0
    columns = min(3, count)
    map_rows, map_title = math.ceil(count / columns), 2 * LINE if count > 1 else 0.0
    curves = TITLE + LINE + sphere * (1 + 2 * count) + LINE + legend
    maps = curves + 2 * CURVE + LINE / 2 + AXIS
    page = _Page(maps + map_rows * (map_title + MAP + LINE) + AXIS - LINE)
    against = name_of(comparisons[0].pair[1]) if count == 1 else f"{count} materials"
    title = f"{name_of(comparisons[0].pair[0])}\nagainst {against}"
    page.figure.suptitle(title, fontsize=11, parse_math=False, y=1 - GAP / page.height, va="top")
    _draw_spheres(page, comparisons, TITLE + LINE, sphere, size)
    _draw_curves(page, comparisons, curves)
    _draw_maps(page, comparisons, maps + map_title, columns, map_title + MAP + LINE)
    return page.figure


class _Page:
    """A figure with axes placed in inches from its upper left corner."""

    def __init__(self, height: float) -> None:
        self.height, self.figure = height, figure_of(height, layout=None)

    def axes(self, left: float, top: float, width: float, height: float) -> Any:
        box = (left / WIDTH, 1 - (top + height) / self.height, width / WIDTH, height / self.height)
        return self.figure.add_axes(box)

    def label(self, middle: float, text: str, left: float = LEFT - GAP) -> None:
        """A panel's name, which ends at `left`."""
        place = left / WIDTH, 1 - middle / self.height
        self.figure.text(*place, text, fontsize=9, ha="right", va="center", parse_math=False)


def _draw_spheres(page: _Page, comparisons: Sequence[Comparison], top: float, step: float, size: int) -> None:
    """A row for the reference, then for each other its spheres and the differences."""

    def row(name: str, pictures: list[Any], number: int) -> None:
        page.label(top + (number + 0.5) * step - GAP / 2, name)
        for column, picture in enumerate(pictures):
            axes = page.axes(LEFT + column * step, top + number * step, step - GAP, step - GAP)
            axes.imshow(np.clip(picture, 0, 1), interpolation="antialiased")
            axes.set_axis_off()
            if number == 0:
                axes.set_title(f"light {SPHERE_ANGLES[column]}°", fontsize=9, pad=3)

    def spheres(m: Reflectance) -> list[Any]:
        return [srgb_encode(sphere_picture(m, math.radians(angle), size)) for angle in SPHERE_ANGLES]

    reference = spheres(comparisons[0].pair[0])
    row(_wrapped(comparisons[0].pair[0], 14, 3), reference, 0)
    ground = ~disc(size)[2][..., None]
    for k, c in enumerate(comparisons):
        shown = spheres(c.pair[1])
        row(_wrapped(c.pair[1], 14, 3), shown, 2 * k + 1)
        differences = [np.where(ground, 1, GAIN * np.abs(a - b)) for a, b in zip(reference, shown, strict=True)]
        row(f"difference\n× {GAIN}", differences, 2 * k + 2)


def _draw_curves(page: _Page, comparisons: Sequence[Comparison], top: float) -> None:
    """PSNR and colour difference against the angle between light and viewer."""
    panels = {
        "PSNR\n[dB]": [c.psnr_by_angle for c in comparisons],
        "mean\nΔE2000": [c.delta_e_by_angle for c in comparisons],
    }
    for number, (label, curves) in enumerate(panels.items()):
        start = top + number * (CURVE + LINE / 2)
        axes = page.axes(LEFT, start, RIGHT - LEFT, CURVE)
        page.label(start + CURVE / 2, label, LEFT - 0.48)
        for k, (c, curve) in enumerate(zip(comparisons, curves, strict=True)):
            shown = np.where(np.isfinite(curve), curve, np.nan)
            name = name_of(c.pair[1], 24)
            axes.plot(LIGHT_ANGLES, shown, color=COLOURS[k], ls=DASHES[k], lw=1.6, label=name, clip_on=False)
        degrees_axis(axes, range(0, 181, 30), "angle between light and viewer" if number else "")
        if number:
            highest = max(float(curve.max()) for curve in curves)
            axes.set_ylim(0, 1.05 * highest or 1)
        else:
            axes.tick_params(labelbottom=False)
            if not np.isfinite(curves).any():
                axes.text(0.5, 0.5, "identical at every angle", transform=axes.transAxes, ha="center", fontsize=9)
                axes.set_yticks([])
            if len(comparisons) > 1:
                above = {"loc": "lower left", "bbox_to_anchor": (-0.015, 1.0), "ncols": 2, "columnspacing": 1.0}
                axes.legend(**above, borderaxespad=0.1, **LEGEND)


def _draw_maps(page: _Page, comparisons: Sequence[Comparison], top: float, columns: int, step: float) -> None:
    """The error over half and difference angle, one map a comparison."""
    from matplotlib.colors import LogNorm

    across = (RIGHT - LEFT - BAR + BETWEEN) / columns
    ticks = (0, 2, 10, 25, 50, 90) if columns < 3 else (0, 10, 45, 90)
    count, rows = len(comparisons), math.ceil(len(comparisons) / columns)
    for k, c in enumerate(comparisons):
        row, column = divmod(k, columns)
        axes = page.axes(LEFT + column * across, top + row * step, across - BETWEEN, MAP)
        error = np.maximum(error_map(*c.pair), ERROR_RANGE[0] / 10)
        drawn = axes.imshow(
            error, origin="lower", extent=(0, 1, 0, 90), aspect="auto", cmap="cividis", norm=LogNorm(*ERROR_RANGE)
        )
        if count > 1:
            axes.set_title(_wrapped(c.pair[1], 44 // columns, 2), fontsize=9, parse_math=False, pad=3)
        axes.set_xticks([math.sqrt(t / 90) for t in ticks], [f"{t}°" for t in ticks])
        axes.set_yticks(range(0, 91, 30), [f"{t}°" for t in range(0, 91, 30)])
        axes.tick_params(labelsize=9, labelleft=column == 0, labelbottom=k + columns >= count)
        if k + columns >= count:
            axes.set_xlabel("half angle θh")
    height = (rows - 1) * step + MAP
    page.label(top + height / 2, "difference\nangle θd", LEFT - 0.48)
    bar = page.figure.colorbar(drawn, cax=page.axes(RIGHT - BAR + 0.15, top, 0.12, height), extend="both")
    bar.set_ticks([1e-3, 1e-2, 1e-1, 1])
    bar.set_label("mean |ln ratio| of f cos", fontsize=9)
    bar.ax.tick_params(labelsize=9)


def _wrapped(m: Reflectance, width: int, lines: int) -> str:
    """The name on several lines, broken after punctuation where that is possible."""
    broken = [""]
    for part in re.findall(rf".{{1,{width}}}?(?:[-_,:@+/ ]|\.(?=[a-z])|$)|.{{1,{width}}}", name_of(m, width * lines)):
        if broken[-1] and len(broken[-1]) + len(part) > width:
            broken.append("")
        broken[-1] += part
    kept = [line.strip() for line in broken[:lines]]
    if len(broken) > lines:
        kept[-1] = kept[-1][: width - 1] + "…"
    return "\n".join(kept)
