"""Table 1, and error against bytes for every way to make a shading map small."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....color import luminance
from ....render.progress import Progress
from ....representations.shading.compression import METHODS, MOST_BYTES, compressed, rms, rms_at
from ....representations.shading.fits import powers_table, searched
from ....representations.shading.slices import Slices
from ....representations.shading.stack import Stack
from ...charts import Curve, curves
from ...report import Cell, Column, Report
from .samples import Sample, geometric, slices_of
from .settings import SLICES

Floats = NDArray[np.floating[Any]]

PAPER_TABLE = {"suede": 0.064878, "plastic": 0.049011, "pressed wood": 0.046052, "stone": 0.040058}
"""Table 1; its "wood" is the pressed wood of figure 7."""

PAPER, NEWTON, JOINT, QUADRATIC, PRINCIPAL = ("power-brute-force", "power", "power-joint", "quadratic", "pca")
WORDS = {
    PAPER: "power k x^K, brute force (the paper's)", NEWTON: "the same by logarithms and Gauss-Newton",
    JOINT: "power, k and K together", QUADRATIC: "quadratic", PRINCIPAL: "principal components",
}  # fmt: skip

NATIVE, EVEN = "native", f"{SLICES} slices"
COUNTS = (2, 3, 4, 6, 8, 12, 16)
"""Numbers of slices, the black one included."""

Key = tuple[str, str, float]
"""Storage mode, method (or `PICTURES`), bytes a texel."""
PICTURES = "pictures"


@dataclass
class Losses:
    """RMS errors as shares of white, by material."""

    table: dict[str, dict[str, float]] = field(default_factory=lambda: defaultdict(dict))
    """As Table 1, by method: against the 8 slices, the black one, which every fit meets, counted."""
    shared: dict[str, float] = field(default_factory=dict)
    """The paper's fit with one K for all three channels."""
    at_photographs: dict[Key, dict[str, float]] = field(default_factory=lambda: defaultdict(dict))
    between: dict[Key, dict[str, float]] = field(default_factory=lambda: defaultdict(dict))
    by_slices: dict[int, dict[str, float]] = field(default_factory=lambda: defaultdict(dict))
    """Of uncompressed maps of so many slices, between the photographs."""

    def pair(self, mode: str, method: str, size: float = MOST_BYTES) -> tuple[float, float]:
        """Geometric means over materials: at the photographs, between them."""
        found = (errors[mode, method, size].values() for errors in (self.at_photographs, self.between))
        first, second = (0.0 if min(values) == 0 else geometric(values) for values in map(list, found))
        return first, second


def present(report: Report, samples: Sequence[Sample]) -> Losses:
    """Table 1, the table and the chart of error against bytes, and the number of slices."""
    losses = Losses()
    with Progress("compression", len(samples), None) as bar:
        for sample in samples:
            _measure(losses, sample)
            bar.step()
    _table_1(report, losses, [sample.name for sample in samples])
    _bytes(report, losses)
    _slices(report, losses)
    return losses


def _measure(losses: Losses, sample: Sample) -> None:
    even = slices_of(sample.even)
    black_counts = math.sqrt(len(even.nodes) / (len(even.nodes) + 1))
    for method in METHODS:
        losses.table[method][sample.name] = black_counts * rms(compressed(even, method=method), even)
    losses.shared[sample.name] = black_counts * shared_exponent(even) / sample.white
    for mode, slices in ((NATIVE, slices_of(sample.native)), (EVEN, even)):
        for key, stack in _forms(mode, slices):
            losses.at_photographs[key][sample.name] = rms_at(stack, sample.taken.images, sample.white)
            losses.between[key][sample.name] = rms_at(stack, sample.between.images, sample.white)
    for count in COUNTS:
        stack = slices_of(sample.taken.shading_map(mode="paper", slices=count))
        losses.by_slices[count][sample.name] = rms_at(stack, sample.between.images, sample.white)


def _forms(mode: str, slices: Slices) -> Iterable[tuple[Key, Stack]]:
    yield (mode, PICTURES, 3.0 * len(slices.nodes)), slices
    for size in range(MOST_BYTES, 0, -1):
        yield (mode, PRINCIPAL, size), compressed(slices, size)
    for method in METHODS:
        if method != PRINCIPAL:
            yield (mode, method, MOST_BYTES), compressed(slices, method=method)


def shared_exponent(slices: Slices) -> float:
    """RMS error of k x^K with a K for each texel, that of its luminance, and a k for each channel."""
    x = slices.nodes / slices.highest
    samples = slices.pictures.reshape(-1, len(x), 3)
    gray = np.ascontiguousarray(np.repeat(luminance(samples)[..., None], 3, -1), np.float32)
    out = np.empty((len(samples), 6), np.float32)
    searched(0, len(samples), gray, powers_table(x), False, out)
    squares = [
        np.mean((samples[:, -1] * share ** out[:, 3:] - samples[:, k]) ** 2, dtype=np.float64)
        for k, share in enumerate(x)
    ]
    return math.sqrt(np.mean(squares))


def _table_1(report: Report, losses: Losses, names: Sequence[str]) -> None:
    ours: list[Mapping[str, float]] = [*(losses.table[method] for method in WORDS), losses.shared]
    rows: list[list[Cell]] = [[name, PAPER_TABLE.get(name), *(errors[name] for errors in ours)] for name in names]
    for title, mean in (("mean", np.mean), ("geometric mean", lambda values: geometric(values))):
        measured = [float(mean(list(errors.values()))) for errors in ours]
        rows.append([title, float(mean(list(PAPER_TABLE.values()))), *measured])
    fit = losses.table[PAPER]
    low, high = min(PAPER_TABLE.values()), max(PAPER_TABLE.values())
    above = [name for name in names if fit[name] > high]
    below = [name for name in names if fit[name] < low]
    report.table(
        "table-1",
        "Table 1. RMS error of the compression",
        ["material", Column("RMS", "of white", ".3f", "paper"),
         *(Column(f"{words}, 6 bytes", "of white", ".4f", "ours") for words in WORDS.values()),
         Column("the paper's, one K for all channels", "of white", ".4f", "ours")],
        rows,
        f"Against the {SLICES} slices, the black one counted; white is the 99.5 % quantile of the brightest. The "
        "paper does not say what its unit is, and its materials are others.",
        f"The paper's fit: mean {np.mean(list(fit.values())):.3f}; {len(names) - len(above) - len(below)} of "
        f"{len(names)} materials inside {low:.3f} to {high:.3f}, {len(below)} below, {len(above)} above"
        + (f" ({', '.join(above)})." if above else "."),
    )  # fmt: skip


def _bytes(report: Report, losses: Losses) -> None:
    keys = list(losses.between)
    words = WORDS | {PICTURES: "pictures, uncompressed"}
    rows: list[list[Cell]] = [
        [mode, words[method], size, *losses.pair(mode, method, size)] for mode, method, size in keys
    ]
    best, peer = losses.pair(NATIVE, PRINCIPAL), losses.pair(EVEN, PAPER)
    report.table(
        "error-by-bytes",
        "RMS error against bytes a texel",
        ["storage", "method", Column("a texel", "bytes", "g", "ours"),
         Column("at the photographs", "of white", ".4f", "ours"),
         Column("between them", "of white", ".4f", "ours")],
        rows,
        "Geometric mean over materials; each picture looked up by its own average. Pictures count 8 bits a number "
        "(not rounded here, the others are).",
        f"In {MOST_BYTES} bytes principal components of the photographs have {best[0]:.4f} / {best[1]:.4f}, the "
        f"paper's fit of its {EVEN} {peer[0]:.4f} / {peer[1]:.4f}: {peer[1] / best[1]:.1f} times as much between.",
    )  # fmt: skip
    for name, where, which in (
        ("error-by-bytes", "between the photographs", 1), ("error-at-photographs", "at the photographs", 0),
    ):  # fmt: skip
        report.figure(
            name,
            f"RMS error {where}, geometric mean over materials, against bytes a texel.",
            curves(_series(losses, which), "bytes a texel", "RMS error, share of white",
                   {size: f"{size:g}" for size in (1, 2, 3, 4, 6, 21, 30)}, "log"),
        )  # fmt: skip


def _series(losses: Losses, which: int) -> dict[str, Curve]:
    """The curves of the charts; native fits of few parameters, hardly different from those of the slices, are in the
    table."""
    found: dict[str, Curve] = {}
    shown = [(NATIVE, PRINCIPAL), (EVEN, PRINCIPAL), (NATIVE, PICTURES), (EVEN, PICTURES), (EVEN, QUADRATIC),
             (EVEN, JOINT), (EVEN, PAPER)]  # fmt: skip
    for mode, method in shown:
        sizes = sorted(size for m, name, size in losses.between if (m, name) == (mode, method))
        found[f"{method}, {mode}"] = (sizes, [losses.pair(mode, method, size)[which] for size in sizes])
    return found


def _slices(report: Report, losses: Losses) -> None:
    report.table(
        "slices",
        "The number of slices",
        [Column("slices", "1", "d"), Column("RMS between the photographs", "of white", ".4f", "ours"),
         Column("worst material", "of white", ".4f", "ours")],
        [[count, geometric(found.values()), max(found.values())] for count, found in losses.by_slices.items()],
        f"The paper's storage, uncompressed, made of ten photographs. Native storage, which keeps these: "
        f"{losses.pair(NATIVE, PICTURES, _native_size(losses))[1]:.4f}.",
    )  # fmt: skip


def _native_size(losses: Losses) -> float:
    return max(size for mode, method, size in losses.between if (mode, method) == (NATIVE, PICTURES))
