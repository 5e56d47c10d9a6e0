"""Table bases about the mirror direction, in which optical instruments and optical design programs tabulate scatter.

The radial angle runs from the mirror image of the light to the viewer, the azimuth about that image from the side of
the normal, counter-clockwise as seen from the viewer. A narrow reflection then lies in few nodes at any angle of
incidence.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError
from ...formula import Vec, abs, length, sqrt
from ...geometry.warps import HALF_PI, Angle
from .anisotropic import turned
from .bases import Basis, azimuth

Array = NDArray[np.floating[Any]]

_MIRROR = np.array([1.0, -1.0, 1.0])


@dataclass(frozen=True)
class SpecularBasis(Basis):
    """(theta_i, radial, azimuth): the light's polar angle and the viewer about the light's mirror image.

    The azimuth is folded to half a turn by mirror symmetry, or (`fold="none"`) runs around the circle.
    """

    axes: ClassVar[tuple[str, ...]] = ("theta_i", "radial", "azimuth")

    fold: str = "half-turn"

    def __post_init__(self) -> None:
        if self.fold not in ("half-turn", "none"):
            raise ParameterError(f"fold must be 'half-turn' or 'none', got {self.fold!r}")

    @property
    def extents(self) -> tuple[float, ...]:
        return HALF_PI, math.pi, math.pi if self.fold == "half-turn" else 2 * math.pi

    def angles(self, wi: Vec, wo: Vec) -> tuple[Angle, ...]:
        theta_i, _, radial, around = _angles(wi, wo)
        return theta_i, radial, Angle(abs(around.sine), around.cosine) if self.fold == "half-turn" else around

    def directions(self, *angles: Array) -> tuple[Array, Array]:
        theta_i, radial, around = np.broadcast_arrays(*angles)
        wi = np.stack([np.sin(theta_i), 0 * theta_i, np.cos(theta_i)], -1)
        # the mirror image is (-sin, 0, cos); (cos, 0, sin) leads from it to the normal
        along, across, ahead = np.sin(radial) * np.cos(around), np.sin(radial) * np.sin(around), np.cos(radial)
        sine, cosine = np.sin(theta_i), np.cos(theta_i)
        return wi, np.stack([cosine * along - sine * ahead, across, sine * along + cosine * ahead], -1)

    def above_horizon(self, *angles: Array, margin: float) -> tuple[Array, ...]:
        theta_i = np.minimum(angles[0], HALF_PI - 2 * margin)
        return theta_i, np.minimum(angles[1], self.horizon(theta_i, angles[2]) - margin), angles[2]

    def horizon(self, first: Array, third: Array) -> Array:
        return np.asarray(np.arctan2(np.cos(first), -np.sin(first) * np.cos(third)))

    def jacobian(self, *angles: Array) -> Array:
        theta_i, radial, around = angles
        return np.sin(theta_i) * np.sin(radial) + 0 * around

    def images(self, wi: Array, wo: Array) -> list[tuple[Array, Array]]:
        return [(wi, wo)] if self.fold == "none" else [(wi, wo), (wi * _MIRROR, wo * _MIRROR)]


@dataclass(frozen=True)
class AnisotropicSpecularBasis(Basis):
    """(phi_i, theta_i, radial, azimuth): `SpecularBasis` without a fold, and the light's azimuth."""

    axes: ClassVar[tuple[str, ...]] = ("phi_i", "theta_i", "radial", "azimuth")

    @property
    def extents(self) -> tuple[float, ...]:
        return 2 * math.pi, HALF_PI, math.pi, 2 * math.pi

    def angles(self, wi: Vec, wo: Vec) -> tuple[Angle, ...]:
        theta_i, phi_i, radial, around = _angles(wi, wo)
        return phi_i, theta_i, radial, around

    def directions(self, *angles: Array) -> tuple[Array, Array]:
        phi_i, *others = np.broadcast_arrays(*angles)
        wi, wo = SpecularBasis("none").directions(*others)
        return turned(wi, phi_i), turned(wo, phi_i)

    def above_horizon(self, *angles: Array, margin: float) -> tuple[Array, ...]:
        return angles[0], *SpecularBasis("none").above_horizon(*angles[1:], margin=margin)

    def horizon(self, first: Array, third: Array) -> Array:
        return SpecularBasis("none").horizon(first, third)

    def jacobian(self, *angles: Array) -> Array:
        return SpecularBasis("none").jacobian(*angles[1:]) + 0 * angles[0]

    def images(self, wi: Array, wo: Array) -> list[tuple[Array, Array]]:
        return [(wi, wo)]


def _angles(wi: Vec, wo: Vec) -> tuple[Angle, Angle, Angle, Angle]:
    """theta_i, phi_i, the radial angle and the azimuth about the mirror image."""
    theta_i = Angle(sqrt(wi.x * wi.x + wi.y * wi.y), wi.z)
    phi_i = azimuth(wi.y, wi.x)
    mirrored = Vec(-wi.x, -wi.y, wi.z)
    # sine and cosine of half the angle between two unit vectors are half the lengths of their difference and sum
    half_sine, half_cosine = 0.5 * length(wo - mirrored), 0.5 * length(wo + mirrored)
    radial = Angle(2.0 * half_sine * half_cosine, half_cosine * half_cosine - half_sine * half_sine)
    across = phi_i.cosine * wo.y - phi_i.sine * wo.x
    along = theta_i.cosine * (phi_i.cosine * wo.x + phi_i.sine * wo.y) + theta_i.sine * wo.z
    return theta_i, phi_i, radial, azimuth(across, along)
