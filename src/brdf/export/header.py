"""The comment at the top of an exported shader: what it is and how to use it."""

from __future__ import annotations

import textwrap

from ..reflectance import Reflectance
from .target import one_line, title

_EXAMPLES = {
    ".glsl": """\
Put `#version 300 es` (WebGL2) or `#version 330 core` (desktop) before this text and a main behind it, such as

    in vec3 normal, tangent, to_light, to_viewer;
    uniform vec3 irradiance;            // of the light, on a surface that faces it
    out vec4 colour;                    // linear RGB
    void main() {
        vec3 n = normalize(normal), t = normalize(tangent - n * dot(n, tangent)), b = cross(n, t);
        vec3 wi = normalize(to_light) * mat3(t, b, n), wo = normalize(to_viewer) * mat3(t, b, n);
        colour = vec4(FUNCTION(wi, woUV) * irradiance * COSINE, 1.0);
    }

The values of the uniforms and what the textures are stands in the .json beside this file; texels are in the .bin:

    for (const p of description.parameters)
        gl[p.size == 3 ? "uniform3fv" : "uniform1f"](gl.getUniformLocation(program, p.uniform), p.value);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    description.textures.forEach((t, unit) => {
        const [w, h, d] = t.size, target = gl[t.target], bytes = new Uint8Array(bin, t.offset, t.bytes);
        const texels = {HALF_FLOAT: Uint16Array, FLOAT: Float32Array, UNSIGNED_INT_2_10_10_10_REV: Uint32Array}[t.type];
        const data = texels ? new texels(bin, t.offset, t.bytes / texels.BYTES_PER_ELEMENT) : bytes;
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(target, gl.createTexture());
        if (d) gl.texImage3D(target, 0, gl[t.internal_format], w, h, d, 0, gl[t.format], gl[t.type], data);
        else gl.texImage2D(target, 0, gl[t.internal_format], w, h, 0, gl[t.format], gl[t.type], data);
        for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(target, filter, FILTER);
        for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T, gl.TEXTURE_WRAP_R])
            gl.texParameteri(target, wrap, gl.CLAMP_TO_EDGE);
        gl.uniform1i(gl.getUniformLocation(program, t.uniform), unit);
    });
""".replace("FILTER)", "gl.NEAREST)"),
    ".wgsl": """\
A fragment shader that uses it:

    @group(1) @binding(0) var<uniform> irradiance: vec3f;  // of the light, on a surface that faces it
    @fragment fn main(@location(0) normal: vec3f, @location(1) tangent: vec3f, @location(2) to_light: vec3f,
                      @location(3) to_viewer: vec3f) -> @location(0) vec4f {
        let n = normalize(normal);
        let t = normalize(tangent - n * dot(n, tangent));
        let frame = mat3x3f(t, cross(n, t), n);
        let wi = normalize(to_light) * frame;
        let wo = normalize(to_viewer) * frame;
        return vec4f(FUNCTION(wi, woUV) * irradiance * COSINE, 1.0);  // linear RGB
    }

The .json beside this file has the values of the parameters with their offsets in the uniform buffer (binding 0), and
the textures with their bindings and formats; texels are in the .bin. Textures are read by textureLoad, no sampler.
""",
}


def header(m: Reflectance, function: str, language: str) -> str:
    """The comment, with a blank line behind it."""
    cosine = "abs(wi.z)" if m.transmits else "max(wi.z, 0.0)"
    uv = ", uv" if m.varies else ""
    domain = "on both sides of the surface" if m.transmits else "0 where wi.z <= 0 or wo.z <= 0"
    facts = [
        f"{function}: the reflectance of {title(m)}" + (f" ({one_line(m.source)})" if m.source else ""),
        "f(wi, wo) in 1/sr, without the cosine, linear RGB (Rec. 709). wi points to the light, wo to the viewer, both "
        "of unit length, in the frame tangent (x), bitangent (y), normal (z): " + domain + ".",
        *(["uv: the place on the surface, u to the right, v up, both in [0, 1]."] if m.varies else []),
        *(["Its mirror part, a delta distribution, has no values and is not in here."] if m.has_delta else []),
        "Made by brdf, https://pypi.org/project/brdf/",
    ]
    text = "\n".join(line for fact in facts for line in textwrap.wrap(fact, 110))
    example = _EXAMPLES[language].replace("FUNCTION", function).replace("UV", uv).replace("COSINE", cosine)
    lines = [*text.splitlines(), "", *example.splitlines()]
    return "\n".join(f"// {line}".rstrip() for line in lines) + "\n\n"
