"""Photographs that maps have not seen: in between, left out, and of a real sample."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....capture import FlatSample, flat
from ....render import render
from ....representations.shading.compression import white
from ...charts import curves
from ...pictures import developed
from ...report import Cell, Column, Panel, Report
from .samples import Sample, decibels, geometric, predicted, rms, slices_of, sun
from .settings import BETWEEN, Settings

Floats = NDArray[np.floating[Any]]

REAL = Path("flat") / "loewenkopf"
"""Photographs of a real relief below the folder that BRDF_DATA names (© 2020 KINoAI, MIT licence)."""


@dataclass(frozen=True)
class Predictions:
    """By material; PSNR [dB] with white as the peak."""

    at_photographs: Mapping[str, float]
    between: Mapping[str, float]
    left_out: Mapping[str, float]
    real: float | None
    """Leave-one-out of the real sample, where it is there."""

    @staticmethod
    def mean(found: Mapping[str, float]) -> float:
        """The PSNR of the geometric mean of the materials' RMS errors."""
        return float(np.mean(list(found.values())))


def present(report: Report, settings: Settings, samples: Sequence[Sample]) -> Predictions:
    """The table, the charts, and the real sample where there is one."""
    taken, between, outs = {}, {}, {}
    by_angle: dict[float, list[tuple[float, float]]] = {angle: [] for angle in BETWEEN}
    for sample in samples:
        h = sample.native
        pictures = sample.between.images
        found = [rms(predicted(h, angle), picture) for angle, picture in zip(BETWEEN, pictures, strict=True)]
        for angle, error, picture in zip(BETWEEN, found, pictures, strict=True):
            by_angle[angle].append((error / sample.white, error / float(picture.mean())))
        between[sample.name] = decibels(error / sample.white for error in found)
        kept = [rms(predicted(h, angle), sample.taken.images[k]) / sample.white
                for k, angle in enumerate(sample.taken.elevations) if angle not in h.dropped]  # fmt: skip
        taken[sample.name] = max(kept)
        outs[sample.name] = decibels(left_out(sample.taken).values())
    real = _real_sample()
    alone = None if real is None else left_out(real)
    result = Predictions(taken, between, outs, None if alone is None else decibels(alone.values()))
    rows: list[list[Cell]] = [[name, taken[name], between[name], outs[name]] for name in between]
    rows.append(["all", max(taken.values()), Predictions.mean(between), Predictions.mean(outs)])
    if real is not None:
        rows.append([f"{real.name} (real)", _own(real), None, result.real])
    report.table(
        "prediction",
        "Photographs predicted from the average BRDF",
        ["sample", Column("its own, worst RMS", "of white", ".0e", "ours"), Column("in between", "dB", ".1f", "ours"),
         Column("one left out", "dB", ".1f", "ours")],
        rows,
        f"PSNR over all pictures, white as the peak; all: of the geometric mean of the RMS. In between: "
        f"{BETWEEN[0]:g}, {BETWEEN[1]:g}, … {BETWEEN[-1]:g}°. One left out: each photograph but the highest and the "
        "lowest lamp's, from a map and an average BRDF of the others.",
        "" if real is not None else "No photographs of a real sample: BRDF_DATA does not name a folder that has them.",
    )  # fmt: skip
    report.figure(
        "prediction",
        "Error of the photographs in between, geometric mean over materials, against the lamp's angle.",
        curves(
            {words: (BETWEEN, [geometric(pair[kind] for pair in by_angle[angle]) for angle in BETWEEN])
             for kind, words in enumerate(("over white", "over the picture's own mean"))},
            "lamp from the normal [degrees]", "RMS error", y_scale="log",
        ),
    )  # fmt: skip
    if real is not None:
        _show(report, settings, real)
    return result


def left_out(taken: FlatSample) -> dict[float, float]:
    """By angle: RMS error, as a share of white, of each inner photograph predicted from the others."""
    brightest = white(slices_of(taken.shading_map()))
    found = {}
    for k in range(1, len(taken.images) - 1):
        h = _without(taken, k)
        found[float(taken.elevations[k])] = rms(predicted(h, taken.elevations[k]), taken.images[k]) / brightest
    return found


def _without(taken: FlatSample, k: int) -> Any:
    others = FlatSample(np.delete(taken.images, k, 0), np.delete(taken.elevations, k), taken.name)
    return others.shading_map()


def _own(taken: FlatSample) -> float:
    h = taken.shading_map()
    brightest = white(slices_of(h))
    return max(
        rms(predicted(h, angle), taken.images[k]) / brightest
        for k, angle in enumerate(taken.elevations) if angle not in h.dropped
    )  # fmt: skip


def _real_sample() -> FlatSample | None:
    """The photographs of the real relief, where BRDF_DATA names a folder with them."""
    folder = os.environ.get("BRDF_DATA")
    return flat(Path(folder) / REAL) if folder and (Path(folder) / REAL).is_dir() else None


def _show(report: Report, settings: Settings, real: FlatSample) -> None:
    h = real.shading_map()
    brightest = white(slices_of(h))
    enlarged = max(1, 192 // max(real.images.shape[1:3]))

    def panel(picture: Floats, label: str) -> Panel:
        shown = developed(np.clip(picture / brightest, 0, 1))
        return Panel(shown.repeat(enlarged, 0).repeat(enlarged, 1), label)

    inner = range(1, len(real.images) - 1)
    angles = real.elevations
    image = render(h, lights=sun(h), size=settings.picture, background="transparent", progress=False)
    report.figure(
        "real",
        f"A real sample ({real.name}, {len(real.images)} of its photographs, lamps nearest to an arc): each inner "
        "photograph, and what the others predict; then all of them on the teapot.",
        {
            "photographed": [panel(real.images[k], f"{angles[k]:.0f}°") for k in inner],
            "predicted from the others": [panel(predicted(_without(real, k), angles[k]), f"{angles[k]:.0f}°")
                                          for k in inner],
            "on the teapot": [Panel(image.developed())],
        },
    )  # fmt: skip
