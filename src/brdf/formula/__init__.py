"""The formula compiler: written once in plain Python, a reflectance runs, differentiates and prints everywhere."""

from .backends import pi
from .ops import (  # fmt: skip
    abs,
    acos,
    asin,
    atan,
    atan2,
    clip,
    cos,
    cross,
    dot,
    erf,
    exp,
    floor,
    length,
    log,
    maximum,
    mean,
    minimum,
    mix,
    normalize,
    pow,
    reflect,
    saturate,
    sign,
    sin,
    sqrt,
    tan,
    texture1d,
    texture2d,
    texture3d,
    where,
)
from .vec import Scalar, Vec

__all__ = [
    "Scalar", "Vec", "abs", "acos", "asin", "atan", "atan2", "clip", "cos", "cross", "dot", "erf", "exp", "floor",
    "length", "log", "maximum", "mean", "minimum", "mix", "normalize", "pi", "pow", "reflect", "saturate", "sign",
    "sin", "sqrt", "tan", "texture1d", "texture2d", "texture3d", "where",
]  # fmt: skip
