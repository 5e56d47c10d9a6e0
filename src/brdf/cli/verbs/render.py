"""`brdf render`: a picture of a material on a mesh, by default beside its 16 KB representation."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from .. import arguments, output, scene

if TYPE_CHECKING:
    from ...reflectance import Reflectance

ALBEDO_ANGLE = 45.0
"""Degrees from the normal at which the printed albedos are taken."""


def command(
    material: arguments.Material,
    out: Annotated[Path | None, typer.Option("-o", "--output", help="Picture, .png or .exr. [NAME.png]")] = None,
    mesh: scene.Mesh = "teapot",
    light: scene.Light = None,
    env: scene.Env = None,
    size: Annotated[str, typer.Option(metavar="WxH", help="Pixels.")] = "800x600",
    compare: Annotated[
        str | None, typer.Option(metavar="MATERIAL", help="Right half; by default a 16 KB slice stack.")
    ] = None,
    no_compare: Annotated[bool, typer.Option("--no-compare", help="The material alone, no second half.")] = False,
    samples: Annotated[int, typer.Option(help="Directions to the environment per pixel.")] = 16,
    supersampling: Annotated[int, typer.Option(metavar="N", help="N x N rays per pixel.")] = 2,
    exposure: scene.Exposure = 0.0,
    tone: scene.Tone = "filmic",
    background: Annotated[str, typer.Option(help="gradient, environment, transparent, or R/G/B.")] = "gradient",
    no_shadows: scene.NoShadows = False,
    seed: Annotated[int, typer.Option(help="The same seed gives the same picture.")] = 0,
    backend: Annotated[
        str, typer.Option(help="cpu, or gl: a graphics card, or OpenGL's software driver (needs brdf[gl]).")
    ] = "cpu",
    json: arguments.AsJson = False,
) -> None:
    """Render a material.

    Left half: the material. Right half: its 16 KB slice stack, or what --compare names. Below: what the right one
    costs and how far it is from the left one. What no slice stack can hold (anisotropic materials, those that vary
    over the surface) is drawn alone, and so is a table that is that small already.

    \b
    Examples:
      brdf render gold-metallic-paint
      brdf render GGX:alpha=0.2,F0=1/.78/.34 --mesh sphere --light directional:theta=40 -o ggx.png
      brdf render measured.binary --compare fitted.safetensors --size 1200x800
      brdf render metal/gold --mesh bunny.ply --env studio --backend gl --tone neutral
    """
    from ...errors import ParameterError
    from ...render import captioned, render, render_halves

    if compare is not None and no_compare:
        raise ParameterError("--compare and --no-compare exclude each other; give one of them")
    pixels = arguments.parse_size(size)
    m = arguments.load(material)
    path = out or arguments.file_name(material, m, ".png")
    _require_picture(path)
    other: Reflectance | None = None
    label = ""
    if compare is not None:
        other = arguments.load(compare)
    elif not no_compare:
        other, label = _stack(m)
    options: dict[str, Any] = {
        "mesh": mesh,
        "lights": light,
        "env": scene.number_or_text(env),
        "size": pixels,
        "samples": samples,
        "supersampling": supersampling,
        "shadows": not no_shadows,
        "background": _colour_or_text(background),
        "seed": seed,
        "backend": _available(backend),
    }
    if other is None:
        render(m, **options).save(path, tone=tone, exposure=exposure)
        if label:
            output.note(label)  # once it is true
        numbers: dict[str, Any] = {"material": m.name, "bytes": m.nbytes}
    else:
        image = render_halves(m, other, **options)
        numbers = _numbers(m, other, label)
        captioned(image, _caption(numbers), numbers["material"]).save(path, tone=tone, exposure=exposure)
    if json:
        output.print_json(numbers | {"file": str(path)})
        return
    if other is not None:
        _print_table(numbers)
    print(path.resolve())


def _stack(m: Reflectance) -> tuple[Reflectance | None, str]:
    """The material's slice stack and what to call it; none and why, or "" where none is needed."""
    from ...conversion import bake
    from ...representations.baking.slice_stack import SliceStack
    from ...representations.tables.table import Table

    kinds = {
        "transmits": m.transmits, "mirrors": m.has_delta, "varies over the surface": m.varies,
        "is anisotropic": not m.isotropic,
    }  # fmt: skip
    kind = next((name for name, applies in kinds.items() if applies), "")
    if kind:
        return None, f"{m.name or type(m).__name__} {kind}, which a slice stack cannot hold; it is drawn alone"
    if isinstance(m, Table) and m.layout in SliceStack.layouts():
        return None, ""
    with output.working("baking the slice stack"):
        return bake(m), "16 KB slice stack"


def _numbers(m: Reflectance, other: Reflectance, label: str) -> dict[str, Any]:
    """What the two cost and how far they are apart; pairs are (left, right)."""
    from ...metrics import compare, directional_albedo

    comparison = compare(m, other)
    return {
        "material": (comparison.reference, label or comparison.other),
        "bytes": list(comparison.bytes),
        "albedo_angle": ALBEDO_ANGLE,
        "albedo": [directional_albedo(x, ALBEDO_ANGLE).tolist() for x in (m, other)],
        "albedo_difference": comparison.albedo_difference,
        "psnr": comparison.psnr,
        "relative_rmse": comparison.relative_rmse,
    }


def _caption(numbers: dict[str, Any]) -> str:
    """The line under the picture."""
    left, right = (f"{count:,} bytes" for count in numbers["bytes"])
    distance = f"PSNR {numbers['psnr']:.1f} dB, albedo within {numbers['albedo_difference']:.1g}"
    return f"{left}  |  {right}, {distance}"


def _print_table(numbers: dict[str, Any]) -> None:
    rows = [
        ("memory", *(output.format_bytes(count) for count in numbers["bytes"])),
        (f"albedo at {ALBEDO_ANGLE:g}°, RGB", *(" ".join(f"{v:.4f}" for v in a) for a in numbers["albedo"])),
        ("albedo difference, at most", "", f"{numbers['albedo_difference']:.2g}"),
        ("PSNR on a lit sphere", "", f"{numbers['psnr']:.1f} dB"),
        ("relative RMSE on it", "", f"{numbers['relative_rmse']:.3g}"),
    ]
    output.print_table(("", *numbers["material"]), rows)


def _require_picture(path: Path) -> None:
    """Fails before the work: see `output.require_writable`. Raises UnknownFormatError, FileError."""
    from ...errors import UnknownFormatError
    from ...render.image import WRITERS

    if path.suffix.lower() not in WRITERS:
        raise UnknownFormatError(path, f"pictures are written as {' or '.join(WRITERS)}; choose one of them.")
    output.require_writable(path)


def _available(backend: str) -> str:
    """The same, or "cpu" and a note where "gl" has no driver."""
    from ...errors import DriverError

    if backend == "gl":
        from ...render.gl import card

        try:
            card()
        except DriverError as error:
            output.note(f"{error}; the CPU draws instead")
            return "cpu"
    return backend


def _colour_or_text(text: str) -> str | tuple[float, ...]:
    try:
        return tuple(float(part) for part in text.split("/"))
    except ValueError:
        return text
