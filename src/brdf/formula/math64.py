"""The functions of a formula for float64 kernels: the C library's, exact to the last bits."""

from __future__ import annotations

import math

from numba import njit

from .math32 import FASTMATH, maximum, minimum, where

__all__ = [
    "FASTMATH", "abs", "acos", "asin", "atan", "atan2", "cos", "erf", "exp", "floor", "log", "maximum", "minimum",
    "pow", "sign", "sin", "sqrt", "tan", "where",
]  # fmt: skip

inlined = njit(forceinline=True, error_model="numpy", nogil=True)


@inlined
def abs(x):
    return math.fabs(x)


@inlined
def sqrt(x):
    return math.sqrt(x)


@inlined
def exp(x):
    return math.exp(x)


@inlined
def log(x):
    return math.log(x)


@inlined
def sin(x):
    return math.sin(x)


@inlined
def cos(x):
    return math.cos(x)


@inlined
def tan(x):
    return math.tan(x)


@inlined
def asin(x):
    return math.asin(x)


@inlined
def acos(x):
    return math.acos(x)


@inlined
def atan(x):
    return math.atan(x)


@inlined
def atan2(y, x):
    return math.atan2(y, x)


@inlined
def erf(x):
    return math.erf(x)


@inlined
def floor(x):
    return float(math.floor(x))


@inlined
def sign(x):
    return where(x > 0.0, 1.0, where(x < 0.0, -1.0, 0.0))


@inlined
def pow(x, y):
    return x**y
