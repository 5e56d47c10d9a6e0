"""`brdf bake`: a compact representation of a material."""

from __future__ import annotations

from typing import Annotated

import typer

from .. import arguments
from ..baking import Angles, Anisotropic, As, Blend, Budget, Size, Storage, convert, given, representation_for


def command(
    material: arguments.Material,
    out: Annotated[
        str | None,
        typer.Option(
            "-o",
            "--output",
            metavar="PATH",
            help="A .safetensors file; for sphere images also folder/, .png, .exr. [NAME-KIND.safetensors]",
        ),
    ] = None,
    representation: As = None,
    budget: Budget = None,
    anisotropic: Anisotropic = False,
    angles: Angles = None,
    size: Size = None,
    blend: Blend = None,
    storage: Storage = None,
    json: arguments.AsJson = False,
) -> None:
    """Make a compact representation of a material.

    By default a slice stack of 16 KB. Prints what it costs, beside the material's own size, and how far it is from it.

    \b
    Examples:
      brdf bake gold-metallic-paint
      brdf bake measured.binary --budget 64K -o small.safetensors
      brdf bake GGX:alpha_x=.1,alpha_y=.4 --anisotropic
      brdf bake gold-metallic-paint --as sphere-images --angles metal
      brdf bake gold-metallic-paint --as sphere-images --angles 0,60,120 -o gold/
    """
    options = given(budget=budget, anisotropic=anisotropic, angles=angles, size=size, blend=blend, storage=storage)
    m = arguments.load(material)
    chosen = representation_for(representation, options)
    convert(m, out or str(arguments.file_name(material, m, f"-{chosen}.safetensors")), chosen, options, json)
