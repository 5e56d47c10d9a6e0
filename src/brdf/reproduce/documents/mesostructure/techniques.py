"""Figure 6: the four techniques of looking pictures up, in pictures and against complete BTFs."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....capture import FlatSample, simulate, simulate_btf
from ....color import luminance
from ....geometry.directions import from_spherical
from ....render import render
from ....render.progress import Progress
from ....representations.btf import BTF
from ....representations.shading.lookup import TECHNIQUES as LOOKUPS
from ....representations.shading.shading_map import ShadingMap
from ...pictures import developed
from ...report import Column, Panel, Report
from .samples import Sample, named, relative, sun, under_phong
from .settings import Settings

Floats = NDArray[np.floating[Any]]

LIT, WEAK, STRONG, ANGULAR, SHADING = (
    "lit texture", "lookup with L, light × 1/4", "lookup with L, light × 4", "angular lookup", "lookup with r",
)  # fmt: skip
TECHNIQUES: Mapping[str, Mapping[str, Any]] = {
    LIT: {"technique": "lit-texture"},
    WEAK: {"technique": "radiance", "intensity": 0.25},
    STRONG: {"technique": "radiance", "intensity": 4.0},
    ANGULAR: {"technique": "angular"},
    SHADING: {"technique": "shading"},
}

ROWS = (("plastic", 5.0), ("plastic", 60.0), ("cloth", 10.0), ("wool", 5.0), ("stone", 10.0))
"""Materials and Phong exponents of the figure."""
HIGHLIGHT = 0.4

ELEVATIONS = (0.0, 20.0, 40.0, 60.0, 75.0)
AZIMUTHS = (0.0, 90.0, 180.0, 270.0)
"""Of the lamp [degrees]; it was photographed at azimuth 0."""
VIEWS = ((0.0, 0.0), (30.0, 60.0), (30.0, 240.0), (60.0, 0.0), (60.0, 200.0))
"""Angle from the normal and azimuth [degrees]."""
HIGH, LOW = (slice(0, 3), slice(3, 5))
"""Lamps at 40 degrees or less, at 60 or more."""
PICTURED = (3, 0, 1)
"""Elevation, azimuth and view that the pictures against the truth have."""


@dataclass(frozen=True)
class Errors:
    """By technique (materials, elevations, azimuths, views, 2): relative RMS per texel, and of sorted luminances."""

    names: list[str]
    found: Mapping[str, Floats]

    def mean(
        self, technique: str, kind: int, elevations: slice, azimuths: slice, names: Sequence[str] | None = None
    ) -> float:
        """`kind` 0: per texel, 1: of the distribution."""
        rows = [self.names.index(name) for name in names or self.names]
        return float(self.found[technique][rows][:, elevations, azimuths, :, kind].mean())


KINDS = ("per texel", "histogram")
AROUND = ("as photographed", "all around")
COLUMNS: Mapping[str, tuple[int, slice, slice]] = {
    f"{kind}, θi {angles}, {azimuth}": (number, part, turned)
    for azimuth, turned in zip(AROUND, (slice(0, 1), slice(0, 4)), strict=True)
    for angles, part in (("≤ 40°", HIGH), ("≥ 60°", LOW))
    for number, kind in enumerate(KINDS)
}
"""Kind of error, lamps and azimuths by title: first those where the lamp was photographed."""


def present(report: Report, settings: Settings, samples: Sequence[Sample]) -> Errors:
    """The figure, and its numbers, which are returned."""
    _rendered(report, settings, samples)
    errors = _measured(report, settings, [sample.name for sample in samples])
    for number, azimuth in enumerate(AROUND):
        _table(report, settings, errors, azimuth, ("techniques", "techniques-all-around")[number])
    _by_material(report, errors)
    return errors


def _table(report: Report, settings: Settings, errors: Errors, azimuth: str, name: str) -> None:
    """Means over the materials."""
    columns = {title: where for title, where in COLUMNS.items() if title.endswith(azimuth)}
    best = {title: min(TECHNIQUES, key=lambda way: errors.mean(way, *where)) for title, where in columns.items()}
    lost = [f"{_short(title)} ({technique})" for title, technique in best.items() if technique != SHADING]
    report.table(
        name,
        f"The techniques against complete BTFs, the lamp {azimuth}",
        ["technique", *(Column(_short(title), "1", ".3f", "ours") for title in columns)],
        [[technique, *(errors.mean(technique, *where) for where in columns.values())] for technique in TECHNIQUES],
        f"Mean over {len(errors.names)} materials and {len(VIEWS)} views of the relative RMS error; truth: ray-marched "
        f"BTFs of {settings.btf}² texels with masking and parallax. r is the true average of the picture, so that what "
        "differs is the structure. Histogram: RMS difference of the sorted luminances.",
        f"Lookup with r is lowest in {len(columns) - len(lost)} of {len(columns)} columns"
        + (f"; elsewhere: {', '.join(lost)}." if lost else "."),
    )


def _by_material(report: Report, errors: Errors) -> None:
    shown = (LIT, ANGULAR, SHADING)
    for number, kind in enumerate(KINDS):
        columns = {title: where for title, where in list(COLUMNS.items())[:4] if where[0] == number}
        report.table(
            f"techniques-materials-{number + 1}",
            f"Material by material: {kind}",
            ["material", *(Column(f"{technique}, {title.split(', ')[1]}", "1", ".2f", "ours")
                           for title in columns for technique in shown)],
            [
                [name, *(errors.mean(technique, *where, names=[name])
                         for where in columns.values() for technique in shown)]
                for name in errors.names
            ],
            f"The lamp {AROUND[0]}.",
        )  # fmt: skip


def _short(title: str) -> str:
    """Without the azimuth."""
    return title.rsplit(", ", 1)[0]


def _rendered(report: Report, settings: Settings, samples: Sequence[Sample]) -> None:
    """The figure itself."""
    rows: dict[str, list[Panel]] = {}
    present = [(name, exponent) for name, exponent in ROWS if any(sample.name == name for sample in samples)]
    with Progress("figure 6", len(present) * len(TECHNIQUES), None) as bar:
        for name, exponent in present:
            h = under_phong(named(samples, name).native, HIGHLIGHT, exponent)
            panels = []
            for technique, options in TECHNIQUES.items():
                image = render(h.replaced(**options), lights=sun(h), size=settings.picture, background="transparent",
                               progress=False)  # fmt: skip
                panels.append(Panel(image.developed(), technique))
                bar.step()
            rows[f"{name}, N = {exponent:g}"] = panels
    report.figure(
        "figure-6",
        "Figure 6. The techniques under the modified Phong model with exponent N. All reflect the same on average; "
        "they differ in the structure shown. The paper's second column depends on how strong the light is: here twice.",
        rows,
    )


def _measured(report: Report, settings: Settings, names: list[str]) -> Errors:
    lights = from_spherical(*np.radians(np.stack(np.meshgrid(ELEVATIONS, AZIMUTHS, indexing="ij")).reshape(2, -1)))
    views = from_spherical(*np.radians(VIEWS).T)
    shape = (len(ELEVATIONS), len(AZIMUTHS), len(VIEWS), 2)
    found: dict[str, list[Floats]] = {technique: [] for technique in TECHNIQUES}
    rows: dict[str, list[Panel]] = {}
    with Progress("techniques against BTFs", len(names), None) as bar:
        for name in names:
            btf = simulate_btf(name, lights, views, settings.btf)
            ways = _looked_up(simulate(name, size=settings.btf), btf)
            for technique, pictures in ways.items():
                pairs = np.ndindex(len(lights), len(views))
                errors = [relative(pictures(pair), btf.images[pair]) for pair in pairs]
                found[technique].append(np.reshape(errors, shape))
            if name in dict(ROWS):
                rows[name] = _against_truth(btf, ways)
            bar.step()
    elevation, azimuth, view = PICTURED
    report.figure(
        "figure-6-truth",
        f"The flat sample, lit at {ELEVATIONS[elevation]:g}°, azimuth {AZIMUTHS[azimuth]:g}°, seen from "
        f"{VIEWS[view][0]:g}°, azimuth {VIEWS[view][1]:g}°: the truth, and what each technique shows; relative RMS per "
        "texel / of the histogram.",
        rows,
    )
    return Errors(names, {technique: np.stack(errors) for technique, errors in found.items()})


def _looked_up(taken: FlatSample, btf: BTF) -> dict[str, Callable[[tuple[int, ...]], Floats]]:
    """By technique what it shows of the pair (light, view): r the average of the truth."""
    h = taken.shading_map()

    def pictures(m: ShadingMap, pair: tuple[int, ...]) -> Floats:
        cosine = float(btf.lights[pair[0], 2])
        return shown(m, float(luminance(btf.images[pair].astype(np.float64)).mean()) * cosine, cosine) / cosine

    return {technique: partial(pictures, h.replaced(**options)) for technique, options in TECHNIQUES.items()}


def shown(h: ShadingMap, r: float, cosine: float) -> Floats:
    """The flat sample in the map's technique, (rows, columns, 3): its average is r, the lamp's cosine `cosine`."""
    bound = SimpleNamespace(stack=h.stack, elevations=h.elevations, **h.values)
    level = float(LOOKUPS[h.technique](bound, r, cosine))
    level = min(max(level, h.stack.lowest), h.stack.highest)
    return h.stack.picture(level) * (r / level)


def _against_truth(btf: BTF, ways: Mapping[str, Callable[[tuple[int, ...]], Floats]]) -> list[Panel]:
    elevation, azimuth, view = PICTURED
    pair = (elevation * len(AZIMUTHS) + azimuth, view)
    truth = btf.images[pair]
    white = float(np.quantile(truth, 0.995))
    panels = [Panel(developed(np.clip(truth / white, 0, 1)), "the truth")]
    for technique, pictures in ways.items():
        picture = pictures(pair)
        texel, histogram = relative(picture, truth)
        panels.append(
            Panel(developed(np.clip(picture / white, 0, 1)), f"{technique}: {texel:.2f} / {histogram:.2f}")
        )  # fmt: skip
    return panels
