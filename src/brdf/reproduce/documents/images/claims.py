"""What the paper says, and what was measured."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ...report import Report
from .accuracy import equal_table
from .candidates import LITERAL, MONOTONE, SEPARATED
from .measuring import Errors
from .scenes import LIGHTS
from .settings import VISIBLE, Settings

MERL_BYTES = 90 * 90 * 180 * 3 * 8
"""A table as the paper's materials come: doubles."""

PAPER_BYTES = 4 * 512 * 512 * 3
"""Four of its pictures with 8 bits a channel."""

SUFFICIENT = 0.10
"""Eight lights "do not significantly" cost more than one when a frame takes at most so much longer."""

SAME = 0.5
"""dB below which a change of the pictures' size counts as none."""

METALS = (
    "metallic", "alum-bronze", "aluminium", "brass", "chrome", "nickel", "steel", "ss440", "tungsten", "two-layer",
    "color-changing", "hematite", "silver-paint", "gold-paint",
)  # fmt: skip
"""What the names of metals and of materials with a colour shift contain."""

PAPER = LITERAL["paper"]

Ways = Mapping[str, Mapping[str, float]]


def state(report: Report, settings: Settings, errors: Errors, ways: Ways, times: Mapping[str, Sequence[float]]) -> None:
    """Every claim with its checks; `ways` and `times` as `spheres.blending` and `scenes.frames` return them."""
    report.section(
        "The paper's claims",
        f"Each with what was measured. A picture counts as right from {VISIBLE:g} dB on: an RMS error of 1 % of full "
        "scale.",
    )
    names = list(errors.psnr["pictures", PAPER, 4])
    plastics = [name for name in names if "plastic" in name]
    metals = [name for name in names if any(part in name for part in METALS)]
    if plastics:
        _four_pictures(report, errors, plastics)
    if plastics and metals:
        _denser(report, errors, plastics, metals)
    _coefficient(report, ways)
    _shortening(report, ways)
    _size(report, errors)
    _memory(report, errors, settings.largest)
    _lights(report, times)


def _four_pictures(report: Report, errors: Errors, plastics: Sequence[str]) -> None:
    checks = {}
    for method in (PAPER, MONOTONE, SEPARATED):
        values = [errors.psnr["pictures", method, 4][name] for name in plastics]
        right = sum(value >= VISIBLE for value in values)
        text = (
            f"{method}: with four pictures {right} of {len(values)} plastics reach {VISIBLE:g} dB; mean "
            f"{sum(values) / len(values):.1f} dB, worst {min(values):.1f} dB"
        )
        checks[text] = right == len(values)
    report.claim(
        "We found out that such low density of light direction sampling was working well in the case of plastics.",
        checks,
    )


def _denser(report: Report, errors: Errors, plastics: Sequence[str], metals: Sequence[str]) -> None:
    (p4, m4), (p6, m6) = (
        [errors.mean("pictures", PAPER, count, members) for members in (plastics, metals)] for count in (4, 6)
    )
    report.claim(
        "In the case of metallics or the material surfaces that produce the color shift … we decided to use slightly "
        "denser light direction sampling.",
        {
            f"with four pictures {len(metals)} metals and colour-shifting materials have {m4:.1f} dB, {len(plastics)} "
            f"plastics {p4:.1f} dB ({PAPER})": m4 < p4,
            f"two more pictures bring the metals {m6 - m4:+.1f} dB, the plastics {p6 - p4:+.1f} dB": m6 - m4 > p6 - p4,
        },
    )


def _coefficient(report: Report, ways: Ways) -> None:
    full, half, paper, _, ours, *_ = ways.values()
    share = paper["matte RMSE"] / half["matte RMSE"]
    report.claim(
        "Specular reflection is doubled around the point where the normal is equal to the halfway vector. To fix this "
        "we can use halves of the angles. However, this way we mess up the diffuse shading.",
        {
            f"highlights with full angles: {full['highlights']}": full["highlights"] > 1,
            f"highlights with half angles: {half['highlights']}": half["highlights"] == 1,
            f"RMSE of a white diffuser: {full['matte RMSE']:.4f} with full angles, {half['matte RMSE']:.4f} with half "
            "angles": half["matte RMSE"] > 2 * full["matte RMSE"],
        },
    )
    report.claim(
        "The desired result … with correct diffuse and specular component according to Equation 4.",
        {
            f"highlights: {paper['highlights']}": paper["highlights"] == 1,
            f"RMSE of the diffuser: {paper['matte RMSE']:.4f}, {share:.0%} of that with half angles (monotone k "
            f"{ours['matte RMSE']:.4f})": share < 0.5,
            f"PSNR {paper['psnr']:.1f} dB; with full angles {full['psnr']:.1f}, with half angles {half['psnr']:.1f} "
            f"(monotone k {ours['psnr']:.1f})": paper["psnr"] > max(full["psnr"], half["psnr"]),
        },
    )


def _shortening(report: Report, ways: Ways) -> None:
    shortened, whole, ours = list(ways.values())[2:5]
    report.claim(
        "To solve this problem [artefacts at the sphere's rim], we simply shorten the length of surface normal by the "
        "multiplication of normal by the factor 0.995.",
        {
            f"PSNR {shortened['psnr']:.1f} dB with the factor, {whole['psnr']:.1f} dB without (monotone k, the limb "
            f"repeated around the disc: {ours['psnr']:.1f} dB)": shortened["psnr"] > whole["psnr"],
            f"largest error of the diffuser {shortened['matte worst']:.3f} with the factor, {whole['matte worst']:.3f} "
            f"without (monotone k: {ours['matte worst']:.3f})": shortened["matte worst"] < 0.5 * whole["matte worst"],
        },
    )


def _size(report: Report, errors: Errors) -> None:
    small, large = errors.keys("size")
    checks = {}
    for method in errors.methods("size"):
        gain = errors.mean("size", method, large) - errors.mean("size", method, small)
        checks[f"{method}: from {small:g}² to {large:g}² the mean PSNR changes by {gain:+.2f} dB"] = abs(gain) < SAME
    report.claim("We have used resolution 512 × 512 which we found suitable for general use.", checks)


def _memory(report: Report, errors: Errors, texels: int) -> None:
    decibels = errors.mean("size", PAPER, texels)
    equal = equal_table(errors, decibels)
    checks = {
        f"four 8-bit pictures of 512² take {PAPER_BYTES / 2**20:.0f} MB, a measured table of doubles "
        f"{MERL_BYTES / 2**20:.0f} MB": PAPER_BYTES < MERL_BYTES
    }
    if equal is not None:
        method, kilobytes = equal
        other = errors.mean("bytes", method, kilobytes)
        text = (
            f"at no more error the pictures are smaller: four of {texels}² with {PAPER} have {decibels:.1f} dB, a "
            f"{method}, of {kilobytes:g} KB {other:.1f} dB"
        )
        checks[text] = kilobytes * 1024 >= PAPER_BYTES
    report.claim("This approach is an alternative to the tabulated BRDF with less memory consumption.", checks)


def _lights(report: Report, times: Mapping[str, Sequence[float]]) -> None:
    report.claim(
        "Since our method is based mainly on the texture fetch, addition of extra light source does not significantly "
        "decrease the performance.",
        {
            f"{mesh}, on the processor: {t[0]:.1f} ms with {LIGHTS[0]} light, {t[-1]:.1f} ms with {LIGHTS[-1]}, "
            f"{t[-1] / t[0]:.1f} times as long": t[-1] <= (1 + SUFFICIENT) * t[0]
            for mesh, t in times.items()
        },
    )
