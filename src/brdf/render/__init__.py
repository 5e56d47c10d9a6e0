"""Pictures of a material: shapes, lights, cameras, and the renderer that runs anywhere."""

from ..callable_module import make_callable
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

make_callable(__name__, render)
