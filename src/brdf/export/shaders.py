"""`export`: a reflectance's formula as the text of a shader, its numbers and textures beside it."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import NamedTuple

from ..container import replacing
from ..errors import UnknownFormatError
from ..reflectance import Reflectance
from ..shaders import LANGUAGES, shader_of
from ..shaders.shader import in_ascii
from .header import header


class Exported(NamedTuple):
    """What `export` wrote."""

    function: str
    """Name of the function in the shader."""
    files: tuple[Path, ...]
    """The shader, its description, and its textures if it has any."""


def export(m: Reflectance, path: str | os.PathLike[str], function: str | None = None) -> Exported:
    """Write `m` as a shader: `.glsl` (GLSL ES 3.00 and GLSL 3.30, without a `#version` line) or `.wgsl`.

    The function, `brdf_NAME(wi, wo)` unless `function` names it, gives f [1/sr] without the cosine, zero below the
    horizon; its comment says how to use it. Beside PATH go PATH.json, the parameters' values and what the textures are,
    and, if there are textures, PATH.bin, their texels one after the other. Raises UnknownFormatError for another
    extension; ReflectanceError for what has no formula (bake it first), or too large textures or too many;
    ParameterError for a function name that is none; FormulaError or ParameterError for numbers beyond single precision;
    FileError.
    """
    place = Path(path)
    language = language_of(place)
    made = shader_of(m, language, function)
    files = [place, Path(f"{place}.json"), *([Path(f"{place}.bin")] if made.texels else [])]
    described = json.dumps(made.description, indent=2, ensure_ascii=False) + "\n"
    contents = [in_ascii(header(m, made.function, language) + made.text), described.encode(), made.texels]
    for file, content in reversed([*zip(files, contents, strict=False)]):  # the shader last: then all is there
        with replacing(file) as temporary:
            temporary.write_bytes(content)
    return Exported(made.function, tuple(files))


def language_of(path: Path) -> str:
    """The extension that says the language. Raises UnknownFormatError."""
    language = path.suffix.lower()
    if language not in LANGUAGES:
        raise UnknownFormatError(path, f"shaders are written as {' or '.join(LANGUAGES)}; choose one of them.")
    return language
