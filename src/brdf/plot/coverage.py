"""Which directions a capture has seen."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..capture.ball.coverage import Coverage
from .page import degrees_axis, figure_of, titled

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HEIGHT = 4.0


def coverage(seen: Coverage) -> Figure:
    """Over half and difference angle, the share of the azimuths phi_d that was seen; white: none was.

    Hatched: no directions above the horizon.
    """
    from matplotlib import colormaps

    figure = figure_of(HEIGHT)
    titled(figure, f"seen: {seen.share:.0%} of all half angles, difference angles and azimuths")
    axes: Any = figure.subplots()
    shares = seen.map.T
    axes.set_facecolor("0.85")
    axes.patch.set(hatch="///", edgecolor="0.7")
    colours = colormaps["cividis"].with_extremes(under="white")
    masked = np.ma.masked_invalid(shares)
    drawn = axes.imshow(
        masked, origin="lower", extent=(0, 90, 0, 90), aspect="auto", cmap=colours, vmin=1e-6, vmax=1,
        interpolation="nearest",
    )  # fmt: skip
    ticks = range(0, 91, 15)
    degrees_axis(axes, ticks, "half angle θh")
    axes.set_ylim(0, 90)
    axes.set_yticks(ticks, [f"{t}°" for t in ticks])
    axes.set_ylabel("difference angle θd")
    figure.colorbar(drawn, ax=axes, label="share of azimuths φd seen", extend="min")
    return figure
