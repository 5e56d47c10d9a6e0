"""Figure 6: error and time of the parameterisations against the number of nodes."""

from __future__ import annotations

import math
import time
from collections import defaultdict

import numpy as np

from ....formula.engine import SMALL
from ....formula.kernels import compile_ahead
from ....loading import load
from ....reflectance import Reflectance
from ....render.progress import Progress
from ....representations.baking.alpha_search import with_alpha
from ....representations.baking.bake import bake_points
from ....representations.tables.layout import Layout
from ....representations.tables.layouts import named_layout, shape_of
from ....threads import cores
from ...charts import curves
from ...report import Column, Report
from .measuring import choices_of
from .options import BEZIER, HALF_LOG, IDENTITY, INTENSE, MEASURED, UNIFORM, Alphas
from .pictures import View
from .settings import Settings
from .teapots import SHOWN

MATERIALS = ("nickel", "GGX plastic, α 0.1", "blue-metallic-paint")
"""Of figure 4, the first ones: what has a highlight."""

STORAGE = "float32"
"""So that the parameterisation alone counts."""

TIMED = {IDENTITY: ("normal", "identity"), UNIFORM: ("normal", "uniform"), BEZIER: ("normal", "bezier"),
         HALF_LOG: ("half", "bezier")}  # fmt: skip
"""What is timed: alphas cost nothing."""

ROUNDS = 5
"""Directions by the light's brightness, and as many by the reflectance: ten rays a pixel, as in the paper."""


class Resolutions(dict[tuple[str, int], float]):
    """A number by (option, N)."""

    @property
    def options(self) -> list[str]:
        return list(dict.fromkeys(option for option, _ in self))

    @property
    def sizes(self) -> list[int]:
        return sorted({n for _, n in self})


def present(report: Report, settings: Settings) -> tuple[Resolutions, Resolutions]:
    """Figure 6; returns the RMS of the pictures (geometric mean over the materials) and nanoseconds a lookup."""
    view = View({"env": "studio", "size": settings.timed, "samples": ROUNDS, "supersampling": 1})
    errors, shown = _errors(view, settings)
    times = _times(view, settings)
    ticks: dict[float, str] = {n: str(n) for n in errors.sizes}
    for name, caption, found, label in (
        ("figure-6-error", "RMS of the teapot's picture", errors, "RMS, in parts of the RMS radiance"),
        ("figure-6-time", "Time of a lookup", times, "nanoseconds"),
    ):
        report.figure(
            name,
            f"Figure 6. {caption} against N, N × N × 2N nodes.",
            curves({o: (found.sizes, [found[o, n] for n in found.sizes]) for o in found.options}, "N", label, ticks,
                   x_scale="log", y_scale="log" if found is errors else "linear"),
        )  # fmt: skip
    columns = [Column(f"N = {n}", "%", ".3g", "ours") for n in errors.sizes]
    report.table(
        "figure-6-error",
        "Figure 6. RMS of the teapot's picture",
        ["material", "parameterisation", *columns],
        [[material, option, *(100 * shown[material][option, n] for n in errors.sizes)]
         for material in shown for option in errors.options],
        f"{settings.timed[0]} x {settings.timed[1]} pixels, {2 * ROUNDS} rays to the studio a pixel, the same for all "
        "tables; RMS of the radiance in parts of the RMS radiance; 32-bit floats.",
    )  # fmt: skip
    report.table(
        "figure-6-time",
        "Figure 6. Time of a lookup",
        ["parameterisation", *(Column(f"N = {n}", "ns", ".1f", "ours") for n in times.sizes)],
        [[option, *(times[option, n] for n in times.sizes)] for option in times.options],
        f"All lookups of that picture in their order, compiled, 32-bit, on {cores()} cores at once, the fastest of "
        f"{settings.repeats} rounds over all of them. A table has 12 bytes a node: {_megabytes(times.sizes[0])} the "
        f"smallest, {_megabytes(times.sizes[-1])} the largest. The paper's are from an NVIDIA GTX 580M.",
    )
    return errors, times


def _megabytes(n: int) -> str:
    return f"{2 * n**3 * 12 / 2**20:.2g} MB"


def _layouts(n: int) -> dict[str, Layout]:
    return {o: named_layout(basis, warp, shape_of(basis, n), STORAGE) for o, (basis, warp) in TIMED.items()}


def _sized(m: Reflectance, n: int, alphas: dict[str, Alphas]) -> dict[str, Layout]:
    """The layouts whose errors are measured."""
    made = _layouts(n)
    bezier = {o: with_alpha(m, made[BEZIER], alphas[a]) for o, a in ((INTENSE, "intensity"), (MEASURED, "measured"))}
    half = made.pop(HALF_LOG)
    return {**made, **bezier, HALF_LOG: half}


def _errors(view: View, settings: Settings) -> tuple[Resolutions, dict[str, Resolutions]]:
    shown: dict[str, Resolutions] = defaultdict(Resolutions)
    names = MATERIALS[: settings.shown]
    with Progress("figure 6", len(names) * len(settings.resolutions), None) as bar:
        for name in names:
            m = load(SHOWN[name])
            _, alphas = choices_of(SHOWN[name])
            true = view.image(m)
            for n in settings.resolutions:
                for option, layout in _sized(m, n, alphas).items():
                    shown[name][option, n] = view.of(bake_points(m, layout), m, true).rms
                bar.step()
    keys = next(iter(shown.values()))
    mean = {key: math.exp(float(np.mean([math.log(shown[name][key]) for name in names]))) for key in keys}
    return Resolutions(mean), shown


def _times(view: View, settings: Settings) -> Resolutions:
    m = load(SHOWN[MATERIALS[0]])
    wi, wo = view.pairs(m)
    tables = {(o, n): bake_points(m, layout) for n in settings.resolutions for o, layout in _layouts(n).items()}
    made = list(tables.values())
    if len(wi) >= SMALL:
        for core in range(cores()):
            compile_ahead(made[core :: cores()])
    times = Resolutions(dict.fromkeys(tables, math.inf))
    with Progress("times of figure 6", (1 + settings.repeats) * len(tables), None) as bar:
        for turn in range(1 + settings.repeats):
            for key, table in tables.items():
                start = time.perf_counter()
                table(wi, wo)
                if turn:  # in the first one kernels are compiled
                    times[key] = min(times[key], 1e9 * (time.perf_counter() - start) / len(wi))
                bar.step()
    return times
