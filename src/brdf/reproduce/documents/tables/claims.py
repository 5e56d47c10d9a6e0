"""What the paper says, and what was measured."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping

import numpy as np

from ....geometry.warps import Bezier, identity
from ...report import Report
from ..images.claims import METALS
from .density import EVEN, PAPER_WASTE, from_even
from .measuring import Measured
from .memory import ERRORS
from .options import BEZIER, HALF_LOG, IDENTITY, INTENSE, MEASURED, UNIFORM, Alphas
from .resolution import Resolutions
from .teapots import Errors

NEARLY = 8.0
""""Nearly an order of magnitude"."""

ALIKE = 1.25
""""Broadly identical": the slowest takes at most so many times as long as the fastest."""

SMOOTH = 0.2
"""Creases, in parts of the linear filter's, below which they count as gone."""


def state(
    report: Report, found: Measured, wins: Counter[Alphas], waste: Mapping[str, float], teapots: Errors,
    resolutions: tuple[Resolutions, Resolutions], creases: Mapping[str, float],
) -> None:  # fmt: skip
    """Every claim with its checks, from what the sections returned."""
    report.section("The paper's claims", "Each with what was measured.")
    _accuracy(report, found, resolutions[0])
    _every_case(report, found, teapots)
    _time(report, resolutions[1])
    _picks(report, found, wins)
    _metals(report, found)
    _placement(report)
    _waste(report, waste)
    _even(report)
    _filters(report, creases)
    _optimum(report, found)


def _accuracy(report: Report, found: Measured, errors: Resolutions) -> None:
    checks = {}
    for peer in (IDENTITY, UNIFORM):
        for bezier in (INTENSE, MEASURED):
            for k in (found.budgets[0], found.budgets[-1]):
                gain = float(np.median(found.ratios(peer, bezier, k)))
                checks[
                    f"{k:g} KB: {bezier} has {gain:.1f} times less error than {peer} (median of "
                    f"{len(found.names)} materials)"
                ] = gain >= NEARLY
            sizes = errors.sizes
            gains = [errors[peer, n] / errors[bezier, n] for n in sizes]
            checks[
                f"the teapot's picture: {bezier} against {peer} {gains[0]:.1f} times at N = {sizes[0]}, "
                f"{gains[-1]:.1f} times at N = {sizes[-1]}"
            ] = gains[-1] >= NEARLY
    report.claim(
        "Bézier parameterization achieves nearly an order-of-magnitude better accuracy, particularly for "
        f"higher-resolution data. (From {NEARLY:g} times on.)",
        checks,
    )


def _every_case(report: Report, found: Measured, teapots: Errors) -> None:
    checks = {}
    for way in (INTENSE, MEASURED, BEZIER):
        better = [name for name, errors in teapots.items() if errors[way] < errors[UNIFORM]]
        checks[f"figure 4: {way} is better than uniform on {len(better)} of {len(teapots)} materials"] = len(
            better
        ) == len(teapots)
        k = found.budgets[-1]
        for error, name in enumerate(ERRORS):
            ratios = found.ratios(UNIFORM, way, k, error)
            count = sum(ratio > 1 for ratio in ratios)
            checks[
                f"{k:g} KB: {way} has a smaller {name} than uniform on {count} of {len(ratios)} materials, in the "
                f"median {np.median(ratios):.2g} times"
            ] = count == len(ratios)
    report.claim("Bézier parameterization produces a smaller RMS error in all cases.", checks)


def _time(report: Report, times: Resolutions) -> None:
    checks = {}
    for n in times.sizes:
        found = {option: times[option, n] for option in (IDENTITY, UNIFORM, BEZIER)}
        slowest, fastest = max(found, key=found.__getitem__), min(found, key=found.__getitem__)
        checks[f"N = {n}: {slowest} takes {found[slowest]:.1f} ns, {fastest} {found[fastest]:.1f} ns a lookup"] = (
            found[slowest] <= ALIKE * found[fastest]
        )
    small, large = (times[BEZIER, n] for n in (times.sizes[0], times.sizes[-1]))
    checks[
        f"what bounds it is the working set: Bézier takes {large:.1f} ns at N = {times.sizes[-1]}, {small:.1f} ns at N "
        f"= {times.sizes[0]}"
    ] = large > ALIKE * small
    report.claim(
        "Performance is largely bound by working-set size, leading to broadly identical performance characteristics "
        f"among the three methods. (Within {ALIKE:g} times.)",
        checks,
    )


def _picks(report: Report, found: Measured, wins: Counter[Alphas]) -> None:
    total = len(found.names)
    azimuth = sum(count for (_, phi), count in wins.items() if phi == 0)
    ends = sum(count for (theta, _), count in wins.items() if theta in (0, 1))
    report.claim(
        "We found that the metric favors α_φ = 0 for all materials in the MERL BRDF database. … the most common α_θ "
        "value is either α_θ = 0 or α_θ = 1.",
        {
            f"α_φ = 0 has the largest total intensity for {azimuth} of {total} materials": azimuth == total,
            f"α_θ is 0 or 1 for {ends} of {total}": 2 * ends > total,
        },
    )
    k = found.budgets[-1]
    gains = [float(np.median(found.ratios(INTENSE, way, k, error))) for error in (0, 1) for way in (MEASURED, BEZIER)]
    report.claim(
        "This total intensity metric is directly indicative of how well high-energy portions of the BRDF are sampled.",
        {
            f"{k:g} KB: alphas of the least measured error have {gains[0]:.2g} times less relative error and "
            f"{gains[2]:.2g} times less display error": max(gains[0], gains[2]) <= 1,
            f"{k:g} KB: so has one fixed pair for all materials, {gains[1]:.2g} and {gains[3]:.2g} times": max(
                gains[1], gains[3]
            )
            <= 1,
        },
    )


def _metals(report: Report, found: Measured) -> None:
    ratios = {name: i.bezier[i.best] / i.uniform for name, i in found.intensities.items()}
    metals = [ratio for name, ratio in ratios.items() if any(part in name for part in METALS)]
    others = [ratio for name, ratio in ratios.items() if not any(part in name for part in METALS)]
    if metals and others:
        high, low = float(np.median(metals)), float(np.median(others))
        report.claim(
            "The differences between total intensities are especially high for highly glossy materials such as metals.",
            {
                f"Bézier's is {high:.2f} times the uniform one of {len(metals)} metals and metallic paints (median), "
                f"{low:.2f} times of the {len(others)} others": high > low
            },
        )


def _placement(report: Report) -> None:
    normal, grazing = (
        [float(warp.density(angle) * warp.extent) for warp in (Bezier(alpha=0.0), identity())]
        for angle in (0, np.pi / 2)
    )
    report.claim(
        "α_θ = 0 (allocating more samples for the Fresnel peak) or α_θ = 1 (allocating more samples for ω directions "
        "near the surface normal).",
        {
            f"at the horizon α_θ = 0 has {grazing[0]:.2f} times the even density of nodes, α_θ = 1 "
            f"{grazing[1]:.2f} times": grazing[0] > grazing[1],
            f"at the normal α_θ = 0 has {normal[0]:.2f} times, α_θ = 1 {normal[1]:.2f} times": normal[1] > normal[0],
        },
    )


def _waste(report: Report, waste: Mapping[str, float]) -> None:
    report.claim(
        "More than 38% of the table's data is thus wasted.",
        {
            f"{name}: {100 * share:.1f} % of the grid is below the horizon": share > PAPER_WASTE
            for name, share in waste.items()
            if name.startswith("half")
        },
    )


def _even(report: Report) -> None:
    report.claim(
        f"When α ≈ {EVEN:g} it approximates uniform parameterization.",
        {f"coordinates differ by at most {from_even():.4f} of the axis": from_even() < 0.01},
    )


def _filters(report: Report, creases: Mapping[str, float]) -> None:
    cubic = [how for how in creases if how not in ("nearest", "linear")]
    report.claim(
        "Notice the elliptical contours … due to linear interpolation. … it is important to use higher-order "
        "reconstruction.",
        {f"{how}: creases {creases[how]:.3f} of the linear filter's": creases[how] < SMOOTH for how in cubic},
    )


def _optimum(report: Report, found: Measured) -> None:
    k = found.budgets[-1]
    best = Counter(
        min((IDENTITY, UNIFORM, BEZIER, INTENSE, MEASURED), key=lambda o: found.errors[o, k][name][0])
        for name in found.names
    )
    ahead = sum(ratio > 1 for ratio in found.ratios(MEASURED, HALF_LOG, k))
    told = ", ".join(f"{option} {count}" for option, count in best.most_common())
    report.claim(
        "No single parameterization can be optimal for all BRDFs.",
        {
            f"{k:g} KB: the least error of the paper's tables have {told}": len(best) > 1,
            f"{k:g} KB: {HALF_LOG} has less error than the best Bézier table on {ahead} of {len(found.names)}": ahead
            < len(found.names),
        },
    )
