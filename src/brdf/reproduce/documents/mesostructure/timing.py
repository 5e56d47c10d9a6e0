"""What making, fitting and looking up cost."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ....capture import flat
from ....color import srgb_encode
from ....geometry.directions import from_spherical
from ....render.progress import Progress
from ....representations.shading.compression import METHODS
from ....representations.shading.shading_map import ShadingMap
from ...report import Cell, Column, Report
from .compression import WORDS
from .samples import Sample, named, slices_of
from .settings import SHOWN, SLICES, Settings

Floats = NDArray[np.floating[Any]]

PAPER_SECONDS = {"fit": 40.0, "slices": 5.0}
"""The paper's, on a Pentium 4 at 1.7 GHz."""


class Cost(NamedTuple):
    """Seconds: by the clock, and of all cores together, which other work on the machine changes less."""

    wall: float
    cpu: float

    def said(self) -> str:
        return f"{self.wall:.3f} s ({self.cpu:.3f} s of processor time)"


@dataclass(frozen=True)
class Times:
    """Of each fit, of the resampling and of the capture; nanoseconds a lookup, by form."""

    fits: dict[str, Cost]
    slices: Cost
    capture: Cost
    lookups: dict[str, float]


def present(report: Report, settings: Settings, samples: Sequence[Sample]) -> Times:
    """Two tables, and their numbers."""
    sample = named(samples, SHOWN)
    photographs = [_tiled(image, settings.timed) for image in sample.taken.images]
    elevations = sample.taken.elevations
    with Progress("timing", len(METHODS) + 3, None) as bar:

        def even() -> ShadingMap:
            return ShadingMap.from_images(photographs, elevations, mode="paper", slices=SLICES)

        h = even()
        resampling = fastest(even, settings.repeats)
        bar.step()
        fits = {}
        for method, fit in METHODS.items():
            fits[method] = fastest(lambda fit=fit: fit(slices_of(h)), settings.repeats)  # type: ignore[misc]
            bar.step()
        capture = _captured(sample, settings)
        bar.step()
        lookups = _lookups(sample, settings)
        bar.step()
    times = Times(fits, resampling, capture, lookups)
    _table(report, settings, times, h.stack.shape)
    return times


def fastest(work: Callable[[], Any], repeats: int) -> Cost:
    """The fastest of `repeats` runs, after one that compiles and loads."""
    work()
    runs = [cost(work) for _ in range(repeats)]
    return Cost(min(run.wall for run in runs), min(run.cpu for run in runs))


def cost(work: Callable[[], Any]) -> Cost:
    """Of one run."""
    wall, cpu = time.perf_counter(), time.process_time()
    work()
    return Cost(time.perf_counter() - wall, time.process_time() - cpu)


def _captured(sample: Sample, settings: Settings) -> Cost:
    """From ten photographs on the disk to a compressed material on the disk."""
    from PIL import Image

    with tempfile.TemporaryDirectory(prefix="brdf-") as name:
        folder = Path(name) / "photographs"
        folder.mkdir()
        for k, image in enumerate(sample.taken.images):
            whole = _tiled(image / sample.white, settings.photograph)
            shown = np.asarray(srgb_encode(whole.clip(0, 1)) * 255 + 0.5, np.uint8)
            Image.fromarray(shown).save(folder / f"{k:02}.png", compress_level=1)
        (folder / "angles.txt").write_text("".join(f"{angle:g}\n" for angle in sample.taken.elevations), "utf-8")

        def captured() -> None:
            taken = flat(folder, crop=settings.photograph, size=settings.photograph)
            taken.shading_map().compress().save(Path(name) / "material.safetensors")

        return cost(captured)


def _tiled(image: Floats, size: int) -> Floats:
    """The picture, repeated, of `size` pixels across."""
    copies = -(-size // len(image))
    return np.ascontiguousarray(np.tile(image, (copies, copies, 1))[:size, :size])


def _lookups(sample: Sample, settings: Settings) -> dict[str, float]:
    """Nanoseconds a pair of directions with its place, the BRDF included, row by row over the surface."""
    even = sample.even
    forms = {
        f"{SLICES} slices": even, "the paper's power fit": even.compress(method="power-brute-force"),
        "principal components, 6 bytes": even.compress(), "principal components, 3 bytes": even.compress(3),
    }  # fmt: skip
    rng, count = np.random.default_rng(0), settings.timed**2
    wi, wo = (from_spherical(rng.uniform(0, 1.5, count), rng.uniform(0, 6, count)).astype(np.float32) for _ in range(2))
    axis = (np.arange(settings.timed, dtype=np.float32) + np.float32(0.3)) / settings.timed
    uv = np.stack(np.meshgrid(axis, axis), -1).reshape(-1, 2)
    lit = {name: sample.under_phong(form) for name, form in forms.items()}
    return {
        name: fastest(lambda m=m: m(wi, wo, uv), settings.repeats).wall * 1e9 / count  # type: ignore[misc]
        for name, m in lit.items()
    }


def _table(report: Report, settings: Settings, times: Times, shape: tuple[int, int]) -> None:
    ordered = {method: times.fits[method] for method in WORDS}
    rows: list[list[Cell]] = [
        [f"fit: {WORDS[method]}", PAPER_SECONDS["fit"] if method == "power-brute-force" else None, *seconds]
        for method, seconds in ordered.items()
    ]
    rows.append([f"ten photographs to {SLICES} slices", PAPER_SECONDS["slices"], *times.slices])
    rows.append([f"ten PNG files of {settings.photograph}² to a compressed map on the disk", None, *times.capture])
    report.table(
        "times",
        "What it takes",
        [
            "work",
            Column("time", "s", "g", "paper"),
            Column("time", "s", ".3f", "ours"),
            Column("processor time", "s", ".3f", "ours"),
        ],
        rows,
        f"{shape[0]} x {shape[1]} texels, {SLICES} slices, 3 channels, the fastest of {settings.repeats} (the last "
        "row: one run). The paper's, for 512 x 512, on a Pentium 4 at 1.7 GHz.",
    )
    report.table(
        "lookups",
        "A lookup",
        ["stored as", Column("time", "ns", ".0f", "ours")],
        [[name, nanoseconds] for name, nanoseconds in times.lookups.items()],
        "Single precision, directions at random, place after place over the surface, the BRDF (modified Phong) "
        "included, on all cores.",
    )
