"""A monotone spline: nodes as dense as an error asks for, anywhere along an axis."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import ParameterError
from ...formula import Scalar, clip
from .base import Angle, Warp
from .powers import Power

MOST_KNOTS = 64
"""What a formula can hold: each knot is a handful of operations on every lookup."""


@dataclass(frozen=True)
class Spline(Warp):
    """coordinate = integral of a piecewise linear density over the coordinate of another warp, `base`.

    `weights` are that density at evenly spaced coordinates of the base, in any unit: a quadratic spline through one
    knot a weight, once continuously differentiable, increasing because all weights are positive. In the formula

        u = sum over the pieces of t (q0 + t (q1 - q0) / (2 h)),      t = clip(b - b0, 0, h)

    adds up positive terms, so that single precision loses nothing. The inverse solves a quadratic equation.
    """

    base: Warp = field(default_factory=Power)
    weights: tuple[float, ...] = (1.0, 1.0)

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.base.extent != self.extent or self.base.periodic:
            raise ParameterError(f"a spline warp's base must have its extent, {self.extent:g}, and not be a circle")
        if not 2 <= len(self.weights) <= MOST_KNOTS:
            raise ParameterError(f"a spline warp has 2 to {MOST_KNOTS} weights, got {len(self.weights)}")
        if not all(0 < weight < math.inf for weight in self.weights):
            raise ParameterError("a spline warp does not increase: its weights must be positive and finite")

    @property
    def _densities(self) -> NDArray[np.float64]:
        """Of the coordinate over the base's coordinate, at the knots."""
        weights = np.array(self.weights, np.float64)
        return weights / np.mean((weights[1:] + weights[:-1]) / 2)

    def coordinate(self, angle: Angle) -> Scalar:
        b, q = self.base.coordinate(angle), self._densities.tolist()
        step = 1 / (len(q) - 1)
        u: Scalar = 0.0
        for k in range(len(q) - 1):
            t = clip(b - k * step, 0.0, step)
            u = u + t * (q[k] + t * ((q[k + 1] - q[k]) / (2 * step)))
        return u

    def angle(self, coordinate: ArrayLike) -> NDArray[np.float64]:
        u, q = np.asarray(coordinate, np.float64), self._densities
        step = 1 / (len(q) - 1)
        knots = np.concatenate([[0], np.cumsum((q[1:] + q[:-1]) / 2 * step)])
        k = np.clip(np.searchsorted(knots, u, side="right") - 1, 0, len(q) - 2)
        rest, slope = np.maximum(u - knots[k], 0), (q[k + 1] - q[k]) / step
        t = 2 * rest / (q[k] + np.sqrt(np.maximum(q[k] ** 2 + 2 * slope * rest, 0)))
        return self.base.angle(np.clip(k * step + t, 0, 1))

    def density(self, angle: ArrayLike) -> NDArray[np.float64]:
        angle = np.asarray(angle, np.float64)
        b = self.base.coordinate(Angle(np.sin(angle), np.cos(angle)))
        knots = np.linspace(0, 1, len(self.weights))
        return np.asarray(np.interp(b, knots, self._densities) * self.base.density(angle))
