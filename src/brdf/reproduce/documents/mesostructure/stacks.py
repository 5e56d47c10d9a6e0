"""Figures 2 and 3: photographs, the shading map made of them, and how it is looked up."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....color import luminance
from ....render import render
from ....representations.shading.shading_map import ShadingMap
from ...pictures import developed
from ...report import Cell, Column, Panel, Report
from .samples import Sample, named, slices_of, sun
from .settings import SHOWN, SLICES, Settings

Floats = NDArray[np.floating[Any]]

WARM = (1.0, 0.75, 0.45)
"""Colour of the light in figure 2, so that the last step shows."""

LEVELS = 64
"""Values of r, up to twice the brightest picture's, at which averages are checked."""


@dataclass(frozen=True)
class Averages:
    """What the resampling does, material by material."""

    worst: float
    """The largest |mean Y(S(r)) / r - 1| of all materials, modes and r."""
    negative: int
    """Materials of which the literal reading of the paper makes negative pixels."""
    count: int


def present(report: Report, settings: Settings, samples: Sequence[Sample]) -> Averages:
    """The figures, and a table of averages."""
    sample = named(samples, SHOWN)
    _overview(report, settings, sample)
    slices = slices_of(sample.even)
    pictures = [np.zeros_like(slices.pictures[:, :, 0]), *np.moveaxis(slices.pictures, 2, 0)]
    steps = [0.0, *slices.nodes]
    report.figure(
        "figure-3",
        f"Figure 3. The shading map of {sample.name}: {SLICES} pictures of evenly rising average.",
        {"": [_panel(sample, p, f"r = {r:.3f}") for p, r in zip(pictures, steps, strict=True)]},
    )
    return _table(report, samples)


def _overview(report: Report, settings: Settings, sample: Sample) -> None:
    taken = sample.taken
    photographs = [
        _panel(sample, image, f"{angle:g}°, a = {average:.3f}")
        for image, angle, average in zip(taken.images, taken.elevations, taken.averages, strict=True)
    ]
    half = -(-len(photographs) // 2)
    h = sample.under_phong(sample.even)
    lit = [(h.children["brdf"] * h.sigma, sun(h)), (h, sun(h)), (h, sun(h, WARM))]
    shown = [render(m, lights=light, size=settings.picture, background="transparent", progress=False)
             for m, light in lit]  # fmt: skip
    words = ("r = σ f cos θ, for each pixel", "S(r): the map looked up", "S(r) L: the lamp's colour")
    report.figure(
        "figure-2",
        f"Figure 2. From photographs to a picture: {sample.name} under a lamp at ten angles from the normal, with the "
        "average a of each; then r, what it looks up, and the lamp. Here and below the shipped teapot stands for the "
        "paper's bunny.",
        {
            "acquired, the lamp high": photographs[:half],
            "acquired, the lamp low": photographs[half:],
            "rendered": [Panel(image.developed(), text) for image, text in zip(shown, words, strict=True)],
        },
    )


def _panel(sample: Sample, picture: Floats, label: str) -> Panel:
    return Panel(developed(np.clip(picture / sample.white, 0, 1)), label)


def _table(report: Report, samples: Sequence[Sample]) -> Averages:
    rows: list[list[Cell]] = []
    worst, negative = 0.0, 0
    for sample in samples:
        deviation = max(_deviation(h) for h in (sample.native, sample.even))
        made = literal(sample)
        least = float(made.min()) / sample.white
        dropped = ", ".join(f"{angle:g}°" for angle in sample.native.dropped) or "none"
        anisotropy = sample.taken.checks.anisotropy
        rows.append([sample.name, sample.native.stack.highest, anisotropy, dropped, deviation, least])
        worst, negative = max(worst, deviation), negative + (least < 0)
    report.table(
        "averages",
        "Averages of the pictures looked up",
        [
            "material",
            Column("brightest average", "1/sr", ".3f", "ours"),
            Column("anisotropy", "1", ".2f", "ours"),
            "photographs left out",
            Column("mean Y(S(r)) against r, worst", "1", ".1e", "ours"),
            Column("literal reading: least pixel", "of white", ".3f", "ours"),
        ],
        rows,
        f"r at {LEVELS} values up to twice the brightest picture's average, in both storage modes. Literal reading: "
        "the two photographs with the closest averages, on whichever side they lie; ours takes the two that bracket r. "
        "Photographs are left out where averages do not fall towards grazing light.",
        f"Read literally, the paper's resampling makes negative pixels of {negative} of {len(rows)} materials.",
    )
    return Averages(worst, negative, len(rows))


def _deviation(h: ShadingMap) -> float:
    """The largest relative difference between the average of S(r) and r."""
    levels = np.arange(1, LEVELS + 1) * (2 * h.stack.highest / LEVELS)
    return max(abs(float(luminance(h.picture(r)).mean()) / float(r) - 1) for r in levels)


def literal(sample: Sample) -> Floats:
    """(SLICES, rows, columns, 3): interpolated linearly between the two photographs with the closest averages."""
    images, a = sample.taken.images.astype(np.float64), sample.taken.averages
    made = []
    for wanted in a.max() * np.arange(SLICES) / (SLICES - 1):
        first, second = np.argsort(np.abs(a - wanted), kind="stable")[:2]
        t = (wanted - a[first]) / (a[second] - a[first])
        made.append((1 - t) * images[first] + t * images[second])
    return np.stack(made)
