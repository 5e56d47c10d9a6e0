"""Warps of axes that run around a circle."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import ParameterError
from ...formula import Scalar, abs, atan2, floor, where
from .base import Angle, Warp
from .powers import Power


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

    def density(self, angle: ArrayLike) -> NDArray[np.float64]:
        return np.full(np.shape(angle), 1 / self.extent)

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

    def density(self, angle: ArrayLike) -> NDArray[np.float64]:
        angle = np.asarray(angle, np.float64)
        return 0.5 * self.half.density(math.pi - np.abs(math.pi - angle))
