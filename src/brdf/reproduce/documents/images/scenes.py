"""Figures 5 and 6, and Table I: meshes in directional and point light, and what a light costs."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ....loading import load
from ....metrics import psnr_of
from ....reflectance import Reflectance
from ....render import Directional, Image, Point, render
from ....render.mesh import Mesh
from ....render.mesh import load as load_mesh
from ....render.progress import Progress
from ....representations.baking.slice_stack import SliceStack
from ....representations.spheres.sphere_images import SphereImages
from ...report import Column, Panel, Report
from .settings import FIT, METAL, PLASTIC, Settings

MATERIALS = ("yellow-plastic", "red-specular-plastic", "orange-paint", "blue-acrylic", "alum-bronze")
GOLD = "gold-metallic-paint"

SUN = Directional(theta=50, phi=55, power=1.2)
LAMPS = (
    Point((3.0, 3.5, 3.0), 14.0),
    Point((-4.0, 2.5, 2.5), (7.0, 8.0, 10.0)),
    Point((0.5, 5.0, -2.5), 9.0),
    Point((-1.0, 0.6, 4.5), (6.0, 4.5, 3.0)),
)

PAPER_FPS = {"bunny": (325, 324, 324, 323), "teapot": (388, 384, 383, 380)}
"""Table I of the paper, on an ATI Mobility Radeon HD 4650."""

LIGHTS = (1, 2, 4, 8)
MESHES = {"teapot": "teapot", "sphere": "bunny"}
"""The shipped meshes that are timed, and the paper's beside which they stand."""

PAPER, OURS, SEPARATED = "Eq. 4", "monotone k (ours)", "diffuse light separated (ours)"


def materials(report: Report, settings: Settings) -> None:
    """Figure 5."""
    rows: dict[str, list[Panel]] = {"rendered from the fit itself": []}
    rows |= {f"four pictures, {way}": [] for way in (PAPER, OURS, SEPARATED)}
    with Progress("figure 5", len(MATERIALS), None) as bar:
        for name in MATERIALS:
            _three(rows, load(f"{name}@{FIT}"), name, PLASTIC, settings, {"lights": SUN})
            bar.step()
    report.figure("figure-5", f"Figure 5. Five materials on the teapot, in {_said(SUN)}. PSNR: over the teapot.", rows)


def gold(report: Report, settings: Settings) -> None:
    """Figure 6."""
    rows: dict[str, list[Panel]] = {"the fit": [], PAPER: [], OURS: [], SEPARATED: []}
    _three(rows, load(f"{GOLD}@{FIT}"), GOLD, METAL, settings, {"lights": LAMPS})
    captions = ("rendered from the fit itself", *(f"six pictures, {way}" for way in (PAPER, OURS, SEPARATED)))
    panels = [
        Panel(panel.pixels, f"{caption}{panel.label.removeprefix(GOLD)}")
        for caption, (panel,) in zip(captions, rows.values(), strict=True)
    ]
    report.figure("figure-6", f"Figure 6. {GOLD} under four point lights.", {"": panels})


def _three(
    rows: Mapping[str, list[Panel]], m: Reflectance, name: str, angles: Sequence[float], settings: Settings,
    scene: Mapping[str, Any],
) -> None:  # fmt: skip
    """The truth, the paper's blend and ours, appended to a row each."""
    truth: Image | None = None
    for row, made in zip(rows.values(), (m, *_blends(m, angles, settings)), strict=True):
        image = render(made, size=settings.frame, background="transparent", progress=False, **scene)
        truth = truth or image
        assert truth.alpha is not None
        on = truth.alpha > 0
        label = name if truth is image else f"{name}, {psnr_of(truth.pixels[on], image.pixels[on]):.1f} dB"
        row.append(Panel(image.developed("clip"), label))


def _blends(m: Reflectance, angles: Sequence[float], settings: Settings) -> list[SphereImages]:
    """The paper's and ours."""
    paper = SphereImages.bake(m, angles, settings.largest, dilate=False).with_blend("paper", guard=False, mask=False)
    separated = SphereImages.bake(m, angles, settings.largest)
    return [paper, separated.with_blend("monotone"), separated]


def _said(light: Directional) -> str:
    return f"one directional light, {light.theta:g}° from above and {light.phi:g}° to the right"


def frames(report: Report, settings: Settings) -> Mapping[str, Sequence[float]]:
    """Table I; returns our milliseconds of the paper's way by mesh, for 1, 2, 4 and 8 lights."""
    m = load(f"{MATERIALS[0]}@{FIT}")
    made: list[Reflectance] = [*_blends(m, PLASTIC, settings), SliceStack.bake(m, method="points"), m]
    ways = dict(zip((PAPER, OURS, SEPARATED, "16 KB slice stack", "the fit"), made, strict=True))
    shapes = {mesh: load_mesh(mesh) for mesh in MESHES}
    with Progress("table I", len(ways) * len(MESHES), None) as bar:
        times = {
            (mesh, name): _timed(way, shapes[mesh], settings, bar) for mesh in MESHES for name, way in ways.items()
        }
    width, height = settings.frame
    how = (
        f"{width} x {height} pixels, one ray a pixel, no shadows, the renderer on the processor, the fastest of "
        f"{settings.repeats} frames; {m.name}, {len(PLASTIC)} pictures of {settings.largest}². The paper's are from an "
        "ATI Mobility Radeon HD 4650, resolution not given; its bunny is not shipped, the sphere stands in for it."
    )
    report.table(
        "table-1",
        "Table I. Frames a second by the number of lights",
        ["mesh", Column("lights", "1", "d"), Column(PAPER, "fps", "d", "paper"),
         *(Column(way, "fps", ".1f", "ours") for way in ways)],
        [
            [_mesh(mesh), count, PAPER_FPS[peer][i], *(1000 / times[mesh, way][i] for way in ways)]
            for mesh, peer in MESHES.items()
            for i, count in enumerate(LIGHTS)
        ],
        how,
    )  # fmt: skip
    slopes = {key: slope(values) for key, values in times.items()}
    peers = {mesh: [1000 / fps for fps in PAPER_FPS[peer]] for mesh, peer in MESHES.items()}
    dearest = max(ways, key=lambda way: slopes["teapot", way])
    report.table(
        "light-cost",
        "What a further light costs",
        ["mesh", Column("a light", "ms", ".4f", "paper"),
         *(Column(f"{way}, a light", "ms", ".2f", "ours") for way in ways),
         Column("8 lights over 1", "1", ".2f", "paper"), Column(f"8 lights over 1, {PAPER}", "1", ".2f", "ours")],
        [
            [_mesh(mesh), slope(peers[mesh]), *(slopes[mesh, way] for way in ways), peers[mesh][-1] / peers[mesh][0],
             times[mesh, PAPER][-1] / times[mesh, PAPER][0]]
            for mesh in MESHES
        ],
        "The slope of the straight line through the times of 1, 2, 4 and 8 lights.",
        f"On the teapot a light costs {slopes['teapot', PAPER]:.2f} ms with {PAPER}, "
        f"{slopes['teapot', 'the fit']:.2f} ms with the fitted model itself; the dearest is {dearest}.",
    )  # fmt: skip
    return {mesh: times[mesh, PAPER] for mesh in MESHES}


def slope(milliseconds: Sequence[float]) -> float:
    """Milliseconds a light, by least squares."""
    return float(np.polyfit(LIGHTS, milliseconds, 1)[0])


def _mesh(mesh: str) -> str:
    return mesh if MESHES[mesh] == mesh else f"{mesh} (paper: {MESHES[mesh]})"


def _timed(m: Reflectance, mesh: Mesh, settings: Settings, bar: Progress) -> list[float]:
    """Milliseconds a frame for each number of lights."""
    times = []
    for count in LIGHTS:
        lights = [Directional(30 + 20 * (i % 3), 360 * i / count + 20, 1 / math.sqrt(count)) for i in range(count)]
        fastest = math.inf
        for _ in range(settings.repeats + 1):  # the first one compiles and loads
            start = time.perf_counter()
            render(m, mesh, lights=lights, size=settings.frame, supersampling=1, shadows=False, progress=False)
            fastest = min(fastest, time.perf_counter() - start)
        times.append(1000 * fastest)
    bar.step()
    return times
