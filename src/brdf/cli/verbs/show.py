"""`brdf show`: figures of a material."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from .. import arguments, output


class What(StrEnum):
    """Which figure."""

    all = "all"
    lobes = "lobes"
    slices = "slices"
    albedo = "albedo"


def command(
    material: arguments.Material,
    out: Annotated[
        Path | None, typer.Option("-o", "--output", help="Figure: .png, .pdf, .svg. [NAME-figure.png]")
    ] = None,
    what: Annotated[What, typer.Option(metavar="FIGURE", help="all, lobes, slices or albedo.")] = What.all,
) -> None:
    """Plot lobes, slices and albedo.

    The lobes in the plane of incidence, a slice over half and difference angle, the directional albedo.

    \b
    Examples:
      brdf show gold-metallic-paint
      brdf show GGX:alpha_x=0.1,alpha_y=0.4 --what lobes -o lobes.pdf
    """
    from ... import plot
    from ...container import replacing
    from ...errors import UnknownFormatError

    m = arguments.load(material)
    path = out or arguments.file_name(m, "-figure.png")
    output.require_writable(path)
    with output.working("drawing"):
        figure = plot.overview(m) if what is What.all else getattr(plot, what)(m)
        known = sorted(figure.canvas.get_supported_filetypes())
        if path.suffix.lower()[1:] not in known:
            raise UnknownFormatError(path, f"figures are written as {', '.join('.' + k for k in known)}; choose one.")
        with replacing(path) as temporary:
            figure.savefig(temporary)
    print(path.resolve())
