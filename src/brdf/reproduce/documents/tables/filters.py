"""Figure 7: what a coarse table shows of its nodes, filter by filter."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....color import luminance
from ....loading import load
from ....render import Camera, Point
from ....representations.tables.filters import FILTERS
from ....representations.tables.table import Table
from ...pictures import error_picture
from ...report import Column, Panel, Report
from .pictures import View, compared, error_panel, panel
from .settings import Settings

Array = NDArray[np.floating[Any]]

MATERIAL = "GGX:alpha=.2,F0=1/.78/.34"

NODES = 14
"""N: nodes 7 degrees apart, about as wide as the lobe's slope."""

CAMERA, LAMP = Camera((0, 1.1, 1.0), fov=32), (0, 1.1, -1.0)
"""Above a plane; a circle about the foot of either is one angle, and a node's circle a crease where it is one."""

BRIGHTEST = 0.8
"""Radiance of the highlight's middle."""


def present(report: Report, settings: Settings) -> Mapping[str, float]:
    """Figure 7; returns by filter how strong its creases are, 1 being the linear filter's."""
    m = load(MATERIAL)
    side = settings.frame[1]
    scene = {"mesh": "plane", "camera": CAMERA, "size": (side, side)}
    power = BRIGHTEST / float(View({**scene, "lights": Point(LAMP)}).image(m).pixels.max())
    view = View({**scene, "lights": Point(LAMP, power)})
    true = view.image(m)
    pictures = {
        how: compared(view.image(Table.bake(m, "normal", "uniform", NODES, "float32", filter=how), m), true)
        for how in FILTERS
    }
    curvatures = {how: _curvature(p.image.pixels) - _curvature(true.pixels) for how, p in pictures.items()}
    creases = {how: float(np.sqrt(np.mean(c**2))) for how, c in curvatures.items()}
    strongest = float(np.quantile(np.abs(curvatures["linear"]), 0.99))
    worst = float(np.quantile(pictures["linear"].error, 0.999))
    report.figure(
        "figure-7",
        f"Figure 7. A highlight on a plane, seen from a table of {NODES} × {NODES} × {2 * NODES} nodes, evenly spaced "
        "angles. Below: the errors, and the second differences from pixel to pixel, less the model's, which "
        "show the creases along the nodes' ellipses.",
        {
            "": [*(panel(p, how) for how, p in pictures.items()), Panel(true.developed("clip"), "the model")],
            "Errors": [error_panel(p, how, worst) for how, p in pictures.items()],
            "Creases": [
                Panel(error_picture(np.abs(c), strongest, unit="radiance"), how) for how, c in curvatures.items()
            ],
        },
    )
    found = {how: crease / creases["linear"] for how, crease in creases.items()}
    report.table(
        "figure-7",
        "Figure 7 in numbers",
        ["filter", Column("RMS", "%", ".3f", "ours"), Column("RMS, sRGB", "levels of 255", ".3f", "ours"),
         Column("creases, linear 1", "1", ".4f", "ours")],
        [[how, 100 * p.rms, 255 * p.display, found[how]] for how, p in pictures.items()],
        f"{MATERIAL}, {side}² pixels, no diffuse part. Creases: the RMS over the pixels of the second differences of "
        "the luminance, less the model's.",
    )  # fmt: skip
    return found


def _curvature(pixels: Array) -> Array:
    """(H - 2, W - 2): the sum of both second differences of the luminance."""
    y = luminance(pixels.astype(np.float64))
    middle = y[1:-1, 1:-1]
    return np.asarray(y[1:-1, 2:] + y[1:-1, :-2] + y[2:, 1:-1] + y[:-2, 1:-1] - 4 * middle)
