"""glTF 2.0: `.gltf` with one metallic-roughness material, to copy into a model."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from ..container import replacing
from ..reflectance import Reflectance
from .principled import metallic_roughness
from .target import Target, Written, stand_in, title


def write(m: Reflectance, path: Path) -> Written:
    """The material alone; `m` itself where it is one, else by a fit."""
    made = metallic_roughness(m)
    row: dict[str, Any] = dict(made.values)
    factors = {
        "baseColorFactor": [*(round(float(x), 7) for x in row["base_color"]), 1.0],
        "metallicFactor": round(float(row["metallic"]), 7),
        "roughnessFactor": round(float(row["roughness"]), 7),
    }
    document = {
        "asset": {"version": "2.0", "generator": "brdf"},
        "materials": [{"name": title(m), "pbrMetallicRoughness": factors}],
    }
    with replacing(path) as temporary:
        temporary.write_text(json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False) + "\n", "utf-8")
    return Written((path,), stand_in(made, m, f"glTF material in {path.name}"))


TARGET = Target("glTF", ".gltf", "metallic-roughness material, by a fit", write)
