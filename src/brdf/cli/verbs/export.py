"""`brdf export`: a material as a shader for other programs, or as a page for a browser."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .. import arguments, output, scene
from ..baking import Anisotropic, As, Budget, exported, given


def command(
    materials: Annotated[
        list[str],
        typer.Argument(metavar="MATERIAL...", help="One; for a page, several to compare. As for other verbs."),
    ],
    out: Annotated[Path, typer.Argument(metavar="OUT", help="Shader .glsl or .wgsl, page .html, or for a renderer.")],
    function: Annotated[
        str | None, typer.Option(metavar="NAME", help="Name of a shader's function. [brdf_MATERIAL]")
    ] = None,
    representation: As = None,
    budget: Budget = None,
    anisotropic: Anisotropic = False,
    mesh: scene.Mesh = "teapot",
    light: scene.Light = None,
    env: scene.Env = None,
    exposure: scene.Exposure = 0.0,
    tone: scene.Tone = "filmic",
    no_shadows: scene.NoShadows = False,
    json: arguments.AsJson = False,
) -> None:
    """Write a material as a shader, or materials as a page to turn them in.

    A shader is a function of two directions in GLSL or WGSL. Beside OUT go OUT.json, the values of its parameters and
    what its textures are, and OUT.bin, their texels; a comment in the shader shows its use. A page is one file that
    needs no other and no network; --mesh, --light, --env, --exposure, --tone and --no-shadows are how it starts.
    For renderers: .xml (Mitsuba 3), .pbrt (pbrt-v4), .mtlx (MaterialX with OpenPBR), .gltf, .py (a script for Blender);
    how far what is written is from the material is printed.
    With --as or --budget the material is baked first, which shaders of measured ones without a formula need.

    \b
    Examples:
      brdf export GGX:alpha=0.2,F0=1/.78/.34 gold.glsl
      brdf export measured.bsdf measured.wgsl --as slice-stack --budget 64K
      brdf export measured.binary baked.safetensors compared.html --mesh sphere
      brdf export measured.binary measured.mtlx
    """
    from ...conversion import bake
    from ...export import export, format_of

    options = given(budget=budget, anisotropic=anisotropic)
    start = scene.given(mesh, light, env, exposure, tone, no_shadows)
    format_of(out)
    shown = arguments.load_all(materials) if len(materials) > 1 else [arguments.load(materials[0])]
    output.require_writable(out)
    if representation or options:
        with output.working("baking"):
            shown = [bake(m, representation, **options) for m in shown]
    with output.working(f"writing {out.name}"):
        done = export(shown, out, function, **start)
    exported(shown[0], out, done, json)
