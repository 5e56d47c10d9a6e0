"""What several verbs take, declared once."""

from __future__ import annotations

import copy
import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..errors import ParameterError
from . import output

if TYPE_CHECKING:
    from ..reflectance import Reflectance

Material = Annotated[
    str,
    typer.Argument(
        metavar="MATERIAL", help="Name, NAME@FIT, file, or MODEL:alpha=0.2,F0=1/.78/.34 (lobes with +, factors with *)."
    ),
]
CaptureFolder = Annotated[
    Path | None, typer.Option("-o", "--output", help="Folder to make. [NAME-captured, in the current folder]")
]
Overwrite = Annotated[bool, typer.Option("--overwrite", help="Replace an earlier result.")]
AsJson = Annotated[bool, typer.Option("--json", help="Print JSON.")]


def load(spec: str) -> Reflectance:
    """`brdf.load`, imported when it is needed; measurements that are interpolated take seconds to read."""
    from ..loading import is_file, load

    if not is_file(spec.rpartition("@")[0] or spec):
        return load(spec)
    with output.working(f"reading {spec}"):
        return load(spec)


def load_all(specs: Sequence[str]) -> list[Reflectance]:
    """All of them, under names that differ: see `told_apart`."""
    return told_apart([load(spec) for spec in specs], specs)


def told_apart(named: list[Any], specs: Sequence[str]) -> list[Any]:
    """The same; where names are missing or shared (by two fits of one material, say) under what they were made from."""
    if all(m.name for m in named) and len({m.name for m in named}) == len(named):
        return named
    return [copy.copy(m).named(spec) for m, spec in zip(named, specs, strict=True)]


def remark_varying(m: Reflectance) -> None:
    """Says what stands for a material that varies."""
    if m.varies:
        name = m.name or type(m).__name__
        output.note(
            f"{name} varies over the surface; its middle, uv = (0.5, 0.5), is compared, and is what tables hold"
        )


def parse_size(text: str) -> tuple[int, int]:
    """`800x600` -> (800, 600). Raises ParameterError."""
    match = re.fullmatch(r"\s*(\d{1,6})\s*[x×]\s*(\d{1,6})\s*", text)
    if match is None or min(int(match[1]), int(match[2])) < 1:
        raise ParameterError(f"--size must be WIDTHxHEIGHT in pixels, both at least 1, as in 800x600; got {text!r}")
    return int(match[1]), int(match[2])


def file_name(spec: str, m: Any, ending: str) -> Path:
    """A file in the current folder named after what was given."""
    return named_file(given_name(spec, m), ending)


def given_name(spec: str, m: Any) -> str:
    """A file's or folder's stem, else the name of what was made of the description."""
    from ..loading import is_file

    return Path(spec).resolve().stem if is_file(spec) else m.name or type(m).__name__


def named_file(name: str, ending: str) -> Path:
    """A file in the current folder of that name, without what file systems or shells stumble over."""
    stem = re.sub(r"[^\w.@-]+", "-", name).strip("-.") or "material"
    return Path(f"{stem[:80]}{ending}")
