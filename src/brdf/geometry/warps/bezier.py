"""The quadratic Bezier curve over the cosine: warps with square roots alone."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import ParameterError
from ...formula import Scalar, maximum, sqrt, where
from .base import HALF_PI, Angle, Warp


@dataclass(frozen=True)
class Bezier(Warp):
    """coordinate = 1 - F(cosine), F a quadratic Bezier curve over the cosine; extent pi / 2 or pi.

        F(x) = sgn(x) (2 - 2 alpha) (1 - sqrt(1 - |x|)) - (1 - 2 alpha) x,      alpha in [0, 1]

    alpha = 1 is the identity (even cosines), 0.5841 nearly even angles, smaller values crowd the nodes at 0 (and pi);
    the density of nodes is proportional to sqrt(2) (1 - alpha) there and to alpha at 90 degrees.
    An axis up to pi maps F from [-1, 1] to [0, 1]. Reference: Mallett2016.
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

    def density(self, angle: ArrayLike) -> NDArray[np.float64]:
        angle = np.asarray(angle, np.float64)
        near_pole = (1 - self.alpha) * np.sqrt(1 + np.abs(np.cos(angle)))
        return np.asarray((near_pole - (1 - 2 * self.alpha) * np.sin(angle)) / self._width)


def identity(extent: float = HALF_PI) -> Bezier:
    """Evenly spaced cosines."""
    return Bezier(extent, 1.0)
