"""The shader of a reflectance: what is written to files, drawn with from Python, and put into pages."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import ParameterError, ReflectanceError
from ..formula.printers import glsl, wgsl
from ..formula.printers.lanes import group_size
from ..formula.printers.shader import Body, Uniform
from ..formula.trace import trace
from ..parameters import Parameter, declaration
from .texels import images

if TYPE_CHECKING:
    from ..reflectance import Reflectance

LANGUAGES: dict[str, Callable[..., tuple[str, Body]]] = {".glsl": glsl.print_glsl, ".wgsl": wgsl.print_wgsl}
"""Printers by file extension."""

RESERVED = {".glsl": glsl.RESERVED, ".wgsl": wgsl.RESERVED}

NAME = r"(?!gl_|GL_)[A-Za-z][A-Za-z0-9]*(_[A-Za-z0-9]+)*"
"""Of a function: GLSL keeps two underscores in a row, and names and macros that begin with GL, to itself."""

MOST_TEXTURES = 16
"""That every card binds to one shader at a time."""

VERSION = 1
"""Of the description of a shader."""


@dataclass(frozen=True)
class Shader:
    """A function f(wi, wo) [1/sr], without the cosine, in GLSL or WGSL."""

    text: str
    """Declarations and the function; without a `#version` line."""
    description: dict[str, Any]
    """Function, parameters with their values, textures: plain data, as JSON takes it."""
    texels: bytes
    """Of all textures, one after the other."""

    @property
    def function(self) -> str:
        return str(self.description["function"])

    @property
    def varies(self) -> bool:
        """Whether the function takes the place on the surface, `vec2 uv`, as well."""
        return bool(self.description["varies"])


def shader_of(m: Reflectance, language: str = ".glsl", function: str | None = None, with_texels: bool = True) -> Shader:
    """The shader of `m` in a language of `LANGUAGES`; the function is called `brdf_NAME` unless `function` names it.

    Without texels, no textures are described: whoever fills them does that.

    Raises ReflectanceError for what has no formula (bake it first), or too large textures or too many; ParameterError
    for a function name that is none; FormulaError or ParameterError for numbers beyond single precision.
    """
    if not m.has_formula:
        raise ReflectanceError(
            f"{m.name or type(m).__name__} has no formula to write as a shader; bake it first, "
            "as in `brdf convert X baked.safetensors --as slice-stack`"
        )
    name = function_name(m) if function is None else function
    if not re.fullmatch(NAME, name) or name in RESERVED[language]:
        rule = "letters, digits, single underscores, no gl_ in front, and is no word of the language"
        raise ParameterError(f"a function's name has {rule}; got {name!r}")
    declared = {key: declaration(m, key) for key in m.values}
    notes = {key: _note(m.values[key], declared[key]) for key in m.values}
    text, body = LANGUAGES[language](trace(m), name, has_horizon=not m.transmits, varies=m.varies, notes=notes)
    taken = {u.name for u in body.uniforms}.union(*(sampled.names.values() for sampled in body.textures))
    if name in taken:
        raise ParameterError(f"the function's name must differ from the parameters' {', '.join(sorted(taken))}")
    if sum(len(sampled.names) for sampled in body.textures) > MOST_TEXTURES:
        raise ReflectanceError(f"{m.name} has more than the {MOST_TEXTURES} textures that graphics cards bind; bake it")
    textures, texels = _textures(m, body) if with_texels else ([], b"")
    description: dict[str, Any] = {
        "version": VERSION,
        "language": language[1:],
        "function": name,
        "name": m.name,
        "source": m.source,
        "unit": "1/sr",
        "varies": m.varies,
        "transmits": m.transmits,
        "parameters": [_parameter(u, m.values[u.parameter], declared[u.parameter]) for u in body.uniforms],
        "textures": textures,
    }
    if language == ".wgsl":
        description |= wgsl.uniform_layout(body)
    return Shader(text, description, texels)


def function_name(m: Reflectance) -> str:
    """`brdf_` and the name, of which only letters and digits are kept."""
    words = re.findall(r"[A-Za-z0-9]+", in_ascii(m.name or type(m).__name__).decode())
    return "_".join(["brdf", *words])[:60].rstrip("_")


def in_ascii(text: str) -> bytes:
    """The text for compilers that refuse other characters, in comments, too: without accents, what is left as `?`."""
    plain = unicodedata.normalize("NFKD", text.replace("\u2013", "-"))
    return "".join(c for c in plain if not unicodedata.combining(c)).encode("ascii", "replace")


def _note(value: Any, declared: Parameter | None) -> str:
    """`0.1 in [0.0001, 1]: lobe width`."""
    numbers = ", ".join(f"{v:.6g}" for v in np.atleast_1d(value))
    if declared is None:
        return numbers
    unit = "" if declared.unit == "1" else f" {declared.unit}"
    return f"{numbers}{unit}, in {declared.interval}: {declared.doc}"


def _parameter(uniform: Uniform, value: Any, declared: Parameter | None) -> dict[str, Any]:
    """A parameter's part of the description. Raises ParameterError for numbers beyond single precision."""
    with np.errstate(over="ignore"):
        if not np.isfinite(np.float32(value)).all():
            raise ParameterError(f"{uniform.parameter} = {value} is beyond single precision, in which shaders compute")
    known: dict[str, Any] = {"name": uniform.parameter, "uniform": uniform.name, "size": uniform.size}
    known["value"] = np.asarray(value, np.float64).tolist()
    if declared is not None:
        bounds = {"low": declared.low, "high": declared.high}
        known |= {side: bound if np.isfinite(bound) else None for side, bound in bounds.items()}
        known |= {"unit": declared.unit, "doc": declared.doc}
    return known


def _textures(m: Reflectance, body: Body) -> tuple[list[dict[str, Any]], bytes]:
    """The textures' part of the description, and their texels."""
    found: list[dict[str, Any]] = []
    data = b""
    for sampled in body.textures:
        texture = sampled.texture
        numbers = np.ascontiguousarray(m.textures[texture.name], np.float32)
        for image in images(numbers, sampled.names, group_size(texture)):
            pixel_format, pixel_type = image.pixel_format
            found.append({
                "uniform": image.name,
                "target": f"TEXTURE_{len(image.size)}D",
                "size": list(image.size),
                "internal_format": image.internal_format,
                "format": pixel_format,
                "type": pixel_type,
                "webgpu_format": image.web_format,
                "offset": len(data),
                "bytes": len(image.texels),
            })  # fmt: skip
            data += image.texels + b"\0" * (-len(image.texels) % 4)
    return found, data
