"""Reflectances as tests hand them to the viewer's modules in a browser."""

from __future__ import annotations

import base64
from typing import Any

import numpy as np

from brdf.reflectance import Reflectance
from brdf.representations.tables.table import Table
from brdf.shaders import shader_of, stages


def source(m: Reflectance) -> dict[str, Any]:
    """What `Material` takes, with bytes in base64: `texels`, and `mask` of what was not measured everywhere."""
    shader = shader_of(m)
    given: dict[str, Any] = {"shader": shader.description, "text": stages.material(shader), "isotropic": m.isotropic}
    given["texels"] = base64.b64encode(shader.texels).decode()
    if isinstance(m, Table) and m.has_holes:
        bits = np.packbits(m.measured, bitorder="little")
        given |= {"mask": base64.b64encode(bits.tobytes()).decode(), "mask_shape": list(m.measured.shape)}
    return given
