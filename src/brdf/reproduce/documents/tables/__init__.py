"""Parameterisations of tabulated reflectance: its figures, its claims, and what a table of so many bytes can do.

Reference: Mallett2016.
"""

from __future__ import annotations

from ...report import Report
from . import claims, conversion, density, filters, intensity, memory, resolution, teapots
from .measuring import measured
from .settings import SETTINGS, Settings

__all__ = ["SETTINGS", "SOURCE", "TITLE", "run"]

TITLE = "Parameterisation of tabulated BRDFs"
SOURCE = (
    "I. Mallett and C. Yuksel: Parameterization of Tabulated BRDFs. Computer Graphics International 2016. Figures 2 to "
    "7 are made again, its claims are measured, and its tables are set beside others of the same size."
)


def run(report: Report, settings: Settings) -> None:
    """Everything, in the order of the paper."""
    report.section(
        "Where the nodes lie",
        "A warp F turns the cosine of an angle into a place on the axis. The paper's identity has even cosines, its "
        "uniform one even angles; its Bézier curve goes from crowded at the ends (α = 0) to the identity (α = 1).",
    )
    waste = density.present(report)
    report.section(
        "Total intensity",
        "The paper chooses its alphas, one for both polar angles and one for the azimuth, by the brightest table.",
    )
    found = measured(settings)
    wins = intensity.present(report, found)
    report.section("On the teapot")
    pots = teapots.isotropic(report, settings)
    teapots.anisotropic(report, settings)
    report.section("Resolution")
    resolutions = resolution.present(report, settings)
    report.section("Filters", "Between its nodes a table is read by 1, 8 or 64 of them.")
    creases = filters.present(report, settings)
    memory.present(report, settings, found)
    conversion.present(report, settings)
    claims.state(report, found, wins, waste, pots, resolutions, creases)
