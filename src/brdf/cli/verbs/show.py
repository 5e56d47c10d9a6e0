"""`brdf show`: figures of a material, of several, or of a profile of subsurface scattering."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from .. import arguments, output

if TYPE_CHECKING:
    from ...reflectance import Reflectance


class What(StrEnum):
    """Which figure."""

    all = "all"
    lobes = "lobes"
    cartesian = "cartesian"
    solid = "solid"
    slices = "slices"
    albedo = "albedo"
    fresnel = "fresnel"
    spheres = "spheres"
    whiteout = "whiteout"


SINGLE = (What.solid, What.slices, What.whiteout)
"""Figures of one material alone."""


def command(
    materials: Annotated[
        list[str],
        typer.Argument(
            metavar="MATERIAL...", help="Materials to lay over each other, or profiles as burley:A=.8 and dipole."
        ),
    ],
    out: Annotated[
        Path | None, typer.Option("-o", "--output", help="Figure: .png, .svg, .html, .pdf. [NAME-figure.png]")
    ] = None,
    what: Annotated[What, typer.Option(metavar="FIGURE", help=", ".join(What))] = What.all,
) -> None:
    """Plot lobes, slices, albedo and more.

    The lobes in the plane of incidence, a slice over half and difference angle, the directional albedo; with --what
    one figure alone. Several materials are laid over each other. A profile of subsurface scattering is drawn over the
    distance.

    \b
    Examples:
      brdf show gold-metallic-paint
      brdf show GGX:alpha_x=0.1,alpha_y=0.4 --what lobes -o lobes.pdf
      brdf show chrome steel --what albedo -o metals.html
      brdf show burley:A=.9/.6/.3,length=2 dipole
    """
    from ...errors import ParameterError
    from ...loading import load_profile, names_profile
    from ...plot import save

    drawn: list[Any]
    profiles = [names_profile(spec) for spec in materials]
    if any(profiles) and (not all(profiles) or what is not What.all):
        raise ParameterError(
            "profiles of subsurface scattering have a figure of their own; show them without materials or --what"
        )
    drawn = [
        load_profile(spec) if is_profile else arguments.load(spec)
        for spec, is_profile in zip(materials, profiles, strict=True)
    ]
    drawn = arguments.told_apart(drawn, materials)
    if len(drawn) > 1 and what in SINGLE:
        raise ParameterError(f"--what {what} shows one material, {len(drawn)} were given")
    path = out or arguments.file_name(materials[0], drawn[0], "-figure.png")
    output.require_writable(path)
    with output.working("drawing"):
        save(_figure(drawn, what, any(profiles)), path)
    print(path.resolve())


def _figure(drawn: list[Any], what: What, profiles: bool) -> Any:
    from ... import plot

    if profiles:
        return plot.profile(drawn)
    draw: Any = {What.all: plot.overview, What.whiteout: plot.white_out}.get(what) or getattr(plot, what)
    given: Reflectance | list[Reflectance] = drawn[0] if len(drawn) == 1 else drawn
    return draw(given)
