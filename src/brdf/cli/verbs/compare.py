"""`brdf compare`: how far materials are from a reference, in numbers and in a picture."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from .. import arguments, output

if TYPE_CHECKING:
    from ...metrics import Comparison
    from ...reflectance import Reflectance


def command(
    reference: Annotated[str, typer.Argument(metavar="REFERENCE", help="The material to compare with.")],
    materials: Annotated[list[str], typer.Argument(metavar="MATERIAL", help="One or several to compare.")],
    out: Annotated[
        Path | None, typer.Option("-o", "--output", help="Figure: .png, .svg, .html, .pdf. [NAME-compared.png]")
    ] = None,
    by: Annotated[
        str, typer.Option(help="Rank several by: surroundings, psnr, delta-e, log or log-relative.")
    ] = "surroundings",
    no_figure: Annotated[bool, typer.Option("--no-figure", help="The numbers alone.")] = False,
    json: arguments.AsJson = False,
) -> None:
    """Compare materials with a reference.

    Numbers: pictures of a lit sphere over all light angles (PSNR, CIEDE2000, relative RMSE), the same lit from all
    around, errors over pairs of directions, albedo, bytes; of several materials a table, the nearest first. Figure:
    spheres, ten times their differences, PSNR and CIEDE2000 against the light's angle, error over half and difference
    angle.

    \b
    Examples:
      brdf compare gold-metallic-paint gold-metallic-paint@ngan_cooktorrance
      brdf compare measured.binary small.safetensors -o lost.svg
      brdf compare chrome steel nickel GGX:alpha=.02,F0=.55 --no-figure
      brdf compare measured.binary fitted.safetensors --json
    """
    from ...errors import ParameterError, UnknownNameError
    from ...metrics import RANKINGS, rank

    if by not in RANKINGS:
        raise UnknownNameError("ranking", by, RANKINGS)
    if no_figure and out is not None:
        raise ParameterError("--no-figure and --output exclude each other; give one of them")
    with output.working("reading"):
        m, *others = arguments.load_all([reference, *materials])
    for one in (m, *others):
        _remark(one)
    path = None if no_figure else out or arguments.file_name(reference, m, "-compared.png")
    if path is not None:
        output.require_writable(path)
    with output.working("comparing"):
        ranked = rank(m, others, by=by)
    if path is not None:
        _draw(ranked, path)
    if json:
        output.print_json(_numbers(ranked) | ({} if path is None else {"file": str(path)}))
        return
    _print(ranked)
    if path is not None:
        print(path.resolve())


def _remark(m: Reflectance) -> None:
    """Says what of a material no comparison shows."""
    if m.has_delta:
        output.note(f"{m.name} mirrors like a polished surface; that part counts in the albedo alone")
    if m.transmits:
        output.note(f"{m.name} transmits; what it reflects is compared")
    arguments.remark_varying(m)


def _draw(ranked: list[Comparison], path: Path) -> None:
    from ...plot import compared, save
    from ...plot.page import COLOURS

    if len(ranked) > len(COLOURS):
        output.note(f"the figure shows the nearest {len(COLOURS)} of {len(ranked)} materials")
    with output.working("drawing"):
        save(compared(ranked[: len(COLOURS)]), path)


def _numbers(ranked: list[Comparison]) -> dict[str, object]:
    from ...metrics import LIGHT_ANGLES

    numbers = [c.numbers() for c in ranked]
    return {"reference": ranked[0].reference, "light_angles": LIGHT_ANGLES, "comparisons": numbers}


def _print(ranked: list[Comparison]) -> None:
    """All numbers of one comparison; the main ones of several, a line each."""
    if len(ranked) == 1:
        output.print_table(("", f"{ranked[0].reference} → {ranked[0].other}"), ranked[0].rows())
        return
    print(f"{ranked[0].reference}, {output.format_bytes(ranked[0].bytes[0])}, against")
    header = (
        "",
        "PSNR [dB]",
        "least",
        "ΔE2000",
        "95 % <",
        "rel. RMSE",
        "all around",
        "albedo",
        "log relative",
        "bytes",
    )
    lines = [
        (
            c.other, f"{c.psnr:.1f}", f"{c.psnr_min:.1f}", f"{c.delta_e.mean:.3g}", f"{c.delta_e.p95:.3g}",
            f"{c.relative_rmse:.3g}", f"{c.surroundings_rmse:.3g}", f"{c.albedo_difference:.3g}",
            f"{c.metrics['log relative']:.3g}", f"{c.bytes[1]:,}",
        )
        for c in ranked
    ]  # fmt: skip
    output.print_table(header, lines)
