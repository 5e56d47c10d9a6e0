"""`brdf bake`: a compact representation of a material."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .. import arguments
from .convert import Budget, convert


def command(
    material: arguments.Material,
    out: Annotated[
        Path | None, typer.Option("-o", "--output", help="File, .safetensors. [NAME-slices.safetensors]")
    ] = None,
    to: Annotated[str, typer.Option("--to", metavar="KIND", help="slices or table.")] = "slices",
    budget: Budget = None,
    json: arguments.AsJson = False,
) -> None:
    """Make a compact representation of a material.

    By default a slice stack of 16 KB.

    \b
    Examples:
      brdf bake gold-metallic-paint
      brdf bake measured.binary --budget 64K -o small.safetensors
    """
    path = out or arguments.file_name(arguments.load(material), f"-{to}.safetensors")
    convert(material, path, to, budget, json)
