"""How far one reflectance is from another: in pictures of a sphere, and over pairs of directions.

The picture protocol, used for every PSNR the package quotes: an orthographic view of a sphere, one light at angles
0, 5, …, 175 degrees from the viewer, radiance pi f cos(theta_i) (a white diffuser facing the light shows 1), pixels
that are lit and visible only. PSNR compares the sRGB values of the radiance clamped to [0, 1]; the relative RMSE
compares the unclamped radiance, ||a - b|| / ||a||. Both pool all pixels, channels and light angles.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .color import srgb_encode
from .errors import ParameterError
from .reflectance import Reflectance

Array = NDArray[np.floating[Any]]

LIGHT_ANGLES = tuple(range(0, 180, 5))
"""Degrees between the direction to the light and to the viewer."""

SPHERE_SIZE = 128
"""Pixels across the sphere's picture."""

LOG_OFFSET = 1e-3
"""Added to f cos(theta_i) [1/sr] before the logarithm of the log-relative metric."""

ALBEDO_ANGLES = (0.0, 30.0, 60.0, 80.0)
"""Polar angles [degrees] at which directional albedos are compared."""


class Pairs(NamedTuple):
    """Directions to compare at."""

    wi: Array
    """(N, 3)"""
    wo: Array
    """(N, 3)"""
    weight: Array
    """(N,) share of each pair; they sum to 1"""


# ---- the sphere --------------------------------------------------------------------------------------------------


@functools.lru_cache(maxsize=4)
def sphere_pairs(size: int = SPHERE_SIZE, angles: tuple[float, ...] = LIGHT_ANGLES) -> tuple[Array, Array]:
    """(wi, wo), each (N, 3) float32: the local directions of all lit pixels of `size` x `size` pictures, one a light.

    The sphere's tangent runs along its circles of latitude about the picture's vertical axis; the light turns in the
    horizontal plane. Raises ParameterError for a size below 2.
    """
    if size < 2:
        raise ParameterError(f"a sphere's picture needs at least 2 pixels, got {size}")
    axis = (2 * np.arange(size) + 1) / size - 1
    x, y = np.meshgrid(axis, axis)
    inside = x * x + y * y < 1
    x, y = x[inside], y[inside]
    normal = np.stack([x, y, np.sqrt(1 - x * x - y * y)], -1)
    tangent = np.stack([normal[:, 2], np.zeros_like(x), -x], -1)
    tangent /= np.linalg.norm(tangent, axis=-1, keepdims=True)
    frame = np.stack([tangent, np.cross(normal, tangent), normal], 1)
    wo = frame[:, :, 2]  # the viewer looks along the picture's z axis
    lights, views = [], []
    for phi in np.radians(angles):
        wi = frame @ np.array([np.sin(phi), 0.0, np.cos(phi)])
        lit = wi[:, 2] > 0
        lights.append(wi[lit])
        views.append(wo[lit])
    return np.concatenate(lights).astype(np.float32), np.concatenate(views).astype(np.float32)


def sphere_radiance(m: Reflectance, size: int = SPHERE_SIZE, angles: tuple[float, ...] = LIGHT_ANGLES) -> Array:
    """(N, 3) radiance pi f cos(theta_i) of the lit pixels of `sphere_pairs`."""
    return np.asarray(math.pi * m.f_cos(*sphere_pairs(size, angles)))


def psnr_of(reference: Array, other: Array) -> float:
    """PSNR [dB] between radiances (any shape): sRGB of the values clamped to [0, 1], peak 1; inf when they agree."""
    difference = srgb_encode(reference) - srgb_encode(other)
    mean_square = float(np.mean(np.square(difference, dtype=np.float64)))
    return -10 * math.log10(mean_square) if mean_square else math.inf


def relative_rmse_of(reference: Array, other: Array) -> float:
    """||reference - other|| / ||reference||, linear; 0 when both are 0 everywhere."""
    error = math.sqrt(float(np.sum(np.square(reference - other, dtype=np.float64))))
    norm = math.sqrt(float(np.sum(np.square(reference, dtype=np.float64))))
    return error / norm if norm else (0.0 if error == 0 else math.inf)


def psnr(reference: Reflectance, other: Reflectance, size: int = SPHERE_SIZE) -> float:
    """PSNR [dB] between pictures of a sphere (see the module); inf when they are identical."""
    return psnr_of(sphere_radiance(reference, size), sphere_radiance(other, size))


def relative_rmse(reference: Reflectance, other: Reflectance, size: int = SPHERE_SIZE) -> float:
    """Relative RMSE between pictures of a sphere (see the module)."""
    return relative_rmse_of(sphere_radiance(reference, size), sphere_radiance(other, size))


# ---- pairs of directions -----------------------------------------------------------------------------------------


@functools.lru_cache(maxsize=4)
def direction_pairs(polar: int = 40, difference: int = 24, azimuth: int = 64) -> Pairs:
    """Pairs spread over both hemispheres with the measure d wi d wo, dense where highlights are.

    A midpoint rule over (theta_h, theta_d, phi_d), theta_h warped by a square, theta_d up to the horizon, with the
    Jacobian 4 cos(theta_d) sin(theta_h) sin(theta_d); the azimuth of h advances by the golden ratio from pair to pair,
    so that anisotropic reflectances are seen from all sides.
    """
    u, v, w = np.meshgrid(*(((np.arange(n) + 0.5) / n) for n in (polar, difference, azimuth)), indexing="ij")
    theta_h, phi_d = u * u * math.pi / 2, w * 2 * math.pi
    horizon = np.arctan2(np.cos(theta_h), np.sin(theta_h) * np.abs(np.cos(phi_d)))
    theta_d = v * horizon
    weight = 4 * np.cos(theta_d) * np.sin(theta_h) * np.sin(theta_d) * u * horizon
    phi_h = 2 * math.pi * ((math.sqrt(5) - 1) / 2 * np.arange(u.size).reshape(u.shape) % 1)
    across = np.sin(theta_d) * np.cos(phi_d)
    offset = np.stack([across * np.cos(theta_h), np.sin(theta_d) * np.sin(phi_d), -across * np.sin(theta_h)], -1)
    half = np.cos(theta_d)[..., None] * np.stack([np.sin(theta_h), 0 * theta_h, np.cos(theta_h)], -1)
    wi, wo = (_turned(half + sign * offset, phi_h) for sign in (1, -1))
    return Pairs(wi.reshape(-1, 3), wo.reshape(-1, 3), weight.ravel() / weight.sum())


def _turned(w: Array, phi: Array) -> Array:
    """Directions turned by phi about the normal."""
    c, s = np.cos(phi), np.sin(phi)
    return np.stack([c * w[..., 0] - s * w[..., 1], s * w[..., 0] + c * w[..., 1], w[..., 2]], -1)


Metric = Callable[[Array, Array, Array], float]


def _rms(difference: Array, weight: Array) -> float:
    return math.sqrt(float(np.mean(np.einsum("n,nc->c", weight, np.square(difference)))))


def cosine_weighted_l2(a: Array, b: Array, weight: Array) -> float:
    """RMS of f_a cos - f_b cos [1/sr]. Reference: Ngan2005."""
    return _rms(a - b, weight)


def logarithmic(a: Array, b: Array, weight: Array) -> float:
    """RMS of ln(1 + f_a cos) - ln(1 + f_b cos). Reference: Low2012."""
    return _rms(np.log1p(a) - np.log1p(b), weight)


def cube_root(a: Array, b: Array, weight: Array) -> float:
    """RMS of (f_a cos)^(1/3) - (f_b cos)^(1/3). Reference: Fores2012."""
    return _rms(np.cbrt(a) - np.cbrt(b), weight)


def log_relative(a: Array, b: Array, weight: Array) -> float:
    """Mean of |ln (f_a cos + e) / (f_b cos + e)|, e = 1e-3: about the mean relative error where f cos >> e."""
    difference = np.abs(np.log((a + LOG_OFFSET) / (b + LOG_OFFSET)))
    return float(np.mean(np.einsum("n,nc->c", weight, difference)))


METRICS: dict[str, Metric] = {
    "cosine-weighted L2": cosine_weighted_l2,
    "log": logarithmic,
    "cube root": cube_root,
    "log relative": log_relative,
}
"""Metrics over pairs of directions by name: of f_a cos, f_b cos (N, 3) and the pairs' weights (N,)."""


def direction_metrics(a: Reflectance, b: Reflectance) -> dict[str, float]:
    """Every metric of `METRICS` between two reflectances, over `direction_pairs`."""
    wi, wo, weight = direction_pairs()
    values = a.f_cos(wi, wo), b.f_cos(wi, wo)
    return {name: metric(*values, weight) for name, metric in METRICS.items()}


# ---- albedo ------------------------------------------------------------------------------------------------------


def directional_albedo(m: Reflectance, angle: float, polar: int = 96, azimuth: int = 64) -> Array:
    """(3,) albedo for light from polar angle `angle` [degrees], by a midpoint rule over the half vector.

    Deterministic, so that the difference of two reflectances is free of sampling noise; d wi = 4 (wo . h) d h.
    """
    u, v = np.meshgrid((np.arange(polar) + 0.5) / polar, (np.arange(azimuth) + 0.5) / azimuth, indexing="ij")
    theta, phi = u * u * math.pi / 2, v * 2 * math.pi
    h = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], -1).reshape(-1, 3)
    wo = np.array([math.sin(math.radians(angle)), 0.0, math.cos(math.radians(angle))])
    cosine = h @ wo
    wi = 2 * cosine[:, None] * h - wo
    measure = (math.pi / 2 * 2 * u / polar * 2 * math.pi / azimuth * np.sin(theta)).ravel()
    usable = (cosine > 0) & (wi[:, 2] > 0)
    weight = 4 * cosine[usable] * measure[usable]
    return np.asarray(np.einsum("n,nc->c", weight, m.f_cos(wi[usable], wo[None])))


# ---- everything --------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Comparison:
    """How far `other` is from `reference`."""

    reference: str
    other: str
    psnr: float
    """dB, pictures of a sphere"""
    relative_rmse: float
    """linear pictures of a sphere"""
    albedo_difference: float
    """largest |difference| of directional albedo over channels and 0, 30, 60, 80 degrees"""
    bytes: tuple[int, int]
    """memory of reference and other"""
    metrics: dict[str, float] = field(default_factory=dict)
    """metrics over pairs of directions by name (see `METRICS`)"""

    def rows(self) -> list[tuple[str, str]]:
        """(what, value) lines."""
        return [
            ("PSNR [dB]", f"{self.psnr:.1f}"),
            ("relative RMSE", f"{self.relative_rmse:.3g}"),
            ("albedo difference", f"{self.albedo_difference:.3g}"),
            *((name, f"{value:.3g}") for name, value in self.metrics.items()),
            ("bytes", f"{self.bytes[0]:,} -> {self.bytes[1]:,}"),
        ]

    def table(self) -> str:
        """A small text table."""
        rows = self.rows()
        width = max(len(what) for what, _ in rows)
        lines = [f"{what:<{width}}  {value}" for what, value in rows]
        return "\n".join([f"{self.reference} -> {self.other}", *lines])


def compare(a: Reflectance, b: Reflectance, size: int = SPHERE_SIZE) -> Comparison:
    """How far `b` is from `a`, in every metric; `size` is the resolution of the sphere's pictures."""
    radiances = sphere_radiance(a, size), sphere_radiance(b, size)
    albedos = [(directional_albedo(a, angle), directional_albedo(b, angle)) for angle in ALBEDO_ANGLES]
    return Comparison(
        reference=a.name or type(a).__name__,
        other=b.name or type(b).__name__,
        psnr=psnr_of(*radiances),
        relative_rmse=relative_rmse_of(*radiances),
        albedo_difference=float(max(np.abs(x - y).max() for x, y in albedos)),
        bytes=(a.nbytes, b.nbytes),
        metrics=direction_metrics(a, b),
    )
