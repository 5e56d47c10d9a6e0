"""`export`: what the extension asks for."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from ..container import replacing
from ..errors import ParameterError, UnknownFormatError
from ..reflectance import Reflectance
from ..shaders import LANGUAGES
from .shaders import write_shader
from .target import targets

PAGE = ".html"


class Exported(NamedTuple):
    """What `export` wrote."""

    function: str
    """Name of the function in the shader; of a page ""."""
    files: tuple[Path, ...]
    """The shader, its description and textures; or the page; or a renderer's file and what it reads."""
    stands_for: Reflectance | None = None
    """What a renderer's file describes, where that is not exactly what was given."""


def export(
    m: Reflectance | Sequence[Reflectance], path: str | os.PathLike[str], function: str | None = None, **start: Any
) -> Exported:
    """Write `m` as a shader: `.glsl` (GLSL ES 3.00 and GLSL 3.30, without a `#version` line) or `.wgsl`; or it, or
    several to compare, as a page to turn them in: `.html`, one file that needs no other and no network; or for a
    renderer: `.xml` (Mitsuba 3), `.pbrt` (pbrt-v4), `.mtlx` (MaterialX), `.gltf`, `.py` (a script for Blender).

    A shader's function, `brdf_NAME(wi, wo)` unless `function` names it, gives f [1/sr] without the cosine, zero below
    the horizon; its comment says how to use it. Beside PATH go PATH.json, the parameters' values and what the textures
    are, and, if there are textures, PATH.bin, their texels one after the other. `start` is how a page starts: `mesh`,
    `lights`, `env`, `exposure`, `tone` and `shadows` as in `brdf.render` and `Image.save`.
    Raises UnknownFormatError for another extension; ReflectanceError for what has no formula (bake it first; pages do
    so themselves), or too large textures or too many; ParameterError for a function name that is none, or an option of
    the other kind; FormulaError or ParameterError for numbers beyond single precision; SceneError, FileError.
    """
    place = Path(path)
    kind = format_of(place)
    shown = [m] if isinstance(m, Reflectance) else list(m)
    if kind == PAGE:
        if function is not None:
            raise ParameterError("a page has no function to name; 'function' belongs to .glsl and .wgsl")
        return Exported("", (_write_page(shown, place, start),))
    if start:
        raise ParameterError(f"{min(start)!r} is how a page starts and has no effect with {kind}")
    if len(shown) != 1:
        what = "a shader" if kind in LANGUAGES else "a renderer's file"
        raise ParameterError(f"{what} is written of one reflectance, got {len(shown)}; a page, .html, takes several")
    if kind in targets():
        if function is not None:
            raise ParameterError(f"{kind} has no function to name; 'function' belongs to .glsl and .wgsl")
        written = targets()[kind].write(shown[0], place)
        return Exported("", written.files, written.stands_for)
    return Exported(*write_shader(shown[0], place, kind, function))


def format_of(path: Path) -> str:
    """The extension, in lower case. Raises UnknownFormatError for one that no export has."""
    kind = path.suffix.lower()
    known = [*LANGUAGES, PAGE, *targets()]
    if kind not in known:
        raise UnknownFormatError(path, f"exports are {', '.join(known[:-1])} or {known[-1]}; choose one of them.")
    return kind


def _write_page(shown: Sequence[Reflectance], place: Path, start: dict[str, Any]) -> Path:
    from ..viewer.page import page
    from ..viewer.payload import View

    text = page(shown, View(**start))
    with replacing(place) as temporary:
        temporary.write_text(text, "utf-8")
    return place
