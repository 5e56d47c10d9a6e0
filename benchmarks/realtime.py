"""Frame times of the renderer on graphics cards: representations by number of lights, on two meshes.

Run with `uv run --all-extras python benchmarks/realtime.py` (a few minutes on a software driver; `--help` for more).
One ray a pixel, no shadows, as the first document measures. Times are those of whole frames: vertices, shading, sum. On
a software driver they are the processor's, of all cores together, which other work on the machine changes little.
Everything is measured in turns in one run, so that ratios hold.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Callable
from typing import Any

import numpy as np

import brdf
from brdf.models import GGX, Lambertian
from brdf.reflectance import Reflectance
from brdf.render import Camera, Directional
from brdf.render import mesh as meshes
from brdf.render.gl import Renderer, card, stages_of
from brdf.render.task import checked

LIGHTS = (1, 2, 4, 8)
PUBLISHED = {"bunny": (325, 324, 324, 323), "teapot": (388, 384, 383, 380)}
"""Frames a second with 1, 2, 4 and 8 lights, pictures of spheres, Mobility Radeon HD 4650 [Mihalik2015, table I]."""

PLASTIC = Lambertian(albedo=(0.1, 0.2, 0.3)) + GGX(alpha=0.2)


def shading_map() -> brdf.ShadingMap:
    """256 x 256 texels of a simulated sample from ten photographs."""
    angles = np.array([0, 10, 20, 30, 40, 50, 60, 70, 80, 87])
    rough = np.random.default_rng(1).random((256, 256, 1)).astype(np.float32)
    photographs = [(0.2 + 0.8 * rough) * np.cos(np.radians(angle)) * np.ones(3, np.float32) / np.pi for angle in angles]
    return brdf.ShadingMap.from_images(photographs, angles, PLASTIC)


MATERIALS: dict[str, Callable[[], Reflectance]] = {
    "GGX": lambda: GGX(alpha=0.2),
    "GGX + Lambertian": lambda: PLASTIC,
    "slice stack, 16 KB": lambda: brdf.SliceStack.bake(PLASTIC, method="points"),
    "sphere images, 4 x 256²": lambda: brdf.SphereImages.bake(PLASTIC, size=256),
    "the same, paper's blend": lambda: brdf.SphereImages.bake(PLASTIC, size=256, blend="paper"),
    "the same, two of them": lambda: brdf.SphereImages.bake(PLASTIC, size=256, blend="paper").beside(40.0),
    "table 64 x 64 x 128, linear": lambda: brdf.Table.bake(PLASTIC, shape=(64, 64, 128)),
    "table, cubic": lambda: brdf.Table.bake(PLASTIC, shape=(64, 64, 128), filter="b-spline"),
    "shading map": shading_map,
    "shading map, 6 bytes": lambda: shading_map().compress(6),
}


def frame(renderer: Renderer) -> None:
    for _ in renderer.draw_sample((0.5, 0.5)):
        pass


def measured(
    opened: Any, mesh: str, materials: dict[str, Reflectance], size: tuple[int, int], lights: tuple[int, ...],
    seconds: float, shadows: bool, filtered: bool,
) -> dict[str, list[float]]:  # fmt: skip
    """Milliseconds a frame, median, for each material and number of lights."""
    clock = time.process_time if opened.is_software else time.perf_counter
    shape = meshes.load(mesh)
    camera = Camera.framing(shape, aspect=size[0] / size[1], orthographic=True)
    around = [Directional(40 + 3 * n, 45 * n, 1 / 8) for n in range(max(lights))]
    renderers = {}
    for name, m in materials.items():
        for count in lights:
            task = checked([m], shape, around[:count], None, camera, size, 1, 1, shadows, "gradient", 0)
            renderers[name, count] = Renderer(opened, task, stages_of(task), filtered)
    times: dict[Any, list[float]] = {key: [] for key in renderers}
    for key, renderer in renderers.items():  # the first frame compiles
        frame(renderer)
        opened.finish()
        start = clock()
        frame(renderer)
        opened.finish()
        times[key] = [clock() - start]
    at_once = {key: max(1, int(0.02 / first[0])) for key, first in times.items()}
    end = time.monotonic() + seconds
    while time.monotonic() < end or len(times["GGX", lights[0]]) < 4:
        for key, renderer in renderers.items():
            start = clock()
            for _ in range(at_once[key]):
                frame(renderer)
            opened.finish()
            times[key].append((clock() - start) / at_once[key])
    return {name: [1e3 * float(np.median(times[name, count][1:])) for count in lights] for name in materials}


def printed(mesh: str, found: dict[str, list[float]], lights: tuple[int, ...]) -> None:
    """A table: milliseconds, frames a second, ratio to GGX, and what the last light costs."""
    last = lights[-1]
    print(f"\n{mesh}: ms a frame with {', '.join(map(str, lights))} lights | frames a second with {last} | "
          f"of GGX with {last} | ms a light | {last} lights of 1")  # fmt: skip
    for name, times in found.items():
        a_light = (times[-1] - times[0]) / max(1, last - lights[0])
        row = "  ".join(f"{t:8.3f}" for t in times)
        print(f"  {name:28}{row}  {1e3 / times[-1]:8.1f}  {times[-1] / found['GGX'][-1]:6.2f}  {a_light:8.4f}  "
              f"{times[-1] / times[0]:6.3f}")  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--size", default="1920x1080", help="pixels, WIDTHxHEIGHT [1920x1080]")
    parser.add_argument("--mesh", action="append", help="name or file; repeatable [teapot, sphere]")
    parser.add_argument("--material", action="append", choices=list(MATERIALS), help="beside GGX; repeatable [all]")
    parser.add_argument("--seconds", type=float, default=20.0, help="a mesh [20]")
    parser.add_argument("--shadows", action="store_true", help="with exact shadows")
    parser.add_argument("--hardware-filter", action="store_true", help="linear lookups are the driver's")
    parser.add_argument("--json", action="store_true", help="print JSON")
    options = parser.parse_args()
    width, height = map(int, options.size.split("x"))
    chosen = ["GGX", *(options.material or [name for name in MATERIALS if name != "GGX"])]
    materials = {name: MATERIALS[name]() for name in chosen}
    results = {}
    for mesh in options.mesh or ["teapot", "sphere"]:
        with card() as opened:
            name = opened.name
            results[mesh] = measured(
                opened, mesh, materials, (width, height), LIGHTS, options.seconds, options.shadows,
                options.hardware_filter,
            )  # fmt: skip
    if options.json:
        print(json.dumps({"driver": name, "size": [width, height], "lights": LIGHTS, "milliseconds": results}))
        return
    software = ", processor time of all cores" if opened.is_software else ""
    print(f"{name}, {width} x {height}{software}")
    for mesh, found in results.items():
        printed(mesh, found, LIGHTS)
    print("\nThe paper, pictures of spheres, frames a second with 1, 2, 4, 8 lights; 8 lights of 1:")
    for mesh, rates in PUBLISHED.items():
        print(f"  {mesh:8}{rates}  {rates[0] / rates[-1]:.3f}")


if __name__ == "__main__":
    main()
