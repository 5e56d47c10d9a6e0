"""`brdf list`: what there is, by name."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated

import typer

from .. import output


class Kind(StrEnum):
    """What can be listed."""

    models = "models"
    materials = "materials"
    meshes = "meshes"
    formats = "formats"


def command(
    kind: Annotated[Kind, typer.Argument(metavar="KIND", help="models, materials, meshes or formats")],
    json: Annotated[bool, typer.Option("--json", help="A plain JSON list of names.")] = False,
) -> None:
    """List models, materials, meshes or formats.

    \b
    Examples:
      brdf list materials
      brdf list models --json
    """
    lines = _LINES[kind]()
    if json:
        output.print_json([name for name, *_ in lines])
    else:
        width = max(len(name) for name, _ in lines)
        for name, doc in lines:
            print(f"{name.ljust(width)}  {doc}".rstrip())


def _models() -> list[tuple[str, str]]:
    from ... import models

    found = {name: models.get(name) for name in models.names()} | models.WRAPPERS
    return [(name, _first_line(found[name].__doc__)) for name in sorted(found)]


def _materials() -> list[tuple[str, str]]:
    from ... import materials

    def fits(name: str) -> str:
        known = materials.fits(name)
        more = f" and {len(known) - 2} more: brdf info {name}" if len(known) > 3 else ""
        return ", ".join(f"@{fit}" for fit in (known[:2] if more else known)) + more

    return [(name, fits(name)) for name in materials.names()]


def _meshes() -> list[tuple[str, str]]:
    from ...render import mesh

    return [(name, "") for name in mesh.BUILT_IN]


def _formats() -> list[tuple[str, str]]:
    from ... import io

    return [
        (f.name, f"{' '.join(f.extensions)}  {'r' if f.reads else '-'}{'w' if f.writes else '-'}  {f.doc}")
        for f in io.formats()
    ]


def _first_line(doc: str | None) -> str:
    return (doc or "").strip().split("\n")[0]


_LINES = {Kind.models: _models, Kind.materials: _materials, Kind.meshes: _meshes, Kind.formats: _formats}
