"""What the paper says, and what was measured."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...report import Report
from .compression import COUNTS, EVEN, NATIVE, PAPER, PAPER_TABLE, PICTURES, PRINCIPAL, Losses
from .full_btf import FULL, OWN, TRUE_R, Found
from .prediction import Predictions
from .samples import geometric
from .settings import SLICES
from .stacks import Averages
from .techniques import ANGULAR, COLUMNS, LIT, SHADING, STRONG, TECHNIQUES, WEAK, Errors
from .timing import PAPER_SECONDS, Times
from .vertices import DIVISIONS, EXPONENTS

SIMILAR = 1.15
"""Two errors count as similar up to this ratio."""
VISIBLY = 1.5
"""One error is clearly the larger from this ratio on."""
CLEARLY = 6.0
"""dB from which one picture is clearly better."""
CLOSE = 0.1
"""Relative RMS error per texel up to which pictures look the same."""
MARGIN = 1e-12
"""Within which the averages of pictures looked up are to be r."""
GOALS = {"between": 35.0, "at": 0.007, "left out": 0.017, "fit": 0.1, "capture": 10.0}
"""What this package sets itself: dB between photographs; RMS of 6 bytes at and between photographs; seconds."""


@dataclass(frozen=True)
class Everything:
    """What the sections measured."""

    averages: Averages
    errors: Errors
    vertices: Mapping[tuple[float, int], float]
    btf: Found
    losses: Losses
    predictions: Predictions
    times: Times


def state(report: Report, found: Everything) -> None:
    """Every claim with its checks."""
    report.section("The paper's claims", "Each with what was measured.")
    _same_material(report, found)
    _techniques(report, found.errors)
    _grazing(report, found.btf)
    _compression(report, found.losses)
    _slices(report, found.losses)
    _speed(report, found.times)
    _vertices(report, found.vertices)
    report.section("What this package sets itself")
    _goals(report, found)


def _same_material(report: Report, found: Everything) -> None:
    histogram = found.errors.mean(SHADING, 1, *list(COLUMNS.values())[4][1:])
    lit = found.errors.mean(LIT, 1, *list(COLUMNS.values())[4][1:])
    low, low_lit = (found.errors.mean(t, 1, *list(COLUMNS.values())[6][1:]) for t in (SHADING, LIT))
    report.claim(
        "All the BTF slices with the same average exit radiance will look roughly the same.",
        {
            f"histograms, lamp all around, θi ≤ 40°: they differ by {histogram:.3f} of the mean from the slice "
            f"with the same average, by {lit:.3f} from the brightest one scaled": histogram * VISIBLY < lit,
            f"the same for θi ≥ 60°: {low:.3f} and {low_lit:.3f}": low * VISIBLY < low_lit,
            **_texels(found.errors),
        },
    )
    own, between = max(found.predictions.at_photographs.values()), found.predictions.between
    report.claim(
        "If the user chooses a BRDF equal to the original average BRDF, the resulting material looks the same as the "
        "original material.",
        {
            f"seen from above, as photographed: RMS {own:.0e} of white at most": own < 1e-3,
            f"under lamps in between: "
            f"{found.predictions.mean(between):.1f} dB, the worst material {min(between.values()):.1f} dB":
                found.predictions.mean(between) >= GOALS["between"],
            f"seen from anywhere ({FULL}, {OWN}): relative RMS {found.btf.mean(OWN):.2f} per texel, "
            f"{found.btf.mean(OWN, 1):.2f} of the histogram": found.btf.mean(OWN) < CLOSE,
        },
    )  # fmt: skip


def _texels(errors: Errors) -> dict[str, bool]:
    titles = list(COLUMNS)
    found = {}
    for title in (titles[4], titles[6]):
        ours, lit = (errors.mean(technique, *COLUMNS[title]) for technique in (SHADING, LIT))
        found[f"{title}: {ours:.2f} of the mean, {lit:.2f} from the brightest scaled"] = ours < lit
    return found


def _techniques(report: Report, errors: Errors) -> None:
    titles = list(COLUMNS)
    photographed, low = titles[:4], titles[2:4]

    def mean(technique: str, title: str, names: Sequence[str] | None = None) -> float:
        return errors.mean(technique, *COLUMNS[title], names=names)

    specular = [name for name in ("plastic",) if name in errors.names]
    report.claim(
        "The scaled texture map performs badly for specular materials, like plastic.",
        {
            f"{name}, {title}: {mean(LIT, title, [name]):.2f}, lookup with r {mean(SHADING, title, [name]):.2f}":
                mean(LIT, title, [name]) > VISIBLY * mean(SHADING, title, [name])
            for name in specular for title in photographed
        },
    )  # fmt: skip
    report.claim(
        "The second technique is highly dependent on the light source intensity.",
        {
            f"{title}: {mean(WEAK, title):.2f} with a quarter of the light, {mean(STRONG, title):.2f} with four times "
            "as much": max(mean(WEAK, title), mean(STRONG, title))
            > VISIBLY * min(mean(WEAK, title), mean(STRONG, title))
            for title in photographed
        },
    )
    report.claim(
        "The third and fourth techniques produce fairly similar results. But at grazing angles the simple angular "
        "based lookup fails to reproduce highlights.",
        {
            **{f"{title}: {ANGULAR} {mean(ANGULAR, title):.3f}, {SHADING} {mean(SHADING, title):.3f}":
               mean(ANGULAR, title) < SIMILAR * mean(SHADING, title) for title in titles[:2]},
            **{f"{title}, {name}: {ANGULAR} {mean(ANGULAR, title, [name]):.3f}, {SHADING} "
               f"{mean(SHADING, title, [name]):.3f}":
               mean(ANGULAR, title, [name]) > SIMILAR * mean(SHADING, title, [name])
               for title in low for name in specular},
        },
    )  # fmt: skip
    report.claim(
        "Our proposed model (lookup with r) is the best of the four.",
        {
            f"{title}: {mean(SHADING, title):.3f}, the best other {other:.3f}": mean(SHADING, title) < other
            for title in titles
            for other in [min(mean(technique, title) for technique in TECHNIQUES if technique != SHADING)]
        },
    )


def _grazing(report: Report, btf: Found) -> None:
    first, last = float(min(btf.views)), float(max(btf.views))
    steep, grazing = (btf.mean(TRUE_R, views=angle, photographed=True) for angle in (first, last))
    around = [btf.mean(TRUE_R, views=angle) for angle in (first, last)]
    report.claim(
        "Differences [from a full BTF] are mainly visible at grazing angles, where masking effects become important, "
        "which cannot be reproduced by our technique.",
        {
            f"the lamp at the photographs' azimuth: seen from {first:g}° the relative RMS error is {steep:.2f}, from "
            f"{last:g}° {grazing:.2f}": grazing > VISIBLY * steep,
            f"the lamp all around: {around[0]:.2f} and {around[1]:.2f}": around[1] > VISIBLY * around[0],
        },
    )  # fmt: skip


def _compression(report: Report, losses: Losses) -> None:
    fit = losses.table[PAPER]
    low, high = min(PAPER_TABLE.values()), max(PAPER_TABLE.values())
    mean = float(np.mean(list(fit.values())))
    darkest, worst = min(fit, key=fit.__getitem__), max(fit, key=fit.__getitem__)
    report.claim(
        "The error is always in the same order of magnitude.",
        {
            f"from {fit[darkest]:.3f} ({darkest}) to {fit[worst]:.3f} ({worst}): {fit[worst] / fit[darkest]:.1f} times":
                fit[worst] < 10 * fit[darkest],
            f"mean {mean:.3f}, in the paper {low:.3f} to {high:.3f}: not larger": mean <= high,
        },
    )  # fmt: skip
    ratio = geometric(losses.shared.values()) / geometric(fit.values())
    report.claim(
        "We do this fitting separately for each color channel, which drastically increases the quality of the fit.",
        {f"one K for all channels has {ratio:.2f} times the error, and takes 4 numbers in place of 6": ratio > VISIBLY},
    )


def _slices(report: Report, losses: Losses) -> None:
    mean = {count: geometric(found.values()) for count, found in losses.by_slices.items()}
    fewer = COUNTS[COUNTS.index(SLICES) - 1]
    more = COUNTS[COUNTS.index(SLICES) + 1]
    ratios = mean[fewer] / mean[SLICES], mean[more] / mean[SLICES]
    report.claim(
        "In our experience at least 8 slices are necessary in the shading map.",
        {
            f"in parts of the error of {SLICES} slices, {fewer} have {ratios[0]:.2f}, {more} have {ratios[1]:.2f}":
                ratios[0] > SIMILAR,
        },
    )  # fmt: skip


def _speed(report: Report, times: Times) -> None:
    report.claim(
        "For a 512 × 512 × 8 data set, this fitting procedure only takes about 40 seconds.",
        {
            f"brute force: {times.fits[PAPER].wall:.2f} s; principal components: {times.fits[PRINCIPAL].wall:.3f} s":
                times.fits[PAPER].wall < PAPER_SECONDS["fit"],
            f"resampling: {times.slices.wall:.2f} s, the paper's {PAPER_SECONDS['slices']:g} s":
                times.slices.wall < PAPER_SECONDS["slices"],
        },
    )  # fmt: skip


def _vertices(report: Report, vertices: Mapping[tuple[float, int], float]) -> None:
    coarse, fine = DIVISIONS[0], DIVISIONS[-1]
    report.claim(
        "[Per pixel r] avoids undersampling artifacts that may occur when using a vertex shader.",
        {
            f"N = {exponent:g}: r at vertices has {vertices[exponent, coarse]:.1f} dB on the coarsest mesh, "
            f"{vertices[exponent, fine]:.1f} dB on the finest": vertices[exponent, coarse] + CLEARLY
            < vertices[exponent, fine]
            for exponent in EXPONENTS
        },
    )


def _goals(report: Report, found: Everything) -> None:
    titles = list(COLUMNS)[:4]
    errors, losses, predictions, times = found.errors, found.losses, found.predictions, found.times
    at, between = losses.pair(NATIVE, PRINCIPAL)
    paper = losses.pair(EVEN, PAPER)
    pictures = losses.pair(EVEN, PICTURES, 3.0 * (SLICES - 1))
    predicted = predictions.mean(predictions.between)
    lowest = sum(
        min(TECHNIQUES, key=lambda technique: errors.mean(technique, *COLUMNS[title])) == SHADING for title in titles
    )
    left = f"; one left out {predictions.mean(predictions.left_out):.1f} dB" + (
        "" if predictions.real is None else f", of a real sample {predictions.real:.1f} dB"
    )
    report.claim(
        "Averages, accuracy, memory and speed.",
        {
            f"the average of S(r) is r within {found.averages.worst:.0e} (goal {MARGIN:g})":
                found.averages.worst < MARGIN,
            f"photographs in between: {predicted:.1f} dB (goal {GOALS['between']:g}){left}":
                predicted >= GOALS["between"],
            f"lookup with r is the lowest in {lowest} of {len(titles)} columns, the lamp where it was photographed":
                lowest == len(titles),
            f"{PRINCIPAL}, 6 bytes: {at:.4f} at the photographs (goal {GOALS['at']:g}), {between:.4f} between "
            f"({GOALS['left out']:g}); the paper's fit {paper[0]:.4f} / {paper[1]:.4f}, {SLICES} slices "
            f"{pictures[0]:.4f} / {pictures[1]:.4f}": at <= GOALS["at"] and between <= GOALS["left out"],
            f"the default compression takes {times.fits[PRINCIPAL].said()} (goal {GOALS['fit']:g} s)":
                times.fits[PRINCIPAL].wall <= GOALS["fit"],
            f"photographs to a saved material: {times.capture.said()} (goal {GOALS['capture']:g} s)":
                times.capture.wall <= GOALS["capture"],
        },
    )  # fmt: skip
