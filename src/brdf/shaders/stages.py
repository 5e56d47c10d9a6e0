"""Whole shaders around a material's function: one text for Python, desktop, browser and phone.

The parts are the `.glsl` files of `scene/`. A host puts `#version 300 es` or `#version 330 core` before what it gets
from here.
"""

from __future__ import annotations

from functools import cache
from importlib import resources

from .shader import Shader

MATERIAL = "// MATERIAL\n"
"""Where a fragment shader without material wants it: `material(shader)`."""

HARDWARE_FILTER = "#define HARDWARE_FILTER\n"
"""Before a shader: linear lookups are left to the hardware."""

LIGHTS_ALONE = "#define LIGHTS_ALONE\n"
"""Before a shader that shades: without an environment, a smaller and faster program."""

SHAPES = ("mesh", "sphere")
"""What there are stages for: triangles, and the exact unit sphere."""

SURFACES = {
    "mesh": ("face", "surface.mesh", "shadow.mesh"),
    "seen": ("face", "ray", "surface.seen", "shadow.mesh"),
    "sphere": ("ray", "surface.sphere", "shadow.sphere"),
}
"""The parts that find the point to shade. "seen": triangles whose numbers `faces` has left in a picture before."""


@cache
def part(name: str) -> str:
    """One file of `scene/`, without its extension."""
    return resources.files(__package__).joinpath("scene", f"{name}.glsl").read_text("utf-8")


def _joined(*names: str) -> str:
    return "\n".join(MATERIAL if name == "material" else part(name) for name in names)


def vertex(shape: str) -> str:
    """The vertex shader of a shape: `mesh` takes 3 vertices a face, `sphere`, `seen` and `screen` 3 in all."""
    mesh = ["precision", "camera", "texel", "mesh.vert", "main.vert"]
    return _joined(*mesh) if shape == "mesh" else _joined("sphere.vert")


def fragment(shape: str) -> str:
    """The fragment shader that shades a shape of `SURFACES`; `MATERIAL` stands for the material."""
    surface = ["point", "angle", *SURFACES[shape]]
    light = ["light", "lights", "points", "environment"]
    return _joined("precision", "material", "camera", "texel", *surface, *light, "main.frag")


def evaluation() -> str:
    """The fragment shader that evaluates the material at given directions."""
    return _joined("precision", "material", "evaluate.frag")


def depth() -> str:
    """The fragment shader that leaves nothing but depth."""
    return _joined("precision", "depth.frag")


def faces() -> str:
    """The fragment shader that leaves the numbers of faces, and depth."""
    return _joined("precision", "face.frag")


def sum_of_samples() -> str:
    """The fragment shader that hands on the texels of `drawn`, to be added to those drawn before."""
    return _joined("precision", "sum.frag")


def material(shader: Shader) -> str:
    """The material's text, and what the stages call it by."""
    uv = ", uv" if shader.varies else ""
    transmits = shader.description["transmits"]
    return "\n".join([
        shader.text,
        f"#define MATERIAL(wi, wo, uv) {shader.function}(wi, wo{uv})",
        f"#define COSINE(z) {'abs(z)' if transmits else 'max(z, 0.0)'}",
        f"#define TRANSMITS {str(transmits).lower()}",
        "",
    ])  # fmt: skip


def per_vertex(brdf: Shader, picture: Shader) -> tuple[str, str]:
    """Vertex and fragment shader that draw a mesh whose `brdf` is evaluated at corners alone, where it says which
    `picture` a place shows."""
    vertex = ["precision", "material", "camera", "texel", "mesh.vert", "light", "per_vertex.vert"]
    surface = ["camera", "texel", "point", "angle", *SURFACES["mesh"]]
    fragment = ["precision", "material", *surface, "light", "lights", "per_vertex.frag"]
    return (_joined(*vertex).replace(MATERIAL, material(brdf)), _joined(*fragment).replace(MATERIAL, material(picture)))


def shading(shader: Shader, shape: str) -> tuple[str, str]:
    """Vertex and fragment shader that draw a shape of the material."""
    return vertex(shape), fragment(shape).replace(MATERIAL, material(shader))
