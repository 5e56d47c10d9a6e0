"""The functions a formula may call.

Each works on whatever its arguments are: Python numbers, NumPy, JAX, PyTorch or Dr.Jit arrays, traced expressions
(`graph.Expr`), and component by component on a `Vec`. Angles are in radians.
"""

from __future__ import annotations

from typing import Any

from ..errors import UnknownNameError
from .backends import backend_of
from .graph import Expr, TextureRef
from .textures import FILTERS, lookup
from .vec import Scalar, Vec, elementwise

__all__ = [
    "abs", "acos", "asin", "atan", "atan2", "clip", "cos", "cross", "dot", "erf", "exp", "floor", "length", "log",
    "maximum", "mean", "minimum", "mix", "normalize", "pow", "reflect", "saturate", "sign", "sin", "sqrt", "tan",
    "texture1d", "texture2d", "texture3d", "where",
]  # fmt: skip


def _apply(op: str, *arguments: Any) -> Any:
    return elementwise(lambda *scalars: _apply_scalar(op, *scalars), *arguments)


def _apply_scalar(op: str, *scalars: Scalar) -> Scalar:
    for s in scalars:
        if isinstance(s, Expr):
            return s.graph.call(op, *scalars)
    return getattr(backend_of(*scalars), op)(*scalars)


def sqrt(x: Any) -> Any:
    return _apply("sqrt", x)


def exp(x: Any) -> Any:
    return _apply("exp", x)


def log(x: Any) -> Any:
    """Natural logarithm."""
    return _apply("log", x)


def sin(x: Any) -> Any:
    return _apply("sin", x)


def cos(x: Any) -> Any:
    return _apply("cos", x)


def tan(x: Any) -> Any:
    return _apply("tan", x)


def asin(x: Any) -> Any:
    return _apply("asin", x)


def acos(x: Any) -> Any:
    return _apply("acos", x)


def atan(x: Any) -> Any:
    return _apply("atan", x)


def atan2(y: Any, x: Any) -> Any:
    return _apply("atan2", y, x)


def erf(x: Any) -> Any:
    """Gauss error function."""
    return _apply("erf", x)


def abs(x: Any) -> Any:
    return _apply("abs", x)


def floor(x: Any) -> Any:
    return _apply("floor", x)


def sign(x: Any) -> Any:
    """-1, 0 or 1."""
    return _apply("sign", x)


def pow(x: Any, y: Any) -> Any:
    """x to the power y for x >= 0 (as in GLSL: a negative base is undefined)."""
    return _apply("pow", x, y)


def minimum(x: Any, y: Any) -> Any:
    return _apply("minimum", x, y)


def maximum(x: Any, y: Any) -> Any:
    return _apply("maximum", x, y)


def where(condition: Any, x: Any, y: Any) -> Any:
    """x where the condition holds, else y. Both are computed: guard denominators inside x."""
    return _apply("where", condition, x, y)


def clip(x: Any, low: Any, high: Any) -> Any:
    return minimum(maximum(x, low), high)


def saturate(x: Any) -> Any:
    """Clip to [0, 1]."""
    return clip(x, 0.0, 1.0)


def mix(x: Any, y: Any, t: Any) -> Any:
    """(1 - t) x + t y."""
    return x + (y - x) * t


def dot(a: Vec, b: Vec) -> Scalar:
    total = a[0] * b[0]
    for i in range(1, len(a)):
        total = total + a[i] * b[i]
    return total


def cross(a: Vec, b: Vec) -> Vec:
    return Vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)


def length(a: Vec) -> Scalar:
    return sqrt(dot(a, a))


def normalize(a: Vec) -> Vec:
    """a over its length; the zero vector stays zero."""
    unit: Vec = a * (1.0 / sqrt(maximum(dot(a, a), 1e-30)))
    return unit


def reflect(w: Vec, h: Vec) -> Vec:
    """w mirrored about the unit vector h, both pointing away from the surface."""
    mirrored: Vec = h * (2.0 * dot(w, h)) - w
    return mirrored


def mean(a: Vec) -> Scalar:
    """The mean of the components."""
    total = a[0]
    for component in a.components[1:]:
        total = total + component
    return total / len(a)


def _texture(data: Any, *coordinates: Scalar, filter: str) -> Vec:
    if filter not in FILTERS:
        raise UnknownNameError("texture filter", filter, FILTERS)
    for u in coordinates:
        if isinstance(u, Expr):
            return u.graph.texture(data, *coordinates, filter=filter)
    if isinstance(data, TextureRef) and data.graph is not None:
        return data.graph.texture(data, *coordinates, filter=filter)
    return lookup(data, coordinates, backend_of(*coordinates), filter)


def texture1d(data: Any, u: Scalar, filter: str = "linear") -> Vec:
    """Lookup in an array (n, C): texel centres at (i + 0.5) / n, clamped to the edge. Returns C channels.

    `filter` is "nearest", "linear", "catmull-rom" or "b-spline" (see `textures`). Raises UnknownNameError.
    """
    return _texture(data, u, filter=filter)


def texture2d(data: Any, u: Scalar, v: Scalar, filter: str = "linear") -> Vec:
    """Lookup in an array (nu, nv, C), as `texture1d`."""
    return _texture(data, u, v, filter=filter)


def texture3d(data: Any, u: Scalar, v: Scalar, w: Scalar, filter: str = "linear") -> Vec:
    """Lookup in an array (nu, nv, nw, C), as `texture1d`."""
    return _texture(data, u, v, w, filter=filter)
