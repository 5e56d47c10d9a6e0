"""Nodes at listed angles: the axes of instruments and file formats."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import ParameterError
from ...formula import Scalar, atan2, clip, where
from .base import HALF_PI, Angle, Warp

MOST_PIECES = 64
"""What a formula can hold: each piece is a handful of operations on every lookup."""

_SAME_STEP = 1e-6
"""Steps that differ by less than this share are one step: angles in files are rounded."""


@dataclass(frozen=True)
class Listed(Warp):
    """coordinate = i / (n - 1) at the i-th of n increasing `angles` [rad], linear between them.

    The first angle may be above 0: angles below it have its coordinate, as angles beyond the last have that one's. With
    an extent beyond pi the axis is an azimuth of the whole circle, from 0 on. Angles at equal steps are one piece of
    the formula.
    """

    angles: tuple[float, ...] = (0.0, HALF_PI)

    def __post_init__(self) -> None:
        super().__post_init__()
        steps = np.diff(self.angles)
        if len(self.angles) < 2 or not np.all(steps > 0) or self.angles[0] < 0 or self.angles[-1] != self.extent:
            raise ParameterError("listed angles must increase, from 0 or above to the warp's extent")
        if len(self._pieces) > MOST_PIECES:
            raise ParameterError(f"listed angles have {len(self._pieces)} different steps; {MOST_PIECES} are possible")

    @property
    def _pieces(self) -> list[tuple[int, int]]:
        """First and last node of each run of equal steps."""
        steps = np.diff(self.angles)
        ends = np.flatnonzero(np.abs(np.diff(steps)) > _SAME_STEP * steps[1:]) + 1
        knots = [0, *ends.tolist(), len(steps)]
        return list(itertools.pairwise(knots))

    def coordinate(self, angle: Angle) -> Scalar:
        turned = atan2(angle.sine, angle.cosine)
        if self.extent > math.pi:
            turned = where(angle.sine < 0.0, turned + 2 * math.pi, turned)
        u: Scalar = 0.0
        for first, last in self._pieces:
            low, high = self.angles[first], self.angles[last]
            share = (last - first) / (len(self.angles) - 1)
            u = u + clip(turned - low, 0.0, high - low) * (share / (high - low))
        return u

    def angle(self, coordinate: ArrayLike) -> NDArray[np.float64]:
        u = np.asarray(coordinate, np.float64)
        return np.interp(u, np.linspace(0, 1, len(self.angles)), self.angles)

    def density(self, angle: ArrayLike) -> NDArray[np.float64]:
        steps = np.diff(self.angles)
        piece = np.clip(np.searchsorted(self.angles, np.asarray(angle), side="right") - 1, 0, len(steps) - 1)
        return np.asarray(1 / (steps[piece] * (len(self.angles) - 1)))


def listed(angles: Any) -> Listed:
    """The warp of a list of angles [rad]."""
    values = tuple(float(angle) for angle in angles)
    return Listed(values[-1], values)
