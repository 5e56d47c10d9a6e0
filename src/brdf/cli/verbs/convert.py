"""`brdf convert`: from one file format or representation to another, with what it costs."""

from __future__ import annotations

from typing import Annotated

import typer

from .. import arguments
from ..baking import Angles, Anisotropic, As, Blend, Budget, Size, Storage, convert, given


def command(
    source: arguments.Material,
    out: Annotated[str, typer.Argument(metavar="OUT", help="File; its extension is the format. Or a folder/.")],
    representation: As = None,
    budget: Budget = None,
    anisotropic: Anisotropic = False,
    angles: Angles = None,
    size: Size = None,
    blend: Blend = None,
    storage: Storage = None,
    format: Annotated[
        str | None,
        typer.Option("--format", metavar="NAME", help="Where an extension has several: zemax-text, mit-csail ..."),
    ] = None,
    json: arguments.AsJson = False,
) -> None:
    """Write a material in another file format.

    What was written is read back and compared with the source, to say what was lost. With --as, or an option of a
    representation, it is baked first. `brdf list formats` tells what is read and written.
    Files of renderers (.mtlx, .gltf, .xml, .pbrt, .py for Blender) are written as by `brdf export`.

    \b
    Examples:
      brdf convert measured.binary measured.safetensors
      brdf convert measured.bsdf measured.binary
      brdf convert merl.fit@chrome chrome.bsdf
      brdf convert measured.bin measured.bsdf --format zemax-text
      brdf convert measured.binary measured.mtlx
      brdf convert measured.binary small.safetensors --as slice-stack --budget 64K
    """
    options = given(budget=budget, anisotropic=anisotropic, angles=angles, size=size, blend=blend, storage=storage)
    convert(arguments.load(source), out, representation, options, json, format)
