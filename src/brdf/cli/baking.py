"""What `bake` and `convert` share: the options of the representations, and telling what one costs."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..errors import FileError, ParameterError
from . import arguments, output

if TYPE_CHECKING:
    from ..export import Exported
    from ..reflectance import Reflectance

As = Annotated[
    str | None,
    typer.Option(
        "--as",
        metavar="KIND",
        help="slice-stack (16 KB and up), sphere-images (pictures of a sphere) or table (half vector).",
    ),
]
Budget = Annotated[
    str | None, typer.Option(metavar="BYTES", help="Of a slice stack or a table, at most: 16K, 24576, 1M. [16K]")
]
Anisotropic = Annotated[
    bool, typer.Option("--anisotropic", help="A slice stack with one more axis, of many times the size.")
]
Angles = Annotated[
    str | None,
    typer.Option(metavar="ANGLES", help="Of sphere images, light from viewer: plastic, metal or 0,30,60. [plastic]"),
]
Size = Annotated[int | None, typer.Option(metavar="PIXELS", help="Of sphere images. [512]")]
Blend = Annotated[
    str | None,
    typer.Option(metavar="RULE", help="Of sphere images: separated, monotone, paper, half or full. [separated]"),
]
Storage = Annotated[str | None, typer.Option(metavar="KIND", help="Numbers of sphere images or a table. [half]")]


def given(**options: Any) -> dict[str, Any]:
    """The options that were given, angles as numbers or a name."""
    found = {name: value for name, value in options.items() if value is not None and value is not False}
    if "angles" in found:
        found["angles"] = _angles(found["angles"])
    return found


def _angles(text: str) -> str | tuple[float, ...]:
    """`0,30,60` -> (0.0, 30.0, 60.0); a name stays a name. Raises ParameterError."""
    if text.strip().isalpha():
        return text.strip()
    try:
        numbers = tuple(float(part) for part in text.split(","))
    except ValueError:
        numbers = (math.nan,)
    if not all(map(math.isfinite, numbers)):
        raise ParameterError(f"--angles must be plastic, metal or degrees with commas, as in 0,30,60; got {text!r}")
    return numbers


def representation_for(representation: str | None, options: Mapping[str, Any]) -> str:
    """The one that was named, or that the options tell."""
    from ..conversion import options_of, representation_for

    chosen = representation or representation_for(options)
    options_of(chosen)  # an unknown name is refused before a file is named after it
    return chosen


def convert(
    m: Reflectance,
    out: str,
    representation: str | None,
    options: Mapping[str, Any],
    json: bool,
    format: str | None = None,
) -> None:
    """Convert and print what it cost: to a file or, where it is one already or ends in a slash, a folder."""
    from ..conversion import bake, convert
    from ..export import export
    from ..export.target import targets

    if format is None and Path(out).suffix.lower() in targets():
        output.require_writable(out)
        with output.working(f"writing {Path(out).name}"):
            done = export(bake(m, representation, **options) if representation or options else m, out)
        exported(m, Path(out), done, json)
        return

    _require_place(m, out, representation)
    arguments.remark_varying(m)
    place = Path(out)
    with output.working(f"writing {place.name}"):
        made = convert(m, out, representation, format, **options)
    comparison = made.comparison
    if json:
        output.print_json({"file": out, "file_bytes": made.file_bytes} | comparison.numbers())
        return
    print(place.resolve())
    rows = [("file", output.format_bytes(made.file_bytes)), *comparison.rows()]
    output.print_table(("", f"{comparison.reference} → {place.name}"), rows)


def exported(m: Reflectance, out: Path, done: Exported, json: bool) -> None:
    """Print what an export wrote and, where that is not exactly `m`, how far it is from it."""
    from ..metrics import compare

    sizes = {str(path): path.stat().st_size for path in done.files}
    compared = None if done.stands_for is None else compare(m, done.stands_for)
    if json:
        named = {"function": done.function} if done.function else {}
        output.print_json(named | {"files": sizes} | ({} if compared is None else compared.numbers()))
        return
    print(done.files[0].resolve())
    rows = [(path, output.format_bytes(size)) for path, size in sizes.items()]
    output.print_table(("", done.function or out.suffix.lstrip(".")), rows)
    if compared is not None:
        output.print_table(("", f"{compared.reference} → {out.name}"), compared.rows())


def _require_place(m: Reflectance, out: str, representation: str | None) -> None:
    """Fails before the work. Raises FileError for what cannot be written, or not as a folder."""
    from ..representations.spheres.sphere_images import SphereImages

    if not out.endswith(("/", os.sep)) and not os.path.isdir(out):
        output.require_writable(out)
    elif representation != "sphere-images" and (representation or not isinstance(m, SphereImages)):
        raise FileError(out, "is a folder; sphere-images alone are written as one, give a file name.")
