"""Pictures of a material: shapes, lights, cameras, and the renderer that runs anywhere.

Names are handed on lazily: a shape or a light loads no compiler.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from ..callable_module import make_callable

if TYPE_CHECKING:
    from .caption import captioned
    from .environment import Environment
    from .image import Image
    from .lights import Directional, Point
    from .mesh import Mesh
    from .per_vertex import render_per_vertex
    from .pictures import render, render_halves
    from .scene import Camera

__all__ = [
    "Camera",
    "Directional",
    "Environment",
    "Image",
    "Mesh",
    "Point",
    "captioned",
    "render",
    "render_halves",
    "render_per_vertex",
]

_NAMES = {
    "Camera": "scene",
    "Directional": "lights",
    "Environment": "environment",
    "Image": "image",
    "Mesh": "mesh",
    "Point": "lights",
    "captioned": "caption",
    "render": "pictures",
    "render_halves": "pictures",
    "render_per_vertex": "per_vertex",
}
"""Public name: the module it lives in."""


def __getattr__(name: str) -> Any:
    if name not in _NAMES:
        raise AttributeError(f"module 'brdf.render' has no attribute {name!r}")
    return getattr(importlib.import_module(f".{_NAMES[name]}", __name__), name)


make_callable(__name__, "render")
