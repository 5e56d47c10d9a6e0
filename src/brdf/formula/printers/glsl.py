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
    EmitStreamVertex EmitVertex EndPrimitive EndStreamPrimitive abs acos acosh active all allInvocations
    allInvocationsEqual any anyInvocation asin asinh asm atan atanh atomicAdd atomicAnd atomicCompSwap atomicCounter
    atomicCounterAdd atomicCounterAnd atomicCounterCompSwap atomicCounterDecrement atomicCounterExchange
    atomicCounterIncrement atomicCounterMax atomicCounterMin atomicCounterOr atomicCounterSubtract atomicCounterXor
    atomicExchange atomicMax atomicMin atomicOr atomicXor atomic_uint attribute barrier bitCount bitfieldExtract
    bitfieldInsert bitfieldReverse bool break buffer case cast ceil centroid clamp class coherent common const
    continue cos cosh cross dFdx dFdxCoarse dFdxFine dFdy dFdyCoarse dFdyFine default degrees determinant discard
    distance do dot double else enum equal exp exp2 extern external faceforward false filter findLSB findMSB fixed
    flat float floatBitsToInt floatBitsToUint floor fma for fract frexp ftransform fwidth fwidthCoarse fwidthFine
    goto greaterThan greaterThanEqual groupMemoryBarrier half highp if image imageAtomicAdd imageAtomicAnd
    imageAtomicCompSwap imageAtomicExchange imageAtomicMax imageAtomicMin imageAtomicOr imageAtomicXor imageLoad
    imageSamples imageSize imageStore imulExtended in inline inout input int intBitsToFloat interface
    interpolateAtCentroid interpolateAtOffset interpolateAtSample invariant inverse inversesqrt isinf isnan
    isubpassInput isubpassInputMS layout ldexp length lessThan lessThanEqual log log2 long lowp main matrixCompMult
    max mediump memoryBarrier memoryBarrierAtomicCounter memoryBarrierBuffer memoryBarrierImage memoryBarrierShared
    min mix mod modf namespace noinline noise1 noise2 noise3 noise4 noperspective normalize not notEqual out
    outerProduct output packDouble2x32 packHalf2x16 packSnorm2x16 packSnorm4x8 packUnorm2x16 packUnorm4x8 packed
    partition patch pow precise precision public radians readonly reflect refract resource restrict return round
    roundEven row_major sample sampler sampler3DRect samplerShadow shadow1D shadow1DLod shadow1DProj shadow1DProjLod
    shadow2D shadow2DLod shadow2DProj shadow2DProjLod shared short sign sin sinh sizeof smooth smoothstep sqrt
    static step struct subpassInput subpassInputMS subpassLoad subroutine superp switch tan tanh template texelFetch
    texelFetchOffset texture texture1DLod texture1DProj texture1DProjLod texture2DLod texture2DProj texture2DProjLod
    texture3DLod texture3DProj texture3DProjLod textureCubeLod textureGather textureGatherOffset
    textureGatherOffsets textureGrad textureGradOffset textureLod textureLodOffset textureOffset textureProj
    textureProjGrad textureProjGradOffset textureProjLod textureProjLodOffset textureProjOffset textureQueryLevels
    textureQueryLod textureSamples textureSize this transpose true trunc typedef uaddCarry uint uintBitsToFloat
    umulExtended uniform union unpackDouble2x32 unpackHalf2x16 unpackSnorm2x16 unpackSnorm4x8 unpackUnorm2x16
    unpackUnorm4x8 unsigned using usubBorrow usubpassInput usubpassInputMS varying void volatile while writeonly
"""
"""Of GLSL 3.30 to 4.60 and ES 3.00 to 3.20, as any of which the text may be compiled, and of what Vulkan adds."""

_NUMBERS = {f"{kind}vec{size}" for kind in ("", "b", "d", "f", "h", "i", "u") for size in "234"} | {
    f"{kind}mat{columns}{rows}" for kind in ("", "d") for columns in "234" for rows in ("", "x2", "x3", "x4")
}

_SHAPES = """
    1D 2D 3D Cube Buffer 2DRect 2DMS 1DArray 2DArray CubeArray 2DMSArray 1DShadow 2DShadow CubeShadow 2DRectShadow
    1DArrayShadow 2DArrayShadow CubeArrayShadow
"""

_OPAQUE = {
    f"{kind}{what}{shape}"
    for kind in ("", "i", "u")
    for what in ("image", "sampler", "texture")
    for shape in _SHAPES.split()
}

RESERVED = helper_names("glsl").union(_WORDS.split(), _NUMBERS, _OPAQUE)
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
