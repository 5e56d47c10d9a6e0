"""Axis parameterisations: where the nodes of a table's axis lie.

A warp is a monotone map between an angle and a coordinate in [0, 1]. `coordinate` is a formula (it runs on every
array library and traces into shaders) of the angle's sine and cosine, because those are what two directions give
without loss; `angle` is its inverse on NumPy arrays and places the nodes. Angles beyond the last node have the last
node's coordinate.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import ParameterError, UnknownNameError
from ..formula import Scalar, abs, atan2, floor, maximum, minimum, pow, sqrt, where

HALF_PI = math.pi / 2


class Angle(NamedTuple):
    """An angle as a formula knows it: `sine` and `cosine`, of unit norm together.

    In [0, pi], with `sine` >= 0, but for the axes of a whole circle (`Circle`, `TwoSided`).
    """

    sine: Scalar
    cosine: Scalar


@dataclass(frozen=True)
class Warp:
    """Base of the warps. `extent` is the angle of the last node [rad]; that of the first is 0.

    A subclass is a frozen dataclass that gives `coordinate` and `angle`; it enters the registry by being defined.
    """

    kinds: ClassVar[dict[str, type[Warp]]] = {}
    periodic: ClassVar[bool] = False
    """Whether coordinate 1 is coordinate 0 again."""

    extent: float = HALF_PI

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        Warp.kinds[cls.__name__] = cls

    def __post_init__(self) -> None:
        if not 0 < self.extent <= 2 * math.pi:
            raise ParameterError(f"a warp's extent must lie in (0, 2 pi], got {self.extent:g}")

    def coordinate(self, angle: Angle) -> Scalar:
        """The formula: the coordinate in [0, 1]."""
        raise NotImplementedError

    def angle(self, coordinate: ArrayLike) -> NDArray[np.float64]:
        """The angle [rad] at coordinates in [0, 1], any shape."""
        raise NotImplementedError

    def nodes(self, count: int) -> NDArray[np.float64]:
        """The angles [rad] of `count` nodes, (count,)."""
        return self.angle(np.linspace(0.0, 1.0, count))

    @property
    def state(self) -> dict[str, Any]:
        """What `warp_from` turns back into this warp; plain JSON values."""
        return {"kind": type(self).__name__, **asdict(self)}


def warp_from(state: Mapping[str, Any]) -> Warp:
    """The warp that `state` describes. Raises UnknownNameError, ParameterError, or TypeError for a wrong number."""
    numbers = dict(state)
    kind = numbers.pop("kind", None)
    if kind not in Warp.kinds:
        raise UnknownNameError("axis warp", str(kind), Warp.kinds)
    if "half" in numbers:
        numbers["half"] = warp_from(numbers["half"])
    return Warp.kinds[kind](**numbers)


@dataclass(frozen=True)
class Power(Warp):
    """coordinate = (angle / extent)^(1 / exponent): an exponent above 1 crowds the nodes at 0.

    Exponent 1 spaces the angles evenly; 2 is the square root of MERL's theta_h axis. Reference: Matusik2003.
    """

    exponent: float = 1.0

    def __post_init__(self) -> None:
        super().__post_init__()
        _check_exponent(self.exponent)

    def coordinate(self, angle: Angle) -> Scalar:
        share = minimum(atan2(angle.sine, angle.cosine) * (1 / self.extent), 1.0)
        if self.exponent == 1.0:
            return share
        return sqrt(share) if self.exponent == 2.0 else pow(share, 1 / self.exponent)

    def angle(self, coordinate: ArrayLike) -> NDArray[np.float64]:
        return self.extent * np.asarray(coordinate, np.float64) ** self.exponent


def _check_exponent(exponent: float) -> None:
    if not 0 < exponent <= 16:
        raise ParameterError(f"a power warp's exponent must lie in (0, 16], got {exponent:g}")


def uniform(extent: float = HALF_PI) -> Power:
    """Evenly spaced angles."""
    return Power(extent, 1.0)


def square_root(extent: float = HALF_PI) -> Power:
    """MERL's theta_h axis: nodes crowd quadratically at 0."""
    return Power(extent, 2.0)


@dataclass(frozen=True)
class FarPower(Warp):
    """coordinate = 1 - (1 - angle / extent)^(1 / exponent): an exponent above 1 crowds the nodes at the far end.

    For theta_d, where Fresnel reflectance and masking change fastest at the far end.
    """

    exponent: float = 1.3

    def __post_init__(self) -> None:
        super().__post_init__()
        _check_exponent(self.exponent)

    def coordinate(self, angle: Angle) -> Scalar:
        rest = maximum(1.0 - atan2(angle.sine, angle.cosine) * (1 / self.extent), 0.0)
        return 1.0 - pow(rest, 1 / self.exponent)

    def angle(self, coordinate: ArrayLike) -> NDArray[np.float64]:
        return self.extent * (1 - (1 - np.asarray(coordinate, np.float64)) ** self.exponent)


@dataclass(frozen=True)
class Bezier(Warp):
    """coordinate = 1 - F(cosine), F a quadratic Bezier curve over the cosine; extent pi / 2 or pi.

        F(x) = sgn(x) (2 - 2 alpha) (1 - sqrt(1 - |x|)) - (1 - 2 alpha) x,      alpha in [0, 1]

    alpha = 1 is the identity (even cosines), 0.5841 nearly even angles, smaller values crowd the nodes at 0 (and pi).
    An axis up to pi maps F from [-1, 1] to [0, 1].
    """

    alpha: float = 0.65

    def __post_init__(self) -> None:
        if not 0 <= self.alpha <= 1:
            raise ParameterError(f"a Bezier warp's alpha must lie in [0, 1], got {self.alpha:g}")
        if self.extent not in (HALF_PI, math.pi):
            raise ParameterError(f"a Bezier warp's extent must be pi/2 or pi, got {self.extent:g}")

    @property
    def _width(self) -> float:
        """What F spans over the axis."""
        return 1.0 if self.extent == HALF_PI else 2.0

    def coordinate(self, angle: Angle) -> Scalar:
        x = angle.cosine if self.extent == math.pi else maximum(angle.cosine, 0.0)
        size = maximum(x, -x)
        # 1 - |x| from the sine: accurate where the cosine rounds to 1
        complement = angle.sine * angle.sine / (1.0 + size)
        height = (2 - 2 * self.alpha) * (1.0 - sqrt(complement)) - (1 - 2 * self.alpha) * size
        return (1.0 - where(x < 0.0, -height, height)) * (1 / self._width)

    def angle(self, coordinate: ArrayLike) -> NDArray[np.float64]:
        s = 1 - self._width * np.asarray(coordinate, np.float64)
        y = np.abs(s)
        denominator = self.alpha + np.sqrt(np.maximum(self.alpha**2 + (1 - 2 * self.alpha) * y, 0))
        t = np.divide(y, denominator, out=np.zeros_like(y), where=denominator > 0)
        # cos = t (2 - t), so that 1 - cos = (1 - t)^2 = 2 sin^2(angle / 2)
        near_pole = 2 * np.arcsin(np.clip((1 - t) / math.sqrt(2), 0, 1))
        return np.where(s >= 0, near_pole, math.pi - near_pole)


@dataclass(frozen=True)
class Circle(Warp):
    """An azimuth of period `extent` (pi or 2 pi), evenly spaced: node i of n at extent i / n."""

    periodic: ClassVar[bool] = True

    extent: float = 2 * math.pi

    def __post_init__(self) -> None:
        if self.extent not in (math.pi, 2 * math.pi):
            raise ParameterError(f"a circle's extent must be pi or 2 pi, got {self.extent:g}")

    def coordinate(self, angle: Angle) -> Scalar:
        turns = atan2(angle.sine, angle.cosine) * (1 / self.extent)
        return turns - floor(turns)

    def angle(self, coordinate: ArrayLike) -> NDArray[np.float64]:
        return self.extent * np.asarray(coordinate, np.float64)

    def nodes(self, count: int) -> NDArray[np.float64]:
        return self.angle(np.arange(count) / count)


@dataclass(frozen=True)
class TwoSided(Warp):
    """A warp of [0, pi] and its mirror image over [pi, 2 pi]; the last node is the first one again."""

    extent: float = 2 * math.pi
    half: Warp = field(default_factory=lambda: Power(math.pi))

    def __post_init__(self) -> None:
        if self.extent != 2 * math.pi or self.half.extent != math.pi or self.half.periodic:
            raise ParameterError("a two-sided warp has extent 2 pi and is made of a warp of extent pi")

    def coordinate(self, angle: Angle) -> Scalar:
        share = 0.5 * self.half.coordinate(Angle(abs(angle.sine), angle.cosine))
        return where(angle.sine < 0.0, 1.0 - share, share)

    def angle(self, coordinate: ArrayLike) -> NDArray[np.float64]:
        u = np.asarray(coordinate, np.float64)
        near = self.half.angle(1 - np.abs(2 * u - 1))
        return np.where(u > 0.5, 2 * math.pi - near, near)

    @property
    def state(self) -> dict[str, Any]:
        return {"kind": type(self).__name__, "half": self.half.state}
