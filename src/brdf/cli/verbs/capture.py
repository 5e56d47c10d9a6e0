"""`brdf capture`: materials from photographs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .. import arguments, capture_flat, output

group = typer.Typer(rich_markup_mode=None, context_settings={"help_option_names": ["-h", "--help"]})


@group.callback()
def _group() -> None:
    """Make a material from photographs.

    \b
    Examples:
      brdf capture sphere photographs/
      brdf capture flat photographs/
      brdf capture simulate leather
    """


@group.command("sphere")
def sphere(
    folder: Annotated[Path, typer.Argument(metavar="FOLDER", help="Photographs of a ball, and its lights.")],
    out: arguments.CaptureFolder = None,
    overwrite: arguments.Overwrite = False,
    lights: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Directions, a line x y z a photograph. [light_directions.txt]")
    ] = None,
    intensities: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Intensities, r g b a photograph. [light_intensities.txt]")
    ] = None,
    mask: Annotated[Path | None, typer.Option(metavar="FILE", help="Picture, white on the ball. [*mask*]")] = None,
    dark: Annotated[Path | None, typer.Option(metavar="FILE", help="Picture with the lights off. [*dark*]")] = None,
    response: Annotated[
        str | None, typer.Option(metavar="CURVE", help="linear, srgb or a gamma. [8 bits: srgb or linear, else linear]")
    ] = None,
    albedo: Annotated[float | None, typer.Option(help="Diffuse albedo of the ball, sets the scale. [0.5]")] = None,
    white: Annotated[
        float | None,
        typer.Option(help="Sets the scale: the number, 0 to 1 and linear, that white paper shows."),
    ] = None,
    size: Annotated[int | None, typer.Option(help="Texels across a sphere image. [the ball's diameter]")] = None,
    angles: Annotated[
        str | None, typer.Option(metavar="DEGREES", help="Of the sphere images, as 0,30,60. [from the lights]")
    ] = None,
    budget: Annotated[str, typer.Option(metavar="SIZE", help="Of the slice stack.")] = "16K",
    hold_out: Annotated[
        int | None, typer.Option("--hold-out", metavar="K", help="Leave every K-th photograph out and predict it.")
    ] = None,
    json: arguments.AsJson = False,
) -> None:
    """A ball photographed by a fixed camera, one light a photograph.

    Writes a folder with sphere images, a slice stack, a report and a picture of what was seen. The folder of the
    photographs holds light_directions.txt or lights.txt: x to the right, y up, z to the camera. With --hold-out the
    report says how well photographs that took no part are predicted, beside the published way and a fitted model.

    \b
    Examples:
      brdf capture sphere photographs/
      brdf capture sphere photographs/ --hold-out 4 --response linear -o ball
      brdf capture sphere photographs/ --lights dome.txt --mask ball.png --dark off.tif --budget 64K
    """
    from ... import plot
    from ...capture import sphere as capture
    from ...capture.ball.captured import STACK
    from ...capture.folders import require_free

    target = out or Path(f"{folder.resolve().name}-captured")
    require_free(target, STACK, overwrite)
    with output.working(f"reading {folder}") as tell:
        done = capture(
            folder, lights=lights, intensities=intensities, mask=mask, dark=dark, response=response, albedo=albedo,
            white=white, size=size, angles=_angles(angles), budget=budget, holdout=hold_out, progress=tell,
        )  # fmt: skip
        tell("writing")
        done.save(
            target,
            overwrite=overwrite,
            also=lambda place: plot.save(plot.coverage(done.coverage), place / "coverage.png"),
        )
    for warning in done.warnings:
        output.note(f"warning: {warning}")
    if json:
        output.print_json({"folder": str(target.resolve()), **done.numbers()})
        return
    print(done.report, end="")
    print(target.resolve())


def _angles(text: str | None) -> list[float] | None:
    from ...errors import ParameterError

    if text is None:
        return None
    try:
        return [float(part) for part in text.split(",")]
    except ValueError:
        raise ParameterError(f"--angles must be degrees between commas, as 0,30,60; got {text!r}") from None


group.command("flat")(capture_flat.flat)
group.command("simulate")(capture_flat.simulate)
