"""WGSL from a traced program, for WebGPU."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..graph import Expr
from ..trace import Program
from .shader import DIRECTIONS, Body, body, helper_names, helpers, in_place, literal, swizzled
from .statements import Dialect

_FUNCTIONS = {
    "minimum": "min", "maximum": "max", "pow": "power", "pow3": "power3", "asin": "arcsin", "asin3": "arcsin3",
    "acos": "arccos", "acos3": "arccos3", "atan": "arctan", "atan3": "arctan3", "atan2": "arctan2",
    "atan23": "arctan23", "vec2": "vec2f", "vec3": "vec3f",
}  # fmt: skip

_SIGNS = {"lt3": "<", "le3": "<="}

_WORDS = """
    Parameters parameters abs acos active alias all any array as asm async atan auto await bitcast bool break case cast
    catch ceil clamp class common compile const const_assert continue continuing cos cross crate debugger decltype
    default degrees delete determinant diagnostic discard distance do dot else enum exp exp2 explicit export extends
    extern f16 f32 fallthrough false filter final finally floor fn for fract friend from get goto handle i32 if
    implements import inline instanceof interface inverse layout length let log log2 loop lowp macro main mat2x2 mat3x3
    mat4x4 match max mediump meta min mix mod module move mut namespace new nil noexcept normalize null of operator
    override package packoffset pass patch pow precise precision premerge priv private protected ptr pub public
    radians readonly ref reflect refract register require resource restrict return round sampler select self set shared
    sign sin sinh sizeof smooth sqrt static std step struct super switch tan tanh target template texture this throw
    transpose true trunc try type typedef typeid typeof u32 union unless unorm unsafe unsized use using var vec2 vec2f
    vec3 vec3f vec4 vec4f virtual void volatile wgsl where while with writeonly yield
"""

RESERVED = helper_names("wgsl").union(_WORDS.split())
"""What nothing of a formula may be called: words of the language, and the library's functions."""


def _call(op: str, arguments: list[str]) -> str:
    if op.startswith("."):
        return swizzled(op, arguments[0])
    if op in _SIGNS:
        return f"({f' {_SIGNS[op]} '.join(arguments)})"
    if op in ("where", "where3"):
        condition, x, y = arguments
        return f"select({y}, {x}, {condition})"
    return f"{_FUNCTIONS.get(op, op)}({', '.join(arguments)})"


def _dialect(kinds: Mapping[Expr, str]) -> Dialect:
    return Dialect(
        constant=literal,
        call=_call,
        negation=lambda text: f"!{text}",
        reserved=RESERVED,
        declared=lambda node, name: f"let {name}",
        in_place=in_place,
        doubled=True,
    )


def print_wgsl(
    program: Program, name: str, has_horizon: bool, varies: bool = False, notes: Mapping[str, str] | None = None
) -> tuple[str, Body]:
    """Declarations and `fn NAME(wi: vec3f, wo: vec3f) -> vec3f`, with `uv: vec2f` behind for what varies, and what was
    printed. Parameters are a uniform buffer at binding 0 of group 0, textures follow.

    `notes`: comments by parameter. Raises FormulaError for a constant that single precision cannot hold.
    """
    made = body(program, _dialect, "parameters.")
    inputs = ", ".join([*(f"{w}: vec3f" for w in DIRECTIONS), *(["uv: vec2f"] if varies else [])])
    fields = []
    for u in made.uniforms:
        note = (notes or {}).get(u.parameter)
        fields.append(f"    {u.name}: {'f32' if u.size == 1 else 'vec3f'}," + (f"  // {note}" if note else ""))
    struct = ["struct Parameters {", *fields, "}", "@group(0) @binding(0) var<uniform> parameters: Parameters;"]
    sampled = [(n, t.axes) for t in made.textures for n in t.names.values()]
    textures = [
        f"@group(0) @binding({number}) var {texture}: texture_{axes}d<f32>;"
        for number, (texture, axes) in enumerate(sampled, start=1)
    ]
    function = [
        f"fn {name}({inputs}) -> vec3f {{",
        *(["    if (wi.z <= 0.0 || wo.z <= 0.0) { return vec3f(0.0); }"] if has_horizon else []),
        *(f"    {variable} = {text};" for variable, text in made.statements),
        f"    return max({made.value}, vec3f(0.0));",
        "}",
    ]
    parts = ["\n".join([*(struct if fields else []), *textures]), helpers("wgsl", made.text), "\n".join(function)]
    return "\n\n".join(part for part in parts if part) + "\n", made


def uniform_layout(made: Body) -> dict[str, Any]:
    """Where the parameters lie in the uniform buffer: `uniform_offsets` by name and `uniform_bytes`."""
    offsets: dict[str, int] = {}
    end = 0
    for u in made.uniforms:
        align = 4 if u.size == 1 else 16
        offsets[u.name] = -(-end // align) * align
        end = offsets[u.name] + 4 * u.size
    return {"uniform_offsets": offsets, "uniform_bytes": -(-end // 16) * 16}
