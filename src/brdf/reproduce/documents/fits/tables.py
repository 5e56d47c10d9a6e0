"""The tables of the published fits, and what the paper concludes beside what was measured."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np

from .... import materials as shipped
from ....metrics import METRICS
from ...report import Cell, Column, Report
from .measuring import METRIC, Score

MIRROR = "ngan_lafortune"
"""The one of the paper's models whose lobe stands about the mirror direction."""

NO_WORSE = 1e-3
"""Relative: below it two errors count as equal."""


def errors(report: Report, scores: Sequence[Score]) -> None:
    """Means over the materials, a line a published set of fits."""
    columns: list[Column | str] = ["fits", "model", Column("materials", "1")]
    columns += [Column(metric, "1", ".3g", "paper") for metric in METRICS]
    columns += [Column(f"{METRIC}, same materials", "1", ".3g", "paper"), Column("ours", "1", ".3g", "ours")]
    rows: list[list[Cell]] = []
    for fit in _fits(scores):
        own = [s for s in scores if s.fit == fit]
        both = [s for s in own if s.ours is not None]
        pair: list[float | None] = [None, None]
        if both:
            pair = [_mean([s.published[METRIC] for s in both]), _mean([s.ours[METRIC] for s in both if s.ours])]
        means = [_mean([s.published[metric] for s in own]) for metric in METRICS]
        rows.append([fit, shipped.published(fit).model, len(own), *means, *pair])
    report.table("errors", "Mean errors of the published fits, and of ours", columns, rows)


def winners(report: Report, scores: Sequence[Score]) -> None:
    """In how many materials each set of fits has the least error."""
    wins = {metric: Counter(_nearest(scores, metric, False).values()) for metric in METRICS}
    ours = Counter(_nearest(scores, METRIC, True).values())
    rows: list[list[Cell]] = [[fit, *(wins[metric][fit] for metric in METRICS), ours[fit]] for fit in _fits(scores)]
    columns: list[Column | str] = ["fits", *(Column(metric, "1", "d", "paper") for metric in METRICS)]
    report.table(
        "winners",
        "Materials in which a model is the nearest",
        [*columns, Column(f"ours, {METRIC}", "1", "d", "ours")],
        rows,
        how=f"of {len({s.material for s in scores})} materials; ours of {sum(ours.values())}",
    )


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
    columns: list[Column | str] = ["material", "nearest published", Column(METRIC, "1", ".3g", "paper")]
    columns += ["nearest of ours", Column(METRIC, "1", ".3g", "ours")]
    report.table("materials", "The nearest fit of each material", columns, rows)


def claims(report: Report, scores: Sequence[Score]) -> None:
    """Sentences of the abstract, and the promise of our own fits."""
    half = [f for f in _fits(scores) if f.startswith("ngan_") and f != MIRROR]
    checks = {}
    for name in ("published", "ours"):
        medians = {f: float(np.median(errors)) for f in (*half, MIRROR) if (errors := _of(scores, f, name))}
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


def _fits(scores: Sequence[Score]) -> list[str]:
    return sorted({s.fit for s in scores})


def _of(scores: Sequence[Score], fit: str, whose: str) -> list[float]:
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
