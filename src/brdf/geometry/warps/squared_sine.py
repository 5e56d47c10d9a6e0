"""The warp of an azimuth folded to a quarter turn: even steps of its squared sine."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import ParameterError
from ...formula import Scalar
from .base import HALF_PI, Angle, Warp


@dataclass(frozen=True)
class SquaredSine(Warp):
    """coordinate = sin^2(angle), up to a quarter turn: what depends on cos(2 angle) is linear in it.

    Smooth reciprocal and mirror-symmetric reflectances depend on phi_d through

        cos theta_i cos theta_o = cos^2 theta_h cos^2 theta_d - sin^2 theta_h sin^2 theta_d cos^2 phi_d.
    """

    def __post_init__(self) -> None:
        if self.extent != HALF_PI:
            raise ParameterError(f"a squared-sine warp's extent must be pi/2, got {self.extent:g}")

    def coordinate(self, angle: Angle) -> Scalar:
        return angle.sine * angle.sine

    def angle(self, coordinate: ArrayLike) -> NDArray[np.float64]:
        return np.arcsin(np.sqrt(np.clip(np.asarray(coordinate, np.float64), 0, 1)))

    def density(self, angle: ArrayLike) -> NDArray[np.float64]:
        return np.asarray(np.sin(2 * np.asarray(angle, np.float64)))
