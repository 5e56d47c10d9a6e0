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
    NULL Parameters Self abs abstract acos acosh active alias alignas alignof all any array arrayLength as asin
    asinh asm asm_fragment async atan atan2 atanh atomic atomicAdd atomicAnd atomicCompareExchangeWeak
    atomicExchange atomicLoad atomicMax atomicMin atomicOr atomicStore atomicSub atomicXor attribute auto await
    become bgra8unorm binding_array bitcast bool break case cast catch ceil clamp class co_await co_return co_yield
    coherent column_major common compile compile_fragment concept const const_assert const_cast consteval constexpr
    constinit continue continuing cos cosh countLeadingZeros countOneBits countTrailingZeros crate cross debugger
    decltype default degrees delete demote demote_to_helper determinant diagnostic discard distance do dot
    dot4I8Packed dot4U8Packed dpdx dpdxCoarse dpdxFine dpdy dpdyCoarse dpdyFine dynamic_cast else enable enum exp
    exp2 explicit export extends extern external extractBits f16 f32 faceForward fallthrough false filter final
    finally firstLeadingBit firstTrailingBit floor fma fn for fract frexp friend from function fwidth fwidthCoarse
    fwidthFine fxgroup get goto groupshared handle highp i32 if impl implements import inline insertBits instanceof
    interface inverse inverseSqrt layout ldexp length let log log2 loop lowp macro macro_rules main match max
    mediump meta min mix mod modf module move mut mutable namespace new nil noexcept noinline nointerpolation
    non_coherent noncoherent noperspective normalize null nullptr of operator override pack2x16float pack2x16snorm
    pack2x16unorm pack4x8snorm pack4x8unorm pack4xI8 pack4xI8Clamp pack4xU8 pack4xU8Clamp package packoffset
    parameters partition pass patch pixelfragment pow precise precision premerge priv private protected ptr pub
    public quadBroadcast quadSwapDiagonal quadSwapX quadSwapY quantizeToF16 radians read read_write readonly ref
    reflect refract regardless register reinterpret_cast require requires resource restrict return reverseBits
    rg11b10ufloat rgb10a2uint rgb10a2unorm round sampler sampler_comparison saturate select self set shared sign sin
    sinh sizeof smooth smoothstep snorm sqrt static static_assert static_cast std step storage storageBarrier struct
    subgroupAdd subgroupAll subgroupAnd subgroupAny subgroupBallot subgroupBroadcast subgroupBroadcastFirst
    subgroupElect subgroupExclusiveAdd subgroupExclusiveMul subgroupInclusiveAdd subgroupInclusiveMul subgroupMax
    subgroupMin subgroupMul subgroupOr subgroupShuffle subgroupShuffleDown subgroupShuffleUp subgroupShuffleXor
    subgroupXor subroutine super switch tan tanh target template texture textureBarrier textureDimensions
    textureGather textureGatherCompare textureLoad textureNumLayers textureNumLevels textureNumSamples textureSample
    textureSampleBaseClampToEdge textureSampleBias textureSampleCompare textureSampleCompareLevel textureSampleGrad
    textureSampleLevel textureStore texture_1d texture_2d texture_2d_array texture_3d texture_cube
    texture_cube_array texture_depth_2d texture_depth_2d_array texture_depth_cube texture_depth_cube_array
    texture_depth_multisampled_2d texture_external texture_multisampled_2d texture_storage_1d texture_storage_2d
    texture_storage_2d_array texture_storage_3d this thread_local throw trait transpose true trunc try type typedef
    typeid typename typeof u32 uniform union unless unorm unpack2x16float unpack2x16snorm unpack2x16unorm
    unpack4x8snorm unpack4x8unorm unpack4xI8 unpack4xU8 unsafe unsized use using var varying virtual void volatile
    wgsl where while with workgroup workgroupBarrier workgroupUniformLoad write writeonly yield
"""
"""Keywords and reserved words of WGSL, what it declares beforehand, and what the printed text declares."""

_NUMBERS = {f"vec{size}{kind}" for size in "234" for kind in ("", "f", "h", "i", "u")} | {
    f"mat{columns}x{rows}{kind}" for columns in "234" for rows in "234" for kind in ("", "f", "h")
}

_STORED = "8unorm 8snorm 8uint 8sint 16unorm 16snorm 16uint 16sint 16float 32uint 32sint 32float"

_TEXELS = {f"{channels}{stored}" for channels in ("r", "rg", "rgba") for stored in _STORED.split()}

RESERVED = helper_names("wgsl").union(_WORDS.split(), _NUMBERS, _TEXELS)
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
