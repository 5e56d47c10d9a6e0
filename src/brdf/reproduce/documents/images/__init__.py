"""Image-based representation of isotropic reflectance: its figures, Table I, its claims, and what it takes to match it.

Reference: Mihalik2015.
"""

from __future__ import annotations

from ...report import Report
from . import accuracy, claims, scenes, spheres
from .measuring import measured
from .settings import SETTINGS, Settings

__all__ = ["SETTINGS", "SOURCE", "TITLE", "run"]

TITLE = "Image-based isotropic reflectance"
SOURCE = (
    "A. Mihálik and R. Ďurikovič: Image-based BRDF representation. Journal of Applied Mathematics, Statistics and "
    "Informatics 11 (2), 2015. Figures 3 to 6 and Table I are made again, its claims are measured, and its pictures "
    "are set beside tables of the same size."
)


def run(report: Report, settings: Settings) -> None:
    """Everything, in the order of the paper."""
    report.section(
        "Pictures of a sphere",
        "A sphere seen from afar under one light shows a reflectance for every normal at once; a few such pictures, at "
        "different angles φ between light and viewer, stand for all of it. The paper uses four for plastics and six "
        "for metals and for paints whose colour shifts.",
    )
    spheres.textures(report, settings)
    report.section(
        "Blending two pictures",
        "Between two pictures the normal is turned towards each by k times the angle that is missing, and what is "
        "found there is blended. The paper goes from k = 1 over k = 1/2 to k = (1 + sin α)/2, α from the half vector. "
        "Ours lets the shadow's edge, the half vector and the limb each land on its like: k = (1 − s³)/2.",
    )
    ways = spheres.blending(report, settings)
    report.section("On meshes", "The normal is turned into the frame of viewer and light at every pixel.")
    scenes.materials(report, settings)
    scenes.gold(report, settings)
    times = scenes.frames(report, settings)
    errors = measured(settings)
    accuracy.present(report, settings, errors)
    claims.state(report, settings, errors, ways, times)
