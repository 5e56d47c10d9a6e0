"""What a page needs for files dropped on it that carry no shader: tables whose texels the page makes itself."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np

from ..geometry.warps import Bezier, square_root, uniform
from ..representations.baking.bake import HORIZON_MARGIN
from ..representations.tables import merl
from ..representations.tables.bases import HalfBasis
from ..representations.tables.encoding import Encoding, Log
from ..representations.tables.layout import Layout
from ..representations.tables.table import Table
from ..shaders import shader_of, stages

OFFSET = 1e-3
"""Of the logarithm that the resampled table holds: ln(f + OFFSET)."""

RESAMPLED = Layout(
    HalfBasis("mirror"),
    (square_root(), Bezier(alpha=0.65), uniform(math.pi)),
    (128, 64, 64),
    Encoding(Log(OFFSET)),
    "float32",
)
"""What a measurement on an adaptive grid becomes in a page.

Its zenith angles of the half vector are the measurement's own, 128 nodes over a square root. Light and viewer are told
apart, as the measurement does; left and right of the plane of incidence are not.
"""


@cache
def library() -> dict[str, Any]:
    """Shaders of tables without their texels, by name: {"shader": description, "text": GLSL}, with texels of RGBA32F.

    "merl": MERL's bins, (90, 90, 181) nodes. "table": `RESAMPLED`, with the angles [rad] of its `nodes`, one list an
    axis, the `offset` of its logarithm, and the `margin` [rad] above the horizon of the nodes that lie below.
    """
    nodes = [np.round(axis.ravel(), 9).tolist() for axis in RESAMPLED.nodes()]
    table = _template(RESAMPLED) | {"nodes": nodes, "offset": OFFSET, "margin": HORIZON_MARGIN}
    return {"merl": _template(merl.LAYOUT), "table": table}


def _template(layout: Layout) -> dict[str, Any]:
    """A table's shader; its one texture is described as the page fills it."""
    thin = tuple(1 if axis == 0 else n for axis, n in enumerate(layout.shape))
    table = Table(layout, np.broadcast_to(np.zeros((*thin, 3), np.float32), (*layout.shape, 3)))
    shader = shader_of(table, function="brdf_table", with_texels=False)
    texture = {
        "uniform": "grid",
        "target": "TEXTURE_3D",
        "size": layout.shape[::-1],
        "internal_format": "RGBA32F",
        "format": "RGBA",
        "type": "FLOAT",
        "offset": 0,
        "bytes": 16 * math.prod(layout.shape),
    }
    return {"shader": shader.description | {"textures": [texture]}, "text": stages.material(shader)}
