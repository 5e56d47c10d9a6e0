"""How far the paper's models are from the materials: every error, from the least to the largest."""

from __future__ import annotations

from collections.abc import Sequence

from .... import materials
from ...charts import curves
from ...report import Report
from .measuring import METRIC, Score
from .tables import NGAN, errors_of, fits_of


def sorted_errors(report: Report, scores: Sequence[Score]) -> None:
    """A curve a model, once as published and once as fitted by us."""
    _sorted(report, "sorted-published", "The paper's seven models as published.", scores, "published")
    _sorted(report, "sorted-ours", "The same models, fitted by us.", scores, "ours")


def _sorted(report: Report, name: str, title: str, scores: Sequence[Score], whose: str) -> None:
    series = {
        materials.published(fit).model: (list(range(1, len(errors) + 1)), sorted(errors))
        for fit in fits_of(scores)
        if fit.startswith(NGAN) and len(errors := errors_of(scores, fit, whose)) > 1
    }
    if series:
        caption = f"{title} Each curve has a model's errors in ascending order."
        report.figure(name, caption, curves(series, "materials", METRIC, y_scale="log", marker=""))
