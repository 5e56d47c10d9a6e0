"""Error against bytes: every option on the shipped materials, on measured files, and the table that is searched for."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

from ....loading import load
from ....metrics.importance import Errors, ErrorsAgainst, importance_pairs
from ....render.progress import Progress
from ....representations.tables.table import Table
from ....threads import map_threads
from ...charts import curves
from ...report import Cell, Column, Report
from .measuring import SEED, Measured, choices_of, errors_of
from .options import BEZIER, HALF_LOG, IDENTITY, INTENSE, MEASURED, SEARCHED_AT, STACK, UNIFORM, Alphas
from .settings import FIT, Settings

CHARTED = (IDENTITY, UNIFORM, BEZIER, INTENSE, HALF_LOG, STACK)
"""As many as colours tell apart."""

PAPER = (IDENTITY, UNIFORM, BEZIER, INTENSE, MEASURED)

DATA, MEASURED_FILES = "BRDF_DATA", "rgl/*.bsdf"
"""The environment variable that names a folder of measured files, which are not shipped, and those in it."""

ERRORS = ("relative RMS of f cos θi", "display RMS")

HOW = (
    "Relative: RMS of f cos θi in parts of its RMS. Display: RMS of min(π f cos θi, 1)^(1/2.2), full scale 1000. Both "
    "over pairs as an orthographic picture of a sphere has them, other ones than alphas and layouts are chosen at. "
    f"Alphas of the least measured error are those of {SEARCHED_AT} KB."
)


def present(report: Report, settings: Settings, found: Measured) -> None:
    """The sections on memory."""
    report.section(
        "Error against memory",
        f"At equal bytes, over the {len(found.names)} shipped materials (Bagher's fits). The paper's tables have 4 "
        "bytes a node: RGB with a shared exponent.",
    )
    for error, name in enumerate(ERRORS):
        series = {o: (found.budgets, [found.median(o, k, error) for k in found.budgets]) for o in CHARTED}
        report.figure(
            f"error-by-bytes-{error + 1}",
            f"Median {name} against memory; the other options are in the table.",
            curves(series, "memory [KB]", name, {k: f"{k:g}" for k in found.budgets}, x_scale="log", y_scale="log"),
        )
    _statistics(report, "error-by-bytes", "Error against bytes: the shipped materials", found)
    _searched(report, settings, found)
    _measured_files(report, settings)
    _materials(report, found)


def _statistics(report: Report, name: str, caption: str, found: Measured) -> None:
    columns = [
        Column(f"{kind}, {kilobytes:g} KB", unit, ".3g", "ours")
        for kind, unit in (("relative", "%"), ("display", "‰"))
        for kilobytes in found.budgets
    ]
    kinds = [(k, error, scale) for error, scale in ((0, 100), (1, 1000)) for k in found.budgets]
    rows: list[list[Cell]] = [
        [statistic, option, *(scale * of(option, k, error) for k, error, scale in kinds)]
        for statistic, of in (("median", found.median), ("worst", found.worst))
        for option in found.options
    ]
    verdict = " ".join(_best(found, error) for error in (0, 1))
    report.table(name, caption, ["statistic", "table", *columns], rows, HOW, verdict)


def _best(found: Measured, error: int) -> str:
    """Which option has the least median of an error at the largest size, the paper's best and ours beside it."""
    largest = found.budgets[-1]
    best, paper = (min(options, key=lambda o: found.median(o, largest, error)) for options in (found.options, PAPER))
    scale, unit = ((100, "%"), (1000, "‰"))[error]

    def told(option: str) -> str:
        return f"{option} {scale * found.median(option, largest, error):.3g} {unit}"

    reached = (k for k in found.budgets if found.median(HALF_LOG, k, error) <= found.median(paper, largest, error))
    smallest = next(reached, None)
    enough = "reaches it at no size measured" if smallest is None else f"reaches it from {smallest:g} KB on"
    return (
        f"Median {ERRORS[error]} at {largest:g} KB: the least is {told(best)}, the paper's least {told(paper)}; "
        f"{told(HALF_LOG)} {enough}."
    )


def _searched(report: Report, settings: Settings, found: Measured) -> None:
    """The search at one size, beside the paper's best for each material by the same error."""
    if not settings.searched:
        return
    names = found.names[:: max(1, len(found.names) // max(1, settings.searched))][: settings.searched]
    rows: list[list[Cell]] = []
    with Progress("tables searched for", len(names), None) as bar:

        def one(name: str) -> tuple[Table, Errors]:
            m = load(f"{name}@{FIT}")
            table = Table.bake(m, budget=SEARCHED_AT * 1024)
            bar.step()
            return table, ErrorsAgainst(m, importance_pairs(settings.pairs, SEED))(table)

        for name, (table, error) in zip(names, map_threads(one, names), strict=True):
            best = _papers_best(found, name)
            size = " × ".join(map(str, table.layout.shape))
            kind = f"{', '.join(table.layout.basis.axes)}: {size}, {table.layout.storage}, {table.layout.filter}"
            rows.append(
                [name, kind, 100 * error[0], 100 * best[0], best[0] / error[0], 1000 * error[1], 1000 * best[1],
                 best[1] / error[1]]
            )  # fmt: skip
    gains = [np.median([float(row[k]) for row in rows]) for k in (4, 7)]  # type: ignore[arg-type]
    least = [min(float(row[k]) for row in rows) for k in (4, 7)]  # type: ignore[arg-type]
    report.table(
        "searched",
        f"Table.bake(budget={SEARCHED_AT * 1024}) against the paper's best for each material and error",
        ["material", "found", Column("relative", "%", ".3g", "ours"), Column("relative, paper's best", "%", ".3g"),
         Column("ratio", "1", ".1f"), Column("display", "‰", ".3g", "ours"),
         Column("display, paper's best", "‰", ".3g"), Column("ratio", "1", ".1f")],
        rows,
        f"{len(rows)} of the materials, {SEARCHED_AT} KB. {HOW}",
        f"Over these {len(rows)} the median ratio is {gains[0]:.1f} in the relative error (least {least[0]:.1f}) and "
        f"{gains[1]:.1f} in the display's (least {least[1]:.1f}).",
    )  # fmt: skip


def _papers_best(found: Measured, name: str) -> Errors:
    """The least of each error among the paper's tables, of one material at `SEARCHED_AT`."""
    papers = [found.errors[option, SEARCHED_AT][name] for option in PAPER]
    return Errors(min(e[0] for e in papers), min(e[1] for e in papers))


def _measured_files(report: Report, settings: Settings) -> None:
    """The same options on measured files, where there are any."""
    folder = os.environ.get(DATA)
    files = sorted(Path(folder).glob(MEASURED_FILES)) if folder else []
    if not files:
        report.section(
            "Measured files",
            f"None were measured in this run: {DATA} names no folder with {MEASURED_FILES} (Dupuy's and Jakob's "
            "database). Their data is not shipped.",
        )
        return
    files = files[: settings.files]
    report.section(
        "Measured files",
        f"The same options on {len(files)} files of Dupuy's and Jakob's database, which are not shipped.",
    )
    found = Measured()
    with Progress("errors of measured files", len(files), None) as bar:
        for file in files:
            found.intensities[file.stem], alphas = choices_of(str(file))
            for key, error in errors_of(load(file), settings.budgets, alphas, settings.pairs).items():
                found.errors[key][file.stem] = error
            bar.step()
    _statistics(report, "measured-files", "Error against bytes: measured files", found)


def _materials(report: Report, found: Measured) -> None:
    """Every material at one size."""
    report.section("Material by material")
    shown = (IDENTITY, UNIFORM, BEZIER, INTENSE, MEASURED, HALF_LOG, STACK)
    errors = {option: found.errors[option, SEARCHED_AT] for option in shown}
    report.table(
        "materials",
        f"Relative error of the shipped materials, {SEARCHED_AT} KB",
        ["material", *(Column(option, "%", ".3g", "ours") for option in shown), "α of θi, θo, φ by measured error"],
        [
            [name, *(100 * errors[option][name][0] for option in shown), _words(found.alphas[name]["measured"])]
            for name in found.names
        ],
    )


def _words(alphas: Alphas) -> str:
    return ", ".join(f"{alpha:.2f}" for alpha in alphas)
