"""What the function of an exported shader may be called: nothing that a compiler would refuse."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import brdf
from brdf.errors import ParameterError
from brdf.models import GGX
from cards import HEADERS, GLCard, WebCard

ORDINARY = ("shade", "f", "brdf_GGX", "Paint3", "texel", "glow_1", "GLOSS", "mat5", "vector3", "selfish")

TAKEN = {
    ".glsl": """
        GL_ES GL_core_profile acosh atomicAdd atomic_uint coherent dFdx dmat2 dmat3x4 double dvec3 faceforward
        floatBitsToInt fvec2 fwidth gl_Position gl_x greaterThan groupMemoryBarrier hvec2 iimage2DMSArray image2D
        image1DArrayShadow imageAtomicAdd imageBuffer intBitsToFloat inverse inversesqrt isampler2D isamplerCube
        lessThan mat2x2 mat4x3 matrixCompMult modf noperspective notEqual outerProduct packHalf2x16 readonly restrict
        roundEven row_major sampler1D sampler2DRect sampler2DShadow sampler3DRect samplerBuffer samplerCube smoothstep
        texelFetch texture2D texture2DProjLod texture3DLod textureCubeLod textureGrad textureLod textureProjGradOffset
        textureSize transpose uimage3D uintBitsToFloat unpackUnorm2x16 usampler2DMS usamplerBuffer writeonly x__y
    """,
    ".wgsl": """
        NULL Self abstract alignas alignof asm_fragment atan2 attribute become co_await coherent column_major
        compile_fragment concept const_cast consteval constexpr constinit demote demote_to_helper dynamic_cast enable
        external fma function fxgroup groupshared highp impl macro_rules mat2x3f mutable noinline nointerpolation
        noncoherent noperspective nullptr partition pixelfragment read_write regardless reinterpret_cast requires
        rg11b10ufloat rgba16float sampler_comparison saturate snorm static_assert storage subroutine textureSample
        texture_2d thread_local trait typename uniform varying vec3u workgroupBarrier
    """,
}


@pytest.mark.parametrize(("extension", "name"), [(kind, name) for kind in TAKEN for name in TAKEN[kind].split()])
def test_words_of_the_languages_are_refused(extension: str, name: str, tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match=f"no gl_ in front, and is no word of the language; got '{name}'"):
        brdf.export(GGX(), tmp_path / f"m{extension}", name)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ORDINARY)
def test_other_names_compile(name: str, gl: GLCard, web: WebCard, tmp_path: Path) -> None:
    shaders = {kind: brdf.export(GGX(), tmp_path / f"m{kind}", name).files[0] for kind in TAKEN}
    assert json.loads((tmp_path / "m.glsl.json").read_text("utf-8"))["function"] == name
    main = f"out vec4 colour; void main() {{ colour = vec4({name}(vec3(0.6, 0.0, 0.8), vec3(0.0, 0.0, 1.0)), 1.0); }}"
    for header in HEADERS.values():
        vertex = header + "in vec3 p; void main() { gl_Position = vec4(p, 1.0); }"
        with gl.context:
            gl.context.program(vertex, fragment_shader=header + shaders[".glsl"].read_text("ascii") + main)
    web.device.create_shader_module(code=shaders[".wgsl"].read_text("ascii"))
