"""Decoupling BRDFs from surface mesostructures: its figures, Table 1, its claims, and what it takes to do better.

Reference: Kautz2004.
"""

from __future__ import annotations

from ...report import Report
from . import claims, compression, full_btf, prediction, scenes, stacks, techniques, timing, vertices
from .samples import simulated
from .settings import SETTINGS, Settings

__all__ = ["SETTINGS", "SOURCE", "TITLE", "run"]

TITLE = "Shading maps: mesostructure without the BRDF"
SOURCE = (
    "J. Kautz, M. Sattler, R. Sarlette, R. Klein and H.-P. Seidel: Decoupling BRDFs from Surface Mesostructures. "
    "Graphics Interface 2004. Figures 1 to 7 and Table 1 are made again on simulated materials, of which the complete "
    "BTF is known."
)


def run(report: Report, settings: Settings) -> None:
    """Everything, in the order of the paper."""
    samples = simulated(settings)
    report.section(
        "From photographs to pictures",
        "A flat sample, photographed from above under a lamp at ten angles, becomes a stack of pictures indexed by "
        "their average radiance r. A BRDF of one's choice says what r is at a point of any surface; the picture of "
        "that average says what is seen there.",
    )
    scenes.bunny(report, settings, samples)
    averages = stacks.present(report, settings, samples)
    report.section("Against a complete BTF")
    btf = full_btf.present(report, settings, samples)
    report.section("Compression", "A power function a texel and channel: six numbers. And what does better in as many.")
    scenes.compressed(report, settings, samples)
    losses = compression.present(report, samples)
    report.section("Four techniques")
    errors = techniques.present(report, settings, samples)
    report.section("r at vertices or at pixels")
    at_vertices = vertices.present(report, settings, samples)
    report.section("Materials")
    scenes.materials(report, settings, samples)
    report.section("Photographs not seen")
    predictions = prediction.present(report, settings, samples)
    report.section("Times")
    times = timing.present(report, settings, samples)
    claims.state(report, claims.Everything(averages, errors, at_vertices, btf, losses, predictions, times))
