"""What a table stores in place of f: a transformed value that interpolates well, in few bits.

    g = (scale f - floor) cos(theta_d)^cosine_power,      stored = transform(g)

The floor (the diffuse part) and the power of the cosine take out what a coarse grid represents badly; a logarithm or a
root evens out the dynamic range. Decoding is a formula, encoding runs on NumPy arrays.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError, UnknownNameError
from ...formula import Scalar, Vec, exp, maximum, pow, sqrt

Array = NDArray[np.floating[Any]]

LEAST_COSINE = 0.02
"""cos(theta_d) below which it counts as this much."""


@dataclass(frozen=True)
class Transform:
    """Base of the transforms g -> stored; monotone. A subclass enters the registry by being defined."""

    kinds: ClassVar[dict[str, type[Transform]]] = {}

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        Transform.kinds[cls.__name__] = cls

    def encode(self, g: Array) -> Array:
        raise NotImplementedError

    def decode(self, stored: Vec) -> Vec:
        """The formula: the inverse of `encode`."""
        raise NotImplementedError

    def value(self, stored: Array) -> Array:
        """The inverse of `encode` on arrays of any shape."""
        return np.asarray(self.decode(stored))  # type: ignore[arg-type]  # formulas take arrays, too

    def slope(self, stored: Array) -> Array:
        """The derivative of `value`, not clamped at 0: a way back for nodes that decode to 0."""
        raise NotImplementedError


@dataclass(frozen=True)
class Plain(Transform):
    """stored = g."""

    def encode(self, g: Array) -> Array:
        return g

    def decode(self, stored: Vec) -> Vec:
        return stored

    def slope(self, stored: Array) -> Array:
        return np.ones_like(stored)


@dataclass(frozen=True)
class Log(Transform):
    """stored = ln(max(g, 0) + offset)."""

    offset: float = 1e-3

    def __post_init__(self) -> None:
        if not self.offset > 0:
            raise ParameterError(f"a log encoding's offset must be above 0, got {self.offset:g}")

    def encode(self, g: Array) -> Array:
        return np.log(np.maximum(g, 0) + self.offset)

    def decode(self, stored: Vec) -> Vec:
        g: Vec = maximum(exp(stored) - self.offset, 0.0)
        return g

    def slope(self, stored: Array) -> Array:
        return np.exp(stored)


@dataclass(frozen=True)
class Root(Transform):
    """stored = max(g, 0)^(1 / degree), degree 2 or 3."""

    degree: int = 2

    def __post_init__(self) -> None:
        if self.degree not in (2, 3):
            raise ParameterError(f"a root encoding's degree must be 2 or 3, got {self.degree}")

    def encode(self, g: Array) -> Array:
        return np.sqrt(np.maximum(g, 0)) if self.degree == 2 else np.cbrt(np.maximum(g, 0))

    def decode(self, stored: Vec) -> Vec:
        positive: Vec = maximum(stored, 0.0)
        return positive**self.degree

    def slope(self, stored: Array) -> Array:
        return self.degree * np.maximum(stored, 1e-3) ** (self.degree - 1)


@dataclass(frozen=True)
class Encoding:
    """The whole encoding; `scale` is 1 (units of f, 1/sr) or pi (units in which a white diffuser is 1)."""

    transform: Transform = field(default_factory=Plain)
    cosine_power: float = 0.0
    scale: float = 1.0

    def encode(self, f: Array, cos_d: Array, floor: Array) -> Array:
        """(..., 3) values f [1/sr], (...) cosines of theta_d, (3,) floor in the scale's units -> (..., 3) stored."""
        return self.transform.encode((self.scale * f - floor) * self.grazing_factor(cos_d)[..., None])

    def grazing_factor(self, cos_d: Array) -> Array:
        """cos(theta_d)^cosine_power, of any shape."""
        return np.asarray(np.maximum(cos_d, LEAST_COSINE) ** self.cosine_power)

    def decode(self, stored: Vec, cos_d: Scalar, floor: Any) -> Vec:
        """The formula: f [1/sr]. `floor` is a `Vec`, or 0 for none."""
        g = self.transform.decode(stored)
        if self.cosine_power:
            g = g * (1.0 / _power(maximum(cos_d, LEAST_COSINE), self.cosine_power))
        value: Vec = g + floor
        return value if self.scale == 1.0 else value * (1 / self.scale)

    @property
    def state(self) -> dict[str, Any]:
        """What `encoding_from` turns back into this encoding; plain JSON values."""
        transform = {"kind": type(self.transform).__name__, **asdict(self.transform)}
        return {"transform": transform, "cosine_power": self.cosine_power, "scale": self.scale}


def encoding_from(state: Mapping[str, Any]) -> Encoding:
    """The encoding that `state` describes. Raises UnknownNameError, ParameterError, KeyError, or TypeError."""
    numbers = dict(state["transform"])
    kind = numbers.pop("kind", None)
    if kind not in Transform.kinds:
        raise UnknownNameError("table encoding", str(kind), Transform.kinds)
    return Encoding(Transform.kinds[kind](**numbers), float(state["cosine_power"]), float(state["scale"]))


def _power(x: Scalar, exponent: float) -> Scalar:
    """x^exponent for x > 0; halves without a general power."""
    doubled = 2 * exponent
    if doubled == math.floor(doubled):
        whole = x ** int(exponent) if exponent >= 1 else 1.0
        return whole * sqrt(x) if doubled % 2 else whole
    return pow(x, exponent)
