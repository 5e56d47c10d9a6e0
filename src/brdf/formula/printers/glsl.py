"""GLSL ES 3.00 from a traced program, which desktop GL takes, too: the text below the `#version` line."""

from __future__ import annotations

import re
from collections.abc import Mapping

from ..graph import Expr
from ..trace import Program
from .shader import DIRECTIONS, Body, body, helper_names, helpers, in_place, literal, swizzled
from .statements import Dialect

PRECISION = """precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler3D;
"""
"""Without it samplers have as little as 8 bits in ES."""

_FUNCTIONS = {
    "minimum": "min", "maximum": "max", "pow": "power", "pow3": "power3", "asin": "arcsin", "asin3": "arcsin3",
    "acos": "arccos", "acos3": "arccos3", "atan": "arctan", "atan3": "arctan3", "atan2": "arctan2",
    "atan23": "arctan23", "lt3": "lessThan", "le3": "lessThanEqual",
}  # fmt: skip

_TYPES = {"number": "float", "texel": "vec4"}
"""Those of the kinds of nodes that have another name in GLSL."""


def _alike(argument: str) -> str:
    """The number of which all components of a vector are, or the vector."""
    match = re.fullmatch(r"vec3\((-?[\d.]+(?:e[-+]\d+)?)\)", argument)
    return match[1] if match else argument


def _call(op: str, arguments: list[str]) -> str:
    if op.startswith("."):
        return swizzled(op, arguments[0])
    match op:
        case "where":
            condition, x, y = arguments
            return f"({condition} ? {x} : {y})"
        case "where3":
            condition, x, y = arguments
            return f"mix({y}, {x}, {condition})"
    if op in ("minimum", "maximum", "clamp"):  # which take a number beside a vector, but not before it
        arguments = [argument if index == 0 else _alike(argument) for index, argument in enumerate(arguments)]
    return f"{_FUNCTIONS.get(op, op)}({', '.join(arguments)})"


_WORDS = """
    abs active all any asm atan attribute bool break bvec2 bvec3 bvec4 case cast ceil centroid clamp class common const
    continue cos cross default degrees determinant discard distance do dot double else enum equal exp exp2 extern
    external false filter fixed flat float floor for fract goto half highp hvec3 if image in inline inout input int
    interface invariant inverse isinf isnan ivec2 ivec3 ivec4 layout length log log2 long lowp main mat2 mat3 mat4 max
    mediump min mix mod namespace noinline normalize not out output packed partition patch pow precise precision public
    radians reflect refract resource return round sample sampler sampler2D sampler3D short sign sin sinh sizeof smooth
    sqrt static step struct subroutine superp switch tan tanh template texture this transpose true trunc typedef uint
    uniform union unsigned using uvec2 uvec3 uvec4 varying vec2 vec3 vec4 void volatile while
"""

RESERVED = helper_names("glsl").union(_WORDS.split())
"""What nothing of a formula may be called: words of the language, and the library's functions."""


def _dialect(kinds: Mapping[Expr, str]) -> Dialect:
    return Dialect(
        constant=literal,
        call=_call,
        negation=lambda text: f"!{text}",
        reserved=RESERVED,
        declared=lambda node, name: f"{_TYPES.get(kinds[node], kinds[node])} {name}",
        in_place=in_place,
        doubled=True,
    )


def print_glsl(
    program: Program, name: str, has_horizon: bool, varies: bool = False, notes: Mapping[str, str] | None = None
) -> tuple[str, Body]:
    """Declarations and `vec3 NAME(vec3 wi, vec3 wo)`, with `vec2 uv` behind for what varies, and what was printed.

    `notes`: comments by parameter. Raises FormulaError for a constant that single precision cannot hold.
    """
    made = body(program, _dialect)
    inputs = ", ".join([*(f"vec3 {w}" for w in DIRECTIONS), *(["vec2 uv"] if varies else [])])
    lines = [
        *(_uniform("float" if u.size == 1 else "vec3", u.name, (notes or {}).get(u.parameter)) for u in made.uniforms),
        *(
            _uniform(f"sampler{3 if t.texture.dimensions == 3 else 2}D", n)
            for t in made.textures
            for n in t.names.values()
        ),
    ]
    function = [
        f"vec3 {name}({inputs}) {{",
        *(["    if (wi.z <= 0.0 || wo.z <= 0.0) return vec3(0.0);"] if has_horizon else []),
        *(f"    {variable} = {text};" for variable, text in made.statements),
        f"    return max({made.value}, 0.0);",
        "}",
    ]
    parts = [PRECISION.strip(), "\n".join(lines), helpers("glsl", made.text), "\n".join(function)]
    return "\n\n".join(part for part in parts if part) + "\n", made


def _uniform(kind: str, name: str, note: str | None = None) -> str:
    return f"uniform {kind} {name};" + (f"  // {note}" if note else "")
