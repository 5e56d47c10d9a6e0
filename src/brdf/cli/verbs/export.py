"""`brdf export`: a material as a shader for other programs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .. import arguments, output
from ..baking import Anisotropic, As, Budget, given


def command(
    material: arguments.Material,
    out: Annotated[Path, typer.Argument(metavar="OUT", help="Shader, .glsl or .wgsl.")],
    function: Annotated[str | None, typer.Option(metavar="NAME", help="Name of the function. [brdf_MATERIAL]")] = None,
    representation: As = None,
    budget: Budget = None,
    anisotropic: Anisotropic = False,
    json: arguments.AsJson = False,
) -> None:
    """Write a material as a shader: a function of two directions in GLSL or WGSL.

    Beside OUT go OUT.json, the values of its parameters and what its textures are, and OUT.bin, their texels. A comment
    in the shader shows its use. With --as or --budget the material is baked first, which measured ones without a
    formula need.

    \b
    Examples:
      brdf export GGX:alpha=0.2,F0=1/.78/.34 gold.glsl
      brdf export measured.binary measured.wgsl
      brdf export measured.bsdf measured.glsl --as slice-stack --budget 64K
    """
    from ...conversion import bake
    from ...export import export, language_of

    m = arguments.load(material)
    options = given(budget=budget, anisotropic=anisotropic)
    language_of(out)
    output.require_writable(out)
    if representation or options:
        with output.working("baking"):
            m = bake(m, representation, **options)
    done = export(m, out, function)
    sizes = {str(path): path.stat().st_size for path in done.files}
    if json:
        output.print_json({"function": done.function, "files": sizes})
        return
    print(done.files[0].resolve())
    rows = [(path, output.format_bytes(size)) for path, size in sizes.items()]
    output.print_table(("", done.function), rows)
