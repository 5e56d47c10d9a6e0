"""Figures 4 and 5: tables on the teapot in the light of a studio, and an anisotropic one under three lights."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ....loading import load
from ....render import Directional, Point
from ....render.progress import Progress
from ....representations.baking.alpha_search import with_alpha
from ....representations.baking.bake import bake_points
from ....representations.tables.layouts import named_layout, shape_of
from ....representations.tables.table import Table
from ...report import Column, Panel, Report
from .measuring import choices_of
from .options import BEZIER, HALF_LOG, INTENSE, MEASURED, SEARCHED_AT, UNIFORM
from .pictures import View, error_panel, panel
from .settings import FIT, FIXED, Settings

SHOWN = {
    "nickel": f"nickel@{FIT}",
    "GGX plastic, α 0.1": "Lambertian:albedo=.4/.1/.05 + GGX:alpha=.1,F0=.04",
    "blue-metallic-paint": f"blue-metallic-paint@{FIT}",
    "red-plastic": f"red-plastic@{FIT}",
    "green-fabric": f"green-fabric@{FIT}",
    "Ward, α 0.1": "Lambertian:albedo=.1/.2/.35 + WardDuer:alpha_x=.1,alpha_y=.1",
}
"""Materials of figure 4: sharp and matte fits, and models as in the paper."""

SCALE = 0.995
"""The quantile of the errors over the teapot, of the worst table, at which the error pictures' scale ends."""

BRUSHED = "GGX:alpha_x=.08,alpha_y=.35,F0=.95/.75/.5"
"""The anisotropic material of figure 5."""

LIGHTS: Mapping[str, Mapping[str, Any]] = {
    "one directional light": {"lights": Directional(theta=40, phi=-25, power=1.5)},
    "three point lights": {
        "lights": (
            Point((3.0, 3.5, 3.0), 10.0), Point((-4.0, 2.5, 2.5), (5.0, 6.0, 8.0)), Point((0.5, 5.0, -2.5), 8.0),
        )
    },
    "the studio": {"env": "studio"},
}  # fmt: skip

Errors = Mapping[str, Mapping[str, float]]
"""RMS by material and table."""


def isotropic(report: Report, settings: Settings) -> Errors:
    """Figure 4; returns the RMS of each table on each material."""
    view = View({"env": "studio", "size": settings.frame, "samples": settings.samples})
    rows: dict[str, list[Panel]] = {}
    found: dict[str, dict[str, float]] = {}
    shown: dict[str, dict[str, float]] = {}
    with Progress("figure 4", settings.shown, None) as bar:
        for name, text in list(SHOWN.items())[: settings.shown]:
            m = load(text)
            true = view.image(m)
            pictures = {way: view.of(table, m, true) for way, table in _tables(text, settings.resolution).items()}
            rows[name] = [*(panel(p, way) for way, p in pictures.items()), Panel(true.developed("clip"), "the model")]
            highest = max(p.quantile(SCALE) for p in pictures.values())
            rows[f"{name}, errors"] = [error_panel(p, way, highest) for way, p in pictures.items()]
            found[name] = {way: p.rms for way, p in pictures.items()}
            shown[name] = {way: p.display for way, p in pictures.items()}
            bar.step()
    n = settings.resolution
    report.figure(
        "figure-4",
        f"Figure 4. The teapot in the studio's light, tables of {n} × {n} × {2 * n} nodes and of as many over half "
        "vectors; RMS of the radiance, in parts of the RMS radiance. The reference is the model itself.",
        rows,
    )
    ways = list(next(iter(found.values())))
    report.table(
        "figure-4",
        "Figure 4 in numbers",
        ["material", *(Column(way, "RMS, %", ".3f", "ours") for way in ways),
         *(Column(f"{way}, sRGB", "RMS, levels of 255", ".3f", "ours") for way in (UNIFORM, INTENSE, HALF_LOG))],
        [
            [name, *(100 * errors[way] for way in ways),
             *(255 * shown[name][way] for way in (UNIFORM, INTENSE, HALF_LOG))]
            for name, errors in found.items()
        ],
        f"Over the teapot's pixels, {4 * settings.samples} rays to the environment a pixel, the same for all tables. "
        "32-bit floats, so that the parameterisation alone counts. Alphas of the least measured error are those of "
        f"{SEARCHED_AT} KB.",
    )  # fmt: skip
    return found


def _tables(text: str, n: int) -> dict[str, Table]:
    """The tables of figure 4 of one material."""
    m = load(text)
    layout = named_layout("normal", "bezier", shape_of("normal", n), "float32")
    _, alphas = choices_of(text)
    return {
        UNIFORM: Table.bake(m, "normal", "uniform", n, "float32"),
        INTENSE: bake_points(m, with_alpha(m, layout, alphas["intensity"])),
        BEZIER: bake_points(m, with_alpha(m, layout, FIXED)),
        MEASURED: bake_points(m, with_alpha(m, layout, alphas["measured"])),
        HALF_LOG: Table.bake(m, "half", "bezier", n, "float32"),
    }


def anisotropic(report: Report, settings: Settings) -> Errors:
    """Figure 5; returns the RMS of each table under each light."""
    m, n = load(BRUSHED), settings.azimuths
    tables = {
        f"{basis}, Bézier{whose}": Table.bake(m, basis, "bezier", n, "float32")
        for basis, whose in (("normal", ""), ("half", ", ln f (ours)"))
    }
    rows: dict[str, list[Panel]] = {}
    found: dict[str, dict[str, float]] = {}
    with Progress("figure 5", len(LIGHTS), None) as bar:
        for light, lights in LIGHTS.items():
            view = View({**lights, "size": settings.frame, "samples": settings.samples})
            true = view.image(m)
            pictures = {name: view.of(table, m, true) for name, table in tables.items()}
            rows[light] = [
                *(panel(p, name) for name, p in pictures.items()), Panel(true.developed("clip"), "the model"),
            ]  # fmt: skip
            found[light] = {name: p.rms for name, p in pictures.items()}
            bar.step()
    shapes = {name: " × ".join(map(str, table.layout.shape)) for name, table in tables.items()}
    report.figure(
        "figure-5",
        "Figure 5. Brushed metal (GGX, α 0.08 along and 0.35 across) in tables over four angles: "
        + ", ".join(f"{name} {shape}" for name, shape in shapes.items()) + " nodes.",
        rows,
    )  # fmt: skip
    report.table(
        "figure-5",
        "Figure 5 in numbers",
        ["light", *(Column(f"{name}, {shapes[name]}", "RMS, %", ".2f", "ours") for name in tables)],
        [[light, *(100 * error for error in errors.values())] for light, errors in found.items()],
        "RMS of the radiance over the teapot, in parts of the RMS radiance. The first axis is the azimuth, even.",
    )
    return found
