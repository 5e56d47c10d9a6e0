"""Isotropic table bases without a wasted entry: barycentric coordinates on a triangle, unfolded to a box of angles.

All of them are reciprocal and mirror symmetric: each place of the grid stands for four pairs of directions. Their
angles come from square roots of what two directions give without loss.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from ...formula import Vec, abs, maximum, minimum, sqrt, where
from ...geometry.warps import HALF_PI, Angle
from .bases import Basis, HalfBasis, NormalBasis, azimuth

Array = NDArray[np.floating[Any]]

_QUARTER = HalfBasis("quarter-turn")


@dataclass(frozen=True)
class _Reciprocal(Basis):
    """What the bases here share."""

    def images(self, wi: Array, wo: Array) -> list[tuple[Array, Array]]:
        return _QUARTER.images(wi, wo)


@dataclass(frozen=True)
class ShearedBasis(_Reciprocal):
    """(theta_max, rho, phi_delta): the larger polar angle, the smaller one as a share of it, the azimuth between.

    sin rho = sin theta_min / sin theta_max. For what follows neither the half vector nor one of the directions.
    """

    axes: ClassVar[tuple[str, ...]] = ("theta_max", "rho", "phi_delta")

    @property
    def extents(self) -> tuple[float, ...]:
        return HALF_PI, HALF_PI, math.pi

    def angles(self, wi: Vec, wo: Vec) -> tuple[Angle, ...]:
        i, o = wi.x * wi.x + wi.y * wi.y, wo.x * wo.x + wo.y * wo.y
        theta_max = Angle(sqrt(maximum(i, o)), minimum(wi.z, wo.z))
        rho = azimuth(sqrt(minimum(i, o)), sqrt(abs((wi.z - wo.z) * (wi.z + wo.z))))
        return theta_max, rho, NormalBasis().angles(wi, wo)[2]

    def directions(self, *angles: Array) -> tuple[Array, Array]:
        theta_max, rho, phi = np.broadcast_arrays(*angles)
        return NormalBasis().directions(theta_max, np.arcsin(np.sin(theta_max) * np.sin(rho)), phi)

    def above_horizon(self, *angles: Array, margin: float) -> tuple[Array, ...]:
        return np.minimum(angles[0], HALF_PI - margin), *angles[1:]

    def jacobian(self, *angles: Array) -> Array:
        theta_max, rho, _ = angles
        smaller = np.sin(theta_max) * np.sin(rho)
        return np.asarray(np.sin(theta_max) ** 2 * np.cos(rho) * smaller / np.sqrt(1 - smaller**2))


@dataclass(frozen=True)
class MarschnerBasis(_Reciprocal):
    """(a, b, phi_delta) over the triangle of P = cos theta_i cos theta_o and Q = sin theta_i sin theta_o.

    P + Q = cos(theta_i - theta_o) <= 1. Unfolded: cos a = P and sin b = Q / (1 - P), that is

        sin^2 a = sin^2 theta_i + sin^2 theta_o - Q^2,      tan b = Q / |cos theta_i - cos theta_o|.

    Reference: Marschner1998.
    """

    axes: ClassVar[tuple[str, ...]] = ("a", "b", "phi_delta")

    @property
    def extents(self) -> tuple[float, ...]:
        return HALF_PI, HALF_PI, math.pi

    def angles(self, wi: Vec, wo: Vec) -> tuple[Angle, ...]:
        i, o = wi.x * wi.x + wi.y * wi.y, wo.x * wo.x + wo.y * wo.y
        a = Angle(sqrt(i + o - i * o), wi.z * wo.z)
        return a, azimuth(sqrt(i * o), abs(wi.z - wo.z)), NormalBasis().angles(wi, wo)[2]

    def directions(self, *angles: Array) -> tuple[Array, Array]:
        a, b, phi = np.broadcast_arrays(*angles)
        apart = 2 * np.sin(a / 2) ** 2 * np.cos(b)
        total = np.sqrt(apart**2 + 4 * np.maximum(np.cos(a), 0))
        larger, smaller = (total + apart) / 2, (total - apart) / 2
        return NormalBasis().directions(_arccos(larger, apart, a, b), np.arccos(np.clip(smaller, 0, 1)), phi)

    def above_horizon(self, *angles: Array, margin: float) -> tuple[Array, ...]:
        return np.minimum(angles[0], HALF_PI - margin), *angles[1:]

    def jacobian(self, *angles: Array) -> Array:
        a, b, _ = angles
        rest = 2 * np.sin(a / 2) ** 2  # 1 - P
        return np.asarray(
            np.sin(a) * rest * np.sin(b) / np.sqrt((rest * np.cos(b)) ** 2 + 4 * np.maximum(np.cos(a), 0))
        )


@dataclass(frozen=True)
class StarkBasis(_Reciprocal):
    """(theta_h, theta_d, psi) over the triangle of the halfway vector h = (wi + wo) / 2 and d = (wi - wo) / 2.

    Its barycentric coordinates h_z^2, h_x^2 + h_y^2 and |d|^2 add up to 1; on the triangle theta_h and theta_d run
    from edge to edge. The third coordinate is measured from the horizon, so that nothing lies below it:

        cos psi = |cos theta_o - cos theta_i| / (2 min(sin theta_h sin theta_d, cos theta_h cos theta_d)).

    Reference: Stark2005.
    """

    axes: ClassVar[tuple[str, ...]] = ("theta_h", "theta_d", "psi")

    @property
    def extents(self) -> tuple[float, ...]:
        return HALF_PI, HALF_PI, HALF_PI

    def angles(self, wi: Vec, wo: Vec) -> tuple[Angle, ...]:
        theta_h, theta_d, _ = _QUARTER.angles(wi, wo)
        is_steep = theta_h.sine * theta_d.sine < theta_h.cosine * theta_d.cosine
        sine = abs(wi.y * wo.x - wi.x * wo.y) / theta_d.cosine
        to_horizon = 2.0 * sqrt(maximum(wi.z * wo.z, 0.0))
        return theta_h, theta_d, azimuth(where(is_steep, sine, to_horizon), abs(wo.z - wi.z))

    def directions(self, *angles: Array) -> tuple[Array, Array]:
        first, second, psi = np.broadcast_arrays(*angles)
        return _QUARTER.directions(first, second, np.arccos(_reach(first, second) * np.cos(psi)))

    def above_horizon(self, *angles: Array, margin: float) -> tuple[Array, ...]:
        first, second, psi = np.broadcast_arrays(*angles)
        first, second = np.minimum(first, HALF_PI - 2 * margin), np.minimum(second, HALF_PI - 2 * margin)
        height = np.cos(first) * np.cos(second)
        least = np.arccos(np.clip(1 - margin / height, 0, 1))
        return first, second, np.where(_reach(first, second) < 1, np.maximum(psi, least), psi)

    def jacobian(self, *angles: Array) -> Array:
        first, second, psi = angles
        reach = _reach(first, second)
        azimuth_sine = np.sqrt(1 - (reach * np.cos(psi)) ** 2)
        slope = np.where(reach < 1, reach * np.sin(psi) / np.maximum(azimuth_sine, 1e-300), 1.0)
        return np.asarray(slope * _QUARTER.jacobian(first, second, np.arccos(reach * np.cos(psi))))


def _reach(theta_h: Array, theta_d: Array) -> Array:
    """The largest |cos phi_d| above the horizon."""
    sines, cosines = np.sin(theta_h) * np.sin(theta_d), np.cos(theta_h) * np.cos(theta_d)
    return np.asarray(np.minimum(1, np.maximum(cosines, 0) / np.maximum(sines, 1e-300)))


def _arccos(larger: Array, apart: Array, a: Array, b: Array) -> Array:
    """The smaller polar angle: from its sine where its cosine rounds to 1."""
    sine = np.divide(
        2 * np.sin(a / 2) ** 2 * np.sin(b),
        np.sqrt(np.maximum(1 - (larger - apart) ** 2, 0)),
        out=np.zeros_like(larger),
        where=larger - apart < 1,
    )
    return np.where(larger > 0.7, np.arcsin(np.clip(sine, 0, 1)), np.arccos(np.clip(larger, 0, 1)))
