"""`brdf convert`: from one file format or representation to another, with what it costs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from .. import arguments, output

To = Annotated[
    str | None, typer.Option("--to", metavar="KIND", help="Bake first: slices (16 to 256 KB) or table (half vector).")
]
Budget = Annotated[str | None, typer.Option(metavar="SIZE", help="Of the slices: 16K, 64K or 256K. [16K]")]


def command(
    source: arguments.Material,
    out: Annotated[Path, typer.Argument(metavar="OUT", help="File; its extension is the format.")],
    to: To = None,
    budget: Budget = None,
    json: arguments.AsJson = False,
) -> None:
    """Write a material in another file format.

    The file is read back and compared with the source, to say what was lost.

    \b
    Examples:
      brdf convert measured.binary measured.safetensors
      brdf convert measured.bsdf measured.binary
      brdf convert measured.binary small.safetensors --to slices --budget 64K
    """
    convert(source, out, to, budget, json)


def convert(source: str, out: Path, to: str | None, budget: str | None, json: bool) -> None:
    """Convert and print what it cost."""
    from ...conversion import convert

    m = arguments.load(source)
    output.require_writable(out)
    with output.working(f"writing {out.name}"):
        done = convert(m, out, to=to, budget=budget)
    comparison = done.comparison
    if json:
        numbers: dict[str, Any] = {
            "file": str(out),
            "file_bytes": done.file_bytes,
            "bytes": list(comparison.bytes),
            "psnr": comparison.psnr,
            "relative_rmse": comparison.relative_rmse,
            "albedo_difference": comparison.albedo_difference,
            "metrics": comparison.metrics,
        }
        output.print_json(numbers)
        return
    print(out.resolve())
    rows = [("file", output.format_bytes(done.file_bytes)), *comparison.rows()]
    output.print_table(("", f"{comparison.reference} → {out.name}"), rows)
