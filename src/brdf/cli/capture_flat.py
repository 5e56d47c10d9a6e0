"""`brdf capture flat` and `brdf capture simulate`: pictures of a flat sample, and a shading map of them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from . import arguments, output

if TYPE_CHECKING:
    from ..capture import FlatSample
    from ..reflectance import Reflectance

Size = Annotated[int, typer.Option(help="Pixels across the pictures.")]
Under = Annotated[
    str | None,
    typer.Option("--brdf", metavar="MATERIAL", help="What the map is looked up with. [the sample's average]"),
]
Compress = Annotated[int | None, typer.Option(metavar="BYTES", help="Bytes a texel of the map, 1 to 6. [no loss]")]
Tileable = Annotated[bool, typer.Option("--tileable", help="Make the map continue at its opposite edges.")]


def flat(
    folder: Annotated[Path, typer.Argument(metavar="FOLDER", help="Photographs of a flat sample, and angles.txt.")],
    out: arguments.CaptureFolder = None,
    overwrite: arguments.Overwrite = False,
    angles: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Lines [FILE] ANGLE [SECONDS], or an .lp file. [angles.txt]"),
    ] = None,
    dark: Annotated[Path | None, typer.Option(metavar="FILE", help="Picture with the lamp off. [*dark*]")] = None,
    white: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Picture of a white diffuser instead of the sample. [*white*]")
    ] = None,
    response: Annotated[
        str | None,
        typer.Option(metavar="CURVE", help="linear, srgb, a gamma, brackets. [8 bits: srgb, else linear]"),
    ] = None,
    corners: Annotated[
        str | None, typer.Option(metavar="MARKS", help='Four pixels "x,y x,y x,y x,y", clockwise from the top left.')
    ] = None,
    crop: Annotated[int, typer.Option(help="Pixels across the part of the photographs that is kept.")] = 1024,
    size: Annotated[
        int,
        typer.Option(min=1, max=4096, help="Pixels across the map; above --crop it is grown by synthesis, and tiles."),
    ] = 512,
    albedo: Annotated[float | None, typer.Option(help="Albedo of the sample, sets the scale. [0.5]")] = None,
    brdf: Under = None,
    compress: Compress = None,
    tileable: Tileable = False,
    json: arguments.AsJson = False,
) -> None:
    """A flat sample photographed from above by a fixed camera, the lamp on an arc.

    Writes a folder with linear pictures, a shading map, a contact sheet and a report. Angles are measured from the
    sample's normal. Several photographs under one lamp are exposures of a bracket. Of lamps all over a dome (.lp) those
    on one arc are taken.

    \b
    Examples:
      brdf capture flat photographs/
      brdf capture flat photographs/ --corners "212,80 1540,96 1522,1410 198,1390" --compress 6 --tileable
      brdf capture flat photographs/ --size 2048
      brdf capture flat dome/ --angles dome/dirs.lp --white white.tif --brdf GGX:alpha=0.3
    """
    from ..capture import flat as capture
    from ..capture.flat_sample.capture import SIZE

    grown = size if size > crop else None
    target, reflectance = _flat_target(out, folder.resolve().name, overwrite), _under(brdf)
    marks = None if corners is None else _corners(corners)
    with output.working(f"reading {folder}") as tell:
        done = capture(
            folder, angles=angles, dark=dark, white=white, response=response, corners=marks, crop=crop,
            size=size if grown is None else min(SIZE, crop), albedo=albedo, progress=tell,
        )  # fmt: skip
        _save_flat(done, target, overwrite, reflectance, compress, tileable, tell, grown)
    _say_flat(done, target, json)


def simulate(
    material: Annotated[str, typer.Argument(metavar="NAME", help="jeans, suede, leather, stone …")],
    out: arguments.CaptureFolder = None,
    overwrite: arguments.Overwrite = False,
    size: Size = 512,
    seed: Annotated[int, typer.Option(help="The same seed gives the same sample.")] = 0,
    brdf: Under = None,
    compress: Compress = None,
    tileable: Tileable = False,
    json: arguments.AsJson = False,
) -> None:
    """A flat sample that needs no camera: a relief with shadows, as `flat` would have photographed it.

    \b
    Examples:
      brdf capture simulate leather
      brdf capture simulate "pressed wood" --size 256 --seed 3 -o wood
    """
    from ..capture import simulate as make

    target, reflectance = _flat_target(out, material.replace(" ", "-"), overwrite), _under(brdf)
    with output.working(f"simulating {material}") as tell:
        done = make(material, size=size, seed=seed, progress=tell)
        _save_flat(done, target, overwrite, reflectance, compress, tileable, tell)
    _say_flat(done, target, json)


def _flat_target(out: Path | None, name: str, overwrite: bool) -> Path:
    from ..capture.flat_sample.sample import PICTURES
    from ..capture.folders import require_free

    target = out or Path(f"{name}-captured")
    require_free(target, PICTURES, overwrite)
    return target


def _under(brdf: str | None) -> Reflectance | None:
    return None if brdf is None else arguments.load(brdf)


def _save_flat(
    done: FlatSample, target: Path, overwrite: bool, brdf: Reflectance | None, compress: int | None, tileable: bool,
    tell: Callable[[str], None], grown: int | None = None,
) -> None:  # fmt: skip
    tell("making the shading map")
    made = done.shading_map(brdf)
    if grown is not None:
        tell(f"growing it to {grown} x {grown}")
        made = made.synthesise(grown)
    elif tileable:
        made = made.tileable()
    if compress is not None:
        made = made.compress(compress)
    tell("writing")
    done.save(target, made.named(done.name, done.source), overwrite=overwrite)


def _say_flat(done: FlatSample, target: Path, json: bool) -> None:
    for warning in done.warnings:
        output.note(f"warning: {warning}")
    if json:
        output.print_json({"folder": str(target.resolve()), **done.numbers()})
        return
    print(done.report, end="")
    print(target.resolve())


def _corners(text: str) -> list[list[float]]:
    from ..errors import ParameterError

    try:
        marks = [[float(number) for number in mark.split(",")] for mark in text.split()]
    except ValueError:
        marks = []
    if len(marks) != 4 or any(len(mark) != 2 for mark in marks):
        raise ParameterError(f'--corners must be four pixels, as "212,80 1540,96 1522,1410 198,1390"; got {text!r}')
    return marks
