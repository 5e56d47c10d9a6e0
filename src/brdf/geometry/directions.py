"""Directions: spherical coordinates, half and difference angles, frames, simple distributions.

Arrays of directions have shape (..., 3); the local normal is +z. Angles are radians, polar ones measured from
the normal. Every function keeps float32 and computes anything else in float64. Angles come from two-argument
arctangents of sines and cosines, so that they are accurate near the pole as well, where an arc cosine loses half
the digits.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.floating[Any]]


class HalfDifference(NamedTuple):
    """The half vector's direction and the light's direction relative to it [rad] [Rusinkiewicz1998]."""

    theta_h: Floats
    """(...) polar angle of h, [0, pi/2]"""
    phi_h: Floats
    """(...) azimuth of h, (-pi, pi]"""
    theta_d: Floats
    """(...) angle between h and either direction, [0, pi/2]"""
    phi_d: Floats
    """(...) azimuth of wi about h, (-pi, pi]; 0 where wi lies in the plane of h and n, farther from n than h"""


def _floats(array: ArrayLike) -> Floats:
    array = np.asarray(array)
    return array if array.dtype == np.float32 else array.astype(np.float64, copy=False)


def from_spherical(theta: ArrayLike, phi: ArrayLike) -> Floats:
    """Directions (..., 3) at polar angle `theta` and azimuth `phi` [rad], which broadcast."""
    theta, phi = np.broadcast_arrays(_floats(theta), _floats(phi))
    sine = np.sin(theta)
    return np.stack([sine * np.cos(phi), sine * np.sin(phi), np.cos(theta)], axis=-1)


def pairs_from_spherical(angles: ArrayLike) -> tuple[Floats, Floats]:
    """`wi` and `wo` (N, 3) of rows (N, 4): theta and phi of the light, then of the viewer [rad]."""
    theta_i, phi_i, theta_o, phi_o = _floats(angles).T
    return from_spherical(theta_i, phi_i), from_spherical(theta_o, phi_o)


def to_spherical(w: ArrayLike) -> tuple[Floats, Floats]:
    """Polar angle in [0, pi], azimuth in (-pi, pi] [rad], each (...), of vectors (..., 3) of any length."""
    w = _floats(w)
    return np.arctan2(np.hypot(w[..., 0], w[..., 1]), w[..., 2]), np.arctan2(w[..., 1], w[..., 0])


def normalized(v: ArrayLike) -> Floats:
    """`v` (..., 3) over its length; the zero vector stays zero."""
    v = _floats(v)
    length = np.sqrt(np.einsum("...i,...i->...", v, v))[..., None]
    unit: Floats = np.divide(v, length, out=np.zeros_like(v), where=length > 0)
    return unit


def dot(a: Floats, b: Floats) -> Floats:
    """Scalar products (...) of (..., 3) and (..., 3)."""
    product: Floats = np.einsum("...i,...i->...", a, b)
    return product


def angle_between(a: ArrayLike, b: ArrayLike) -> Floats:
    """Angle [rad] in [0, pi], (...), between unit vectors (..., 3): 2 atan2(|a - b|, |a + b|) [Kahan2006]."""
    a, b = _floats(a), _floats(b)
    difference, total = a - b, a + b
    angle: Floats = 2 * np.arctan2(np.sqrt(dot(difference, difference)), np.sqrt(dot(total, total)))
    return angle


def half_vector(wi: ArrayLike, wo: ArrayLike) -> Floats:
    """The unit vector (..., 3) halfway between two directions; zero where they are opposite."""
    return normalized(_floats(wi) + _floats(wo))


def reflected(w: Floats, h: Floats) -> Floats:
    """`w` mirrored about the unit vector `h`, both (..., 3) and pointing away from the surface."""
    return 2 * dot(w, h)[..., None] * h - w


def refracted(w: Floats, eta: float) -> Floats:
    """Where `w` (..., 3) continues beyond the plane z = 0 by Snell's law, pointing away from the plane like `w`.

    `eta`: refractive index below the plane over that above. The mirrored direction where total internal reflection
    leaves no other.
    """
    ratio = np.where(w[..., 2] > 0, 1 / eta, eta).astype(w.dtype)  # n(w) / n(beyond) = sin(beyond) / sin(w)
    sine2 = ratio**2 * (w[..., 0] ** 2 + w[..., 1] ** 2)
    z = -np.copysign(np.sqrt(np.maximum(1 - sine2, 0)), w[..., 2])
    beyond = np.stack([-ratio * w[..., 0], -ratio * w[..., 1], z], axis=-1)
    mirrored = w * np.array([-1, -1, 1], w.dtype)
    return np.where((sine2 < 1)[..., None], beyond, mirrored)


def rotated(w: ArrayLike, angle: ArrayLike) -> Floats:
    """Directions (..., 3) turned by `angle` (...) [rad] about the normal, from +x towards +y."""
    w, angle = _floats(w), _floats(angle)
    cosine, sine = np.cos(angle), np.sin(angle)
    x, y, z = np.broadcast_arrays(
        cosine * w[..., 0] - sine * w[..., 1], sine * w[..., 0] + cosine * w[..., 1], w[..., 2]
    )
    return np.stack([x, y, z], axis=-1)


def to_half_difference(wi: ArrayLike, wo: ArrayLike) -> HalfDifference:
    """Half and difference angles of unit vectors (..., 3) above the horizon. Reference: Rusinkiewicz1998.

    theta_d comes from the lengths of wi - wo and wi + wo, so that it is accurate for retroreflection as well.
    """
    wi, wo = np.broadcast_arrays(_floats(wi), _floats(wo))
    total, difference = wi + wo, wi - wo
    radial = np.hypot(total[..., 0], total[..., 1])
    length = np.sqrt(dot(total, total))
    theta_h, phi_h = np.arctan2(radial, total[..., 2]), np.arctan2(total[..., 1], total[..., 0])
    theta_d = np.arctan2(np.sqrt(dot(difference, difference)), length)
    # (wi - wo) / 2 is perpendicular to h; its components along the half frame's x and y axes give phi_d
    at_pole = radial == 0
    safe = np.where(at_pole, 1, radial)
    cos_phi, sin_phi = np.where(at_pole, 1, total[..., 0] / safe), np.where(at_pole, 0, total[..., 1] / safe)
    outward = difference[..., 0] * cos_phi + difference[..., 1] * sin_phi
    along_y = difference[..., 1] * cos_phi - difference[..., 0] * sin_phi
    along_x = outward * np.cos(theta_h) - difference[..., 2] * np.sin(theta_h)
    return HalfDifference(theta_h, np.where(at_pole, 0, phi_h), theta_d, np.arctan2(along_y, along_x))


def from_half_difference(
    theta_h: ArrayLike, phi_h: ArrayLike, theta_d: ArrayLike, phi_d: ArrayLike
) -> tuple[Floats, Floats]:
    """Directions wi and wo (..., 3) of half and difference angles [rad], which broadcast.

    Not every combination lies above the horizon: there wi.z or wo.z is negative.
    """
    theta_h, phi_h, theta_d, phi_d = np.broadcast_arrays(*map(_floats, (theta_h, phi_h, theta_d, phi_d)))
    cos_h, sin_h = np.cos(theta_h), np.sin(theta_h)
    h = from_spherical(theta_h, phi_h)
    x_axis = np.stack([cos_h * np.cos(phi_h), cos_h * np.sin(phi_h), -sin_h], axis=-1)
    y_axis = np.stack([-np.sin(phi_h), np.cos(phi_h), np.zeros_like(phi_h)], axis=-1)
    aside = np.cos(phi_d)[..., None] * x_axis + np.sin(phi_d)[..., None] * y_axis
    along, across = np.cos(theta_d)[..., None] * h, np.sin(theta_d)[..., None] * aside
    return along + across, along - across


def frame(normal: ArrayLike) -> tuple[Floats, Floats]:
    """A tangent and a bitangent (..., 3) that form a right-handed frame with unit normals (..., 3).

    Continuous everywhere but across normal.z = 0; (x, y) for the normal +z. Reference: Duff2017.
    """
    n = _floats(normal)
    sign = np.copysign(n.dtype.type(1), n[..., 2])
    a = -1 / (sign + n[..., 2])
    b = n[..., 0] * n[..., 1] * a
    tangent = np.stack([1 + sign * n[..., 0] ** 2 * a, sign * b, -sign * n[..., 0]], axis=-1)
    bitangent = np.stack([b, sign + n[..., 1] ** 2 * a, -n[..., 1]], axis=-1)
    return tangent, bitangent


def cosine_weighted(u: ArrayLike) -> Floats:
    """Directions (..., 3) of density cos/pi over the upper hemisphere from numbers (..., 2) in [0, 1)."""
    u = _floats(u)
    radius, phi = np.sqrt(u[..., 0]), u.dtype.type(2 * np.pi) * u[..., 1]
    return np.stack([radius * np.cos(phi), radius * np.sin(phi), np.sqrt(1 - u[..., 0])], axis=-1)


def uniform_hemisphere(u: ArrayLike) -> Floats:
    """Directions (..., 3) of density 1 / (2 pi) over the upper hemisphere from numbers (..., 2) in [0, 1)."""
    u = _floats(u)
    z, phi = 1 - u[..., 0], u.dtype.type(2 * np.pi) * u[..., 1]
    radius = np.sqrt((1 - z) * (1 + z))
    return np.stack([radius * np.cos(phi), radius * np.sin(phi), z], axis=-1)
