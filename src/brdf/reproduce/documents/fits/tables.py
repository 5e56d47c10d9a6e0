"""The tables of the published fits, and what the paper concludes beside what was measured."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np
from scipy.stats import spearmanr

from .... import materials as shipped
from ...report import Cell, Column, Report
from .measuring import AROUND, EVERY, METRIC, Score

MIRROR = "ngan_lafortune"
"""The one of the paper's models whose lobe stands about the mirror direction."""

NGAN = "ngan_"
"""Begins the names of that paper's fits."""

PEOPLE = {
    "bagher_sgd": 0.292, "ngan_blinnphong": 0.364, "ngan_ward": 0.394, "ngan_lafortune": 0.427,
    "low_lowmicrofacet_E2": 0.433,
}  # fmt: skip
"""Mean perceived distance from the measurement over 69 materials, by published fit [Lavoue2021]."""

NO_WORSE = 1e-3
"""Relative: below it two errors count as equal."""


def errors(report: Report, scores: Sequence[Score]) -> None:
    """Means over the materials, a line a published set of fits."""
    columns: list[Column | str] = ["fits", "model", Column("materials", "1")]
    columns += [Column(metric, "1", "#.3g", "paper") for metric in EVERY]
    columns += [Column(f"{METRIC}, same materials", "1", "#.3g", "paper"), Column("ours", "1", "#.3g", "ours")]
    rows: list[list[Cell]] = []
    for fit in fits_of(scores):
        own = [s for s in scores if s.fit == fit]
        both = [s for s in own if s.ours is not None]
        pair: list[float | None] = [None, None]
        if both:
            pair = [_mean([s.published[METRIC] for s in both]), _mean([s.ours[METRIC] for s in both if s.ours])]
        means = [_mean([s.published[metric] for s in own]) for metric in EVERY]
        rows.append([fit, shipped.published(fit).model, len(own), *means, *pair])
    report.table("errors", "Mean errors of the published fits, and of ours", columns, rows)


def winners(report: Report, scores: Sequence[Score]) -> None:
    """In how many materials each set of fits has the least error: of all sets, and of the paper's seven models."""
    _winners(report, "winners", "Materials in which a model is the nearest", scores)
    own = [s for s in scores if s.fit.startswith(NGAN)]
    _winners(report, "winners-ngan", "Materials in which a model is the nearest of the paper's seven", own)


def _winners(report: Report, name: str, title: str, scores: Sequence[Score]) -> None:
    wins = {metric: Counter(_nearest(scores, metric, False).values()) for metric in EVERY}
    ours = {metric: Counter(_nearest(scores, metric, True).values()) for metric in (METRIC, AROUND)}
    rows: list[list[Cell]] = [
        [fit, *(wins[metric][fit] for metric in EVERY), *(own[fit] for own in ours.values())] for fit in fits_of(scores)
    ]
    columns: list[Column | str] = ["fits", *(Column(metric, "1", "d", "paper") for metric in EVERY)]
    columns += [Column(f"our fits, {metric}", "1", "d", "ours") for metric in ours]
    count = len({s.material for s in scores})
    report.table(name, title, columns, rows, how=f"of {count} materials; our fits of {sum(ours[METRIC].values())}")


def people(report: Report, scores: Sequence[Score]) -> None:
    """Five sets of fits in the order in which people put them, and the mean of each metric over the same materials."""
    sets = [{s.material for s in scores if s.fit == fit} for fit in PEOPLE]
    common = set.intersection(*sets)
    if not common:
        return
    of = {
        fit: [_mean([s.published[metric] for s in scores if s.fit == fit and s.material in common]) for metric in EVERY]
        for fit in PEOPLE
    }
    rows: list[list[Cell]] = [[fit, seen, *of[fit]] for fit, seen in PEOPLE.items()]
    ranks = [spearmanr(list(PEOPLE.values()), [of[fit][k] for fit in PEOPLE]).statistic for k in range(len(EVERY))]
    rows.append(["Spearman's correlation", None, *map(float, ranks)])
    columns: list[Column | str] = ["fits", Column("people", "1", ".3f", "paper")]
    columns += [Column(metric, "1", "#.3g", "ours") for metric in EVERY]
    report.table("people", "As people see them, and as metrics do", columns, rows, how=f"over {len(common)} materials")


def materials(report: Report, scores: Sequence[Score]) -> None:
    """The nearest published fit of each material."""
    nearest = _nearest(scores, METRIC, False)
    own = _nearest(scores, METRIC, True)
    found = {(s.material, s.fit): s for s in scores}
    rows: list[list[Cell]] = []
    for name, fit in nearest.items():
        best = own.get(name)
        ours = found[name, best].ours if best else None
        rows.append([name, fit, found[name, fit].published[METRIC], best, ours[METRIC] if ours else None])
    columns: list[Column | str] = ["material", "nearest published", Column(METRIC, "1", "#.3g", "paper")]
    columns += ["nearest of ours", Column(METRIC, "1", "#.3g", "ours")]
    report.table("materials", "The nearest fit of each material", columns, rows)


def claims(report: Report, scores: Sequence[Score]) -> None:
    """Sentences of the abstract, and the promise of our own fits."""
    half = [f for f in fits_of(scores) if f.startswith("ngan_") and f != MIRROR]
    checks = {}
    for name in ("published", "ours"):
        medians = {f: float(np.median(errors)) for f in (*half, MIRROR) if (errors := errors_of(scores, f, name))}
        if MIRROR in medians:
            behind = sum(v < medians[MIRROR] for f, v in medians.items() if f != MIRROR)
            others = len(medians) - 1
            text = f"{name}: {behind} of {others} models of half vectors have a smaller median error than Lafortune's"
            checks[text] = 2 * behind > others
    report.claim("the latter [the half-vector] gives a more accurate shape for the reflection lobe", checks)
    both = [s for s in scores if s.ours is not None]
    if both:
        no_worse = sum(s.ours[METRIC] <= s.published[METRIC] * (1 + NO_WORSE) for s in both if s.ours)
        share = f"{no_worse} of {len(both)} cases ({no_worse / len(both):.1%})"
        text = f"our fit has no larger {METRIC} than the published row in {share}; at least 99 % are wanted"
        report.claim("compute the best approximation for each analytical model", {text: no_worse >= 0.99 * len(both)})


def fits_of(scores: Sequence[Score]) -> list[str]:
    """The published sets, by name."""
    return sorted({s.fit for s in scores})


def errors_of(scores: Sequence[Score], fit: str, whose: str) -> list[float]:
    """Of a set over its materials, in `METRIC`; `whose`: "published" or "ours"."""
    own = [s.published if whose == "published" else s.ours for s in scores if s.fit == fit]
    return [errors[METRIC] for errors in own if errors is not None]


def _nearest(scores: Sequence[Score], metric: str, ours: bool) -> dict[str, str]:
    """The fit with the least error, by material."""
    best: dict[str, tuple[float, str]] = {}
    for s in scores:
        errors = s.ours if ours else s.published
        if errors is not None and (s.material not in best or errors[metric] < best[s.material][0]):
            best[s.material] = (errors[metric], s.fit)
    return {name: fit for name, (_, fit) in best.items()}


def _mean(values: Sequence[float]) -> float:
    return float(np.mean(values))
