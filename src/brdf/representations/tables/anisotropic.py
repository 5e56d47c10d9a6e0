"""Table bases for anisotropic reflectances: the angles of an isotropic basis and the azimuth about the normal.

The azimuth comes first, so that a grid is a stack of isotropic grids, one for each azimuth. It runs around a circle:
its nodes lie at multiples of the period over their number, and the last one meets the first.

`turn` says what of the circle is stored: "full", or "half" where turning both directions by half a turn about the
normal changes nothing (true of every surface whose statistics a rotated photograph would not tell apart, and of all
microfacet models).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError
from ...formula import Vec, abs, length, sqrt, where
from ...geometry.warps import HALF_PI, Angle
from .bases import Basis, HalfBasis, NormalBasis, azimuth

Array = NDArray[np.floating[Any]]

_ABOUT_NORMAL = np.array([-1.0, -1.0, 1.0])
_ACROSS_TANGENT = np.array([1.0, -1.0, 1.0])


@dataclass(frozen=True)
class AnisotropicHalfBasis(Basis):
    """(phi_h, theta_h, theta_d, phi_d): Rusinkiewicz's four angles.

    phi_d is folded to half a turn by reciprocity alone, or (`fold="quarter-turn"`) to a quarter turn by mirror symmetry
    about the tangent, which maps (phi_h, phi_d) to (-phi_h, -phi_d). Where theta_h is 0, phi_h counts as 0 and phi_d
    from the tangent. Reference: Rusinkiewicz1998.
    """

    axes: ClassVar[tuple[str, ...]] = ("phi_h", "theta_h", "theta_d", "phi_d")

    fold: str = "half-turn"
    turn: str = "full"

    def __post_init__(self) -> None:
        if self.fold not in ("half-turn", "quarter-turn"):
            raise ParameterError(f"fold must be 'half-turn' or 'quarter-turn', got {self.fold!r}")
        _check_turn(self.turn)

    @property
    def extents(self) -> tuple[float, ...]:
        return _circle(self.turn), *HalfBasis(self.fold).extents

    def angles(self, wi: Vec, wo: Vec) -> tuple[Angle, ...]:
        h, d = wi + wo, wi - wo
        h_length = length(h)
        theta_h = Angle(sqrt(h.x * h.x + h.y * h.y) / h_length, h.z / h_length)
        theta_d = Angle(0.5 * length(d), 0.5 * h_length)
        phi_h = azimuth(h.y, h.x)
        # the difference in the frame of the half vector, whose x axis is the direction of growing theta_h
        across = theta_h.cosine * (phi_h.cosine * d.x + phi_h.sine * d.y) - theta_h.sine * d.z
        along = phi_h.cosine * d.y - phi_h.sine * d.x
        across = where(along < 0.0, -across, across)
        if self.fold == "quarter-turn":
            phi_h = Angle(where(across < 0.0, -phi_h.sine, phi_h.sine), phi_h.cosine)
            across = abs(across)
        return phi_h, theta_h, theta_d, azimuth(abs(along), across)

    def directions(self, *angles: Array) -> tuple[Array, Array]:
        phi_h, *others = np.broadcast_arrays(*angles)
        wi, wo = HalfBasis(self.fold).directions(*others)
        return turned(wi, phi_h), turned(wo, phi_h)

    def above_horizon(self, *angles: Array, margin: float) -> tuple[Array, ...]:
        return angles[0], *HalfBasis(self.fold).above_horizon(*angles[1:], margin=margin)

    def horizon(self, first: Array, third: Array) -> Array:
        return HalfBasis(self.fold).horizon(first, third)

    def jacobian(self, *angles: Array) -> Array:
        return HalfBasis(self.fold).jacobian(*angles[1:]) + 0 * angles[0]

    def images(self, wi: Array, wo: Array) -> list[tuple[Array, Array]]:
        unswapped = _images(wi, wo, self.turn, mirrored=self.fold == "quarter-turn")
        return [*unswapped, *((b, a) for a, b in unswapped)]


@dataclass(frozen=True)
class AnisotropicNormalBasis(Basis):
    """(phi_i, theta_i, theta_o, phi_delta): both polar angles, the light's azimuth and the viewer's from there.

    phi_delta runs around the whole circle (`fold="none"`, two-sided warps), or over half of it by mirror symmetry about
    the tangent (`fold="half-turn"`), which maps (phi_i, phi_delta) to (-phi_i, -phi_delta). An azimuth that is not
    defined counts as 0.
    """

    axes: ClassVar[tuple[str, ...]] = ("phi_i", "theta_i", "theta_o", "phi_delta")

    fold: str = "none"
    turn: str = "full"

    def __post_init__(self) -> None:
        if self.fold not in ("none", "half-turn"):
            raise ParameterError(f"fold must be 'none' or 'half-turn', got {self.fold!r}")
        _check_turn(self.turn)

    @property
    def extents(self) -> tuple[float, ...]:
        return _circle(self.turn), HALF_PI, HALF_PI, 2 * math.pi if self.fold == "none" else math.pi

    def angles(self, wi: Vec, wo: Vec) -> tuple[Angle, ...]:
        theta_i = Angle(sqrt(wi.x * wi.x + wi.y * wi.y), wi.z)
        theta_o = Angle(sqrt(wo.x * wo.x + wo.y * wo.y), wo.z)
        phi_i = azimuth(wi.y, wi.x)
        along = phi_i.cosine * wo.y - phi_i.sine * wo.x
        across = phi_i.cosine * wo.x + phi_i.sine * wo.y
        if self.fold == "half-turn":
            phi_i = Angle(where(along < 0.0, -phi_i.sine, phi_i.sine), phi_i.cosine)
            along = abs(along)
        return phi_i, theta_i, theta_o, azimuth(along, across)

    def directions(self, *angles: Array) -> tuple[Array, Array]:
        phi_i, *others = np.broadcast_arrays(*angles)
        wi, wo = NormalBasis().directions(*others)
        return turned(wi, phi_i), turned(wo, phi_i)

    def above_horizon(self, *angles: Array, margin: float) -> tuple[Array, ...]:
        return angles[0], *NormalBasis().above_horizon(*angles[1:], margin=margin)

    def jacobian(self, *angles: Array) -> Array:
        return NormalBasis().jacobian(*angles[1:]) + 0 * angles[0]

    def images(self, wi: Array, wo: Array) -> list[tuple[Array, Array]]:
        return _images(wi, wo, self.turn, mirrored=self.fold == "half-turn")


def _check_turn(turn: str) -> None:
    if turn not in ("full", "half"):
        raise ParameterError(f"turn must be 'full' or 'half', got {turn!r}")


def _circle(turn: str) -> float:
    return 2 * math.pi if turn == "full" else math.pi


def turned(w: Array, phi: Array) -> Array:
    """(..., 3) directions turned about the normal by (...) angles."""
    cosine, sine = np.cos(phi), np.sin(phi)
    return np.stack([cosine * w[..., 0] - sine * w[..., 1], sine * w[..., 0] + cosine * w[..., 1], w[..., 2]], -1)


def _images(wi: Array, wo: Array, turn: str, mirrored: bool) -> list[tuple[Array, Array]]:
    images = [(wi, wo)]
    if mirrored:
        images += [(a * _ACROSS_TANGENT, b * _ACROSS_TANGENT) for a, b in images]
    if turn == "half":
        images += [(a * _ABOUT_NORMAL, b * _ABOUT_NORMAL) for a, b in images]
    return images
