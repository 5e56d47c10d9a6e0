"""Warps that are powers: of the angle, of its complement, of its chord."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import ParameterError
from ...formula import Scalar, abs, atan2, maximum, minimum, pow, sqrt, where
from .base import HALF_PI, Angle, Warp


@dataclass(frozen=True)
class Power(Warp):
    """coordinate = (angle / extent)^(1 / exponent): an exponent above 1 crowds the nodes at 0.

    Exponent 1 spaces the angles evenly; 2 is the square root of MERL's theta_h axis. Reference: Matusik2003.
    """

    exponent: float = 1.0

    def __post_init__(self) -> None:
        super().__post_init__()
        check_exponent(self.exponent)

    def coordinate(self, angle: Angle) -> Scalar:
        share = minimum(atan2(angle.sine, angle.cosine) * (1 / self.extent), 1.0)
        if self.exponent == 1.0:
            return share
        return sqrt(share) if self.exponent == 2.0 else pow(share, 1 / self.exponent)

    def angle(self, coordinate: ArrayLike) -> NDArray[np.float64]:
        return self.extent * np.asarray(coordinate, np.float64) ** self.exponent

    def density(self, angle: ArrayLike) -> NDArray[np.float64]:
        return power_density(np.asarray(angle, np.float64) / self.extent, self.exponent) / self.extent


def check_exponent(exponent: float) -> None:
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
        check_exponent(self.exponent)

    def coordinate(self, angle: Angle) -> Scalar:
        rest = maximum(1.0 - atan2(angle.sine, angle.cosine) * (1 / self.extent), 0.0)
        return 1.0 - pow(rest, 1 / self.exponent)

    def angle(self, coordinate: ArrayLike) -> NDArray[np.float64]:
        return self.extent * (1 - (1 - np.asarray(coordinate, np.float64)) ** self.exponent)

    def density(self, angle: ArrayLike) -> NDArray[np.float64]:
        return power_density(1 - np.asarray(angle, np.float64) / self.extent, self.exponent) / self.extent


@dataclass(frozen=True)
class Chord(Warp):
    """coordinate = (sin(angle / 2) / sin(extent / 2))^(1 / exponent): powers of the chord, without trigonometry.

    Up to 90 degrees with exponent 2 that is (1 - cos(angle))^(1 / 4): nodes as crowded at 0 as those of MERL's square
    root, from square roots alone.
    """

    exponent: float = 2.0

    def __post_init__(self) -> None:
        super().__post_init__()
        check_exponent(self.exponent)
        if self.extent > math.pi:
            raise ParameterError(f"a chord's extent must lie in (0, pi], got {self.extent:g}")

    def coordinate(self, angle: Angle) -> Scalar:
        # 2 sin^2(angle / 2) = 1 - cosine, from the sine where the cosine rounds to 1
        acute = angle.sine * angle.sine / (1.0 + abs(angle.cosine))
        versine = where(angle.cosine < 0.0, 1.0 - angle.cosine, acute)
        share = minimum(versine * (0.5 / math.sin(self.extent / 2) ** 2), 1.0)
        return sqrt(sqrt(share)) if self.exponent == 2.0 else pow(share, 0.5 / self.exponent)

    def angle(self, coordinate: ArrayLike) -> NDArray[np.float64]:
        half_chord = np.asarray(coordinate, np.float64) ** self.exponent * math.sin(self.extent / 2)
        return 2 * np.arcsin(np.minimum(half_chord, 1))

    def density(self, angle: ArrayLike) -> NDArray[np.float64]:
        half, scale = np.asarray(angle, np.float64) / 2, math.sin(self.extent / 2)
        return power_density(np.sin(half) / scale, self.exponent) * np.cos(half) / (2 * scale)


def power_density(share: NDArray[np.float64], exponent: float) -> NDArray[np.float64]:
    """Derivative of share^(1 / exponent); infinite at 0 for exponents above 1."""
    with np.errstate(divide="ignore"):
        return np.asarray(share ** (1 / exponent - 1) / exponent)
