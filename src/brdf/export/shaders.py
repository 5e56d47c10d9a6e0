"""A reflectance's formula as the text of a shader, its numbers and textures beside it."""

from __future__ import annotations

import contextlib
import json
from pathlib import Path

from ..container import replacing
from ..reflectance import Reflectance
from ..shaders import shader_of
from ..shaders.shader import in_ascii
from .header import header


def write_shader(m: Reflectance, place: Path, language: str, function: str | None) -> tuple[str, tuple[Path, ...]]:
    """Write a shader, its description and texels; gives the function's name and the files. Raises as `shader_of`."""
    made = shader_of(m, language, function)
    files = [place, Path(f"{place}.json"), *([Path(f"{place}.bin")] if made.texels else [])]
    described = json.dumps(made.description, indent=2, ensure_ascii=False) + "\n"
    contents = [in_ascii(header(m, made.function, language) + made.text), described.encode(), made.texels]
    with contextlib.ExitStack() as places:  # all of them or none; closed from behind, the shader last
        for file, content in zip(files, contents, strict=False):
            places.enter_context(replacing(file)).write_bytes(content)
    return made.function, tuple(files)
