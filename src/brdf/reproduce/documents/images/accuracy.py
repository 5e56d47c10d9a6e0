"""Our tables: error against the number of pictures, against bytes, and material by material."""

from __future__ import annotations

from ....loading import load
from ....reflectance import Reflectance
from ...charts import Curve, curves
from ...report import Cell, Column, Report
from .candidates import (
    LITERAL,
    MONOTONE,
    REPAIRED,
    SEPARATED,
    STACK,
    STACK_AT_NODES,
    STORAGE,
    TABLE_STORAGE,
    TABLES,
    by_pictures,
    table_shape,
)
from .measuring import CAP, STATISTICS, Errors, measure
from .settings import METAL, PLASTIC, Settings

PLASTICS = "Lambertian:albedo=.5 + GGX:alpha={},F0=.04"
ANALYTIC = {
    "Lambert, albedo 0.8": "Lambertian:albedo=.8",
    "Oren-Nayar, σ 0.5": "OrenNayar:albedo=.8,sigma=.5",
    "Blinn, n 64": "Lambertian:albedo=.3 + BlinnPhong:ks=.3,n=64",
    **{f"plastic, α {alpha}": PLASTICS.format(alpha) for alpha in (0.05, 0.1, 0.2, 0.4)},
    **{f"gold, α {alpha}": f"GGX:alpha={alpha},F0=1/.78/.34" for alpha in (0.1, 0.3, 0.6)},
    "aluminium, α 0.2": "Microfacet:alpha=.2,fresnel=conductor,eta=1.37/.97/.62,k=7.6/6.6/5.4",
}
"""Models whose errors are measured beside the shipped materials'."""


CHARTED = [
    *(f"4 pictures, {method}" for method in (LITERAL["paper"], MONOTONE, SEPARATED)),
    TABLES["uniform"], TABLES["bezier"], STACK_AT_NODES, STACK,
]  # fmt: skip
"""The methods whose curves are drawn against memory: as many as colours tell apart."""


def present(report: Report, settings: Settings, errors: Errors) -> None:
    """The sections on accuracy."""
    count = len(next(iter(errors.psnr.values())))
    protocol = (
        f"PSNR of sRGB over the lit pixels of a sphere {settings.sphere} pixels across, light at 0, 5, … 175°, of the "
        f"{count} shipped materials (Bagher's fits). The mean counts exact agreement as {CAP:g} dB."
    )
    report.section("Error against the number of pictures", protocol)
    _pictures(report, settings, errors)
    report.section(
        "Error against memory",
        f"At equal bytes: the paper's four and six pictures in every blend ({STORAGE}), tables over half and "
        f"difference angle (ln f, {TABLE_STORAGE}), and slice stacks. {protocol}",
    )
    _bytes(report, settings, errors)
    report.section("Material by material")
    _models(report, settings)
    _materials(report, errors)


def _pictures(report: Report, settings: Settings, errors: Errors) -> None:
    keys = errors.keys("pictures")
    methods = errors.methods("pictures")
    report.figure(
        "error-by-pictures",
        "Mean PSNR against the number of pictures, at i 180/N degrees.",
        curves(_means(errors, "pictures", methods), "number of pictures N", "mean PSNR [dB]",
               {key: f"{key:g}" for key in keys}, x_scale="log"),
    )  # fmt: skip
    paper, most = LITERAL["paper"], keys[-1]

    def gain(method: str) -> float:
        return errors.mean("pictures", method, most) - errors.mean("pictures", method, keys[0])

    def ahead(reference: str, method: str) -> float:
        return errors.mean("pictures", method, 4) - errors.mean("pictures", reference, 4)

    _statistics(
        report, errors, "pictures", "error-by-pictures", "PSNR against the number of pictures",
        [Column(f"{key:g}", "dB", ".1f", "ours") for key in keys],
        f"Pictures of {settings.texture}² texels, at i 180/N degrees. The first three as published: normals shortened "
        "by 0.995, black ground. The others: the limb repeated around the disc.",
        f"From {keys[0]:g} to {most:g} pictures {paper} gains {gain(paper):.1f} dB, {MONOTONE} {gain(MONOTONE):.1f} "
        f"dB, {SEPARATED} {gain(SEPARATED):.1f} dB. With 4 pictures {MONOTONE} is {ahead(paper, MONOTONE):+.1f} dB and "
        f"{SEPARATED} {ahead(paper, SEPARATED):+.1f} dB from {paper}; {REPAIRED} is {ahead(paper, REPAIRED):+.1f} dB "
        "from it.",
    )  # fmt: skip


def _bytes(report: Report, settings: Settings, errors: Errors) -> None:
    keys = errors.keys("bytes")
    methods = errors.methods("bytes")
    report.figure(
        "error-by-bytes",
        "Mean PSNR against memory; the other blends are in the table.",
        curves(_means(errors, "bytes", CHARTED), "memory", "mean PSNR [dB]",
               {key: _kilobytes(key) for key in keys}, x_scale="log"),
    )  # fmt: skip
    last = keys[-1]
    pictures = max((method for method in methods if "pictures" in method), key=lambda x: errors.mean("bytes", x, last))
    equal = equal_table(errors, errors.mean("bytes", pictures, last))
    shapes = ", ".join(f"{_kilobytes(key)}: {' × '.join(map(str, table_shape(int(key))))}" for key in keys)
    _statistics(
        report, errors, "bytes", "error-by-bytes", "PSNR against memory",
        [Column(_kilobytes(key), "dB", ".1f", "ours") for key in keys],
        f"Sizes rounded down to fit. Tables have θh × θd × φd nodes ({shapes}). Slice stacks by least squares choose "
        "their split for each material.",
        f"The best pictures at {_kilobytes(last)} are {pictures} with {errors.mean('bytes', pictures, last):.1f} dB; "
        + (f"{equal[0]} has as much in {_kilobytes(equal[1])}." if equal else "no table measured has as much."),
    )  # fmt: skip
    sizes = errors.keys("size")
    report.table(
        "error-by-texels",
        "PSNR against the size of the four pictures",
        ["blend", *(Column(f"{key:g}²", "dB", ".2f", "ours") for key in sizes)],
        [[method, *(errors.mean("size", method, key) for key in sizes)] for method in errors.methods("size")],
        "Mean over the materials.",
    )


def equal_table(errors: Errors, decibels: float) -> tuple[str, float] | None:
    """The smallest of the plain tables whose mean PSNR is at least so high, and its KB."""
    found = [
        (key, method)
        for method in TABLES.values()
        for key in errors.keys("bytes")
        if errors.mean("bytes", method, key) >= decibels
    ]
    if not found:
        return None
    key, method = min(found, key=lambda pair: (pair[0], -errors.mean("bytes", pair[1], pair[0])))
    return method, key


def _means(errors: Errors, sweep: str, methods: list[str]) -> dict[str, Curve]:
    series: dict[str, Curve] = {}
    for method in methods:
        keys = [key for key in errors.keys(sweep) if errors.psnr.get((sweep, method, key))]
        if keys:
            series[method] = (keys, [errors.mean(sweep, method, key) for key in keys])
    return series


def _statistics(
    report: Report, errors: Errors, sweep: str, name: str, caption: str, columns: list[Column], how: str, verdict: str
) -> None:
    report.table(
        name,
        caption,
        ["statistic", "method", *columns],
        [
            [statistic, method, *(errors.statistic(sweep, method, key, statistic) for key in errors.keys(sweep))]
            for statistic in STATISTICS
            for method in errors.methods(sweep)
        ],
        how,
        verdict,
    )


def _kilobytes(key: float) -> str:
    return f"{key / 1024:g} MB" if key >= 1024 else f"{key:g} KB"


def _models(report: Report, settings: Settings) -> None:
    """The blends on models whose parameters are known."""
    errors = Errors()
    for name, text in ANALYTIC.items():
        m: Reflectance = load(text)
        measure(errors, name, m, by_pictures(m, settings.texture, (len(PLASTIC), len(METAL))), settings.sphere)
    methods = errors.methods("pictures")
    columns = [
        Column(f"N = {len(angles)}, {method}", "dB", ".1f", "ours") for angles in (PLASTIC, METAL) for method in methods
    ]
    keys = [("pictures", method, len(angles)) for angles in (PLASTIC, METAL) for method in methods]
    rows: list[list[Cell]] = [[name, *(errors.psnr[key][name] for key in keys)] for name in ANALYTIC]
    rows.append(["mean", *(errors.mean(*key) for key in keys)])
    counts = len(PLASTIC), len(METAL)
    best = {count: max(methods, key=lambda x: errors.mean("pictures", x, count)) for count in counts}
    report.table(
        "models",
        "PSNR of models with known parameters",
        ["model", *columns],
        rows,
        f"Pictures of {settings.texture}² texels.",
        " ".join(f"With {count} pictures the highest mean is that of {method}." for count, method in best.items()),
    )


def _materials(report: Report, errors: Errors) -> None:
    shown = [
        (f"4 pictures, {LITERAL['paper']}", ("pictures", LITERAL["paper"], 4)),
        (f"4 pictures, {MONOTONE}", ("pictures", MONOTONE, 4)),
        (f"4 pictures, {SEPARATED}", ("pictures", SEPARATED, 4)),
        (f"6 pictures, {LITERAL['paper']}", ("pictures", LITERAL["paper"], 6)),
        (f"6 pictures, {MONOTONE}", ("pictures", MONOTONE, 6)),
        (f"6 pictures, {SEPARATED}", ("pictures", SEPARATED, 6)),
        *(
            (f"{method}, {_kilobytes(key)}", ("bytes", method, key))
            for method in (STACK, STACK_AT_NODES)
            for key in errors.keys("bytes")
        ),
    ]
    shown = [(title, key) for title, key in shown if errors.psnr.get(key)]
    names = list(errors.psnr[shown[0][1]])
    report.table(
        "materials",
        "PSNR of the shipped materials",
        ["material", *(Column(title, "dB", ".1f", "ours") for title, _ in shown)],
        [[name, *(errors.psnr[key][name] for _, key in shown)] for name in names],
    )
