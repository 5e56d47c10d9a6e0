"""Many fits on one page: errors beside each other, and a sphere of every fit beside its data."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..color import srgb_encode
from ..container import replacing
from ..errors import BrdfError
from ..loading import load
from ..plot.pictures import sphere_picture
from ..reflectance import Reflectance
from .page import page
from .report import Column, Panel, Report

LIGHT = 50
"""Degrees between light and viewer."""
SIZE = 112
"""Pixels of a sphere."""


def panel(m: Reflectance, label: str, size: int = SIZE) -> Panel:
    """A lit sphere, radiance pi f cos as sRGB."""
    picture = np.clip(srgb_encode(sphere_picture(m, math.radians(LIGHT), size)), 0, 1)
    return Panel(np.round(255 * picture).astype(np.uint8), label)


def write_page(fits: Sequence[Mapping[str, Any]], folder: Path) -> Path:
    """`index.html` in the folder of the fits."""
    report = Report(
        "fits", "Fits", f"{len(fits)} fits by brdf fit", {"metric": fits[0]["metric"], "starts": fits[0]["starts"]}
    )
    report.section("Errors", "The distance between fit and data in each metric; of a material the least first.")
    metrics = list(dict.fromkeys(name for one in fits for name in one["errors"]))
    names = _names(fits)
    ranked = sorted(fits, key=lambda one: (names[one["path"]], one["cost"]))
    rows = [
        [names[one["path"]], one["model"], *(one["errors"].get(m) for m in metrics), one["agreeing"], one["seconds"]]
        for one in ranked
    ]
    numbers = [
        *(Column(m, "1", ".3g", "ours") for m in metrics),
        Column("starts that agree", "1"),
        Column("time", "s", ".1f"),
    ]
    report.table("errors", "Errors of all fits", ["data", "model", *numbers], rows)
    report.section("Spheres", f"The data first, then the fits, light {LIGHT}° from the viewer.")
    shown: dict[str, list[Panel]] = {}
    for one in ranked:
        name = names[one["path"]]
        if name not in shown:
            shown[name] = _of_data(one["path"])
        shown[name].append(panel(Reflectance.restore(folder / one["file"]), one["model"]))
    report.figure("spheres", "radiance π f cos as sRGB", shown)
    with replacing(folder / "index.html") as temporary:
        temporary.write_text(page(report), "utf-8")
    return folder / "index.html"


def _names(fits: Sequence[Mapping[str, Any]]) -> dict[str, str]:
    """What to call the data of each path: the path itself where others have the same name."""
    names = {one["path"]: one["data"] for one in fits}
    count = Counter(names.values())
    return {path: name if count[name] == 1 else path for path, name in names.items()}


def _of_data(path: str) -> list[Panel]:
    """None of photographs, which are no material."""
    try:
        return [panel(load(path), "data")]
    except BrdfError:
        return []
