"""Published fits of the MERL materials, scored in every metric, with our fits of the same models beside them.

Reference: Ngan2005.
"""

from __future__ import annotations

from ...report import Report
from . import figures, measuring, tables
from .settings import SETTINGS, Settings

__all__ = ["SETTINGS", "SOURCE", "TITLE", "run"]

TITLE = "Published fits of the MERL materials"
SOURCE = (
    "A. Ngan, F. Durand and W. Matusik: Experimental Analysis of BRDF Models. EGSR 2005, "
    "with the fits of Low and others (2012) and of Bagher and others (2012). The data stand in for the measurements: "
    "the published NBRDF networks (Sztrajman and others 2021, MIT licence) trained on them, for 80 of the 100."
)


def run(report: Report, settings: Settings) -> None:
    """Score the rows, fit the same models, and weigh what the paper concludes."""
    weights = measuring.network_weights()
    if weights is None:
        report.section(
            "Data", "Nothing was measured: BRDF_DATA does not name a folder with merl/merl_nbrdf_weights.npz."
        )
        return
    scores = measuring.measured(weights, settings)
    report.section(
        "Errors",
        f"Over {settings.pairs:,} pairs of directions within {measuring.GRAZING:g}° of the normal, the mean over the "
        "materials. Ours: the same model with the same parameters, fitted in the cosine-weighted L2 from its defaults.",
    )
    tables.errors(report, scores)
    figures.sorted_errors(report, scores)
    report.section("Which model is nearest")
    tables.winners(report, scores)
    tables.materials(report, scores)
    report.section(
        "What people see",
        "Mean perceived distances between renderings of a material and of its fit, from the judgements of Lavoué and "
        "others (2021) on 69 materials, beside the means of the metrics. The guide to comparing has them judgement by "
        "judgement.",
    )
    tables.people(report, scores)
    report.section("Conclusions")
    tables.claims(report, scores)
