"""Parameters declared once.

A class that has parameters declares them in its body: default, bounds, unit, one line of documentation. Constructor,
validation, `brdf info`, fit transforms, sliders and shader uniforms all derive from the declaration.

    class Ward(Model):
        rho: RGB = albedo("specular reflectance scale", default=0.5)
        alpha_x: Scalar = width("RMS slope along the tangent", default=0.2)
        alpha_y: Scalar = width("RMS slope along the bitangent", follows="alpha_x")
"""

from __future__ import annotations

from .declared import (
    RGB,
    CallableValue,
    Choice,
    Parameter,
    Scalar,
    Texture,
    Value,
    albedo,
    choice,
    number,
    rgb,
    texture,
    width,
)
from .parameterised import Parameterised
from .search import declaration

__all__ = [
    "RGB",
    "CallableValue",
    "Choice",
    "Parameter",
    "Parameterised",
    "Scalar",
    "Texture",
    "Value",
    "albedo",
    "choice",
    "declaration",
    "number",
    "rgb",
    "texture",
    "width",
]
