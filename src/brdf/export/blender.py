"""Blender: a script `.py` that makes the material with a Principled BSDF (Blender 4.0 and newer)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..container import replacing
from ..reflectance import Reflectance
from .principled import aligned, index_of, principled
from .target import Target, Written, stand_in, title

SCRIPT = '''"""Makes a material in Blender 4.0 or newer: open this in the Text Editor and run it."""

NAME = {name!r}
INPUTS = {{
{inputs}
}}


def make():
    import bpy

    material = bpy.data.materials.new(NAME)
    material.use_nodes = True
    principled = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    principled.distribution = "GGX"
    for socket, value in INPUTS.items():
        principled.inputs[socket].default_value = value
    return material


if __name__ == "__main__":
    make()
'''


def write(m: Reflectance, path: Path) -> Written:
    """The inputs of a Principled BSDF, by a fit of Disney's model, from which it descends."""
    along = aligned(m)
    made = principled(along.reflectance)
    row: dict[str, Any] = dict(made.values)
    inputs = {
        "Base Color": (*(round(float(x), 6) for x in row["base_color"]), 1.0),
        "Metallic": round(float(row["metallic"]), 6),
        "Roughness": round(float(row["roughness"]), 6),
        "IOR": round(index_of(float(row["specular"])), 6),
        "Specular IOR Level": 0.5,
        "Anisotropic": round(float(row["anisotropic"]), 6),
    }
    if along.is_turned:
        inputs["Anisotropic Rotation"] = 0.25  # of a whole turn
    listed = "\n".join(f'    "{socket}": {value!r},' for socket, value in inputs.items())
    with replacing(path) as temporary:
        temporary.write_text(SCRIPT.format(name=title(m), inputs=listed), "utf-8")
    return Written((path,), stand_in(along.back(made), m, f"principled parameters in {path.name}"))


TARGET = Target("Blender", ".py", "a script that sets up a Principled BSDF, by a fit", write)
