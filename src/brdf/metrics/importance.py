"""Errors over importance-sampled pairs of directions: what an orthographic picture of a sphere shows, lobes resolved.

The measure is that of such pictures: the light uniform on the hemisphere, the viewer cosine-weighted. The pairs crowd
where reflectances vary: in every decade of the angle of the half vector and of the angle between light and viewer, and
at grazing viewers; their weights undo that. They depend on a seed alone, so that many tables of many materials are
measured at the same pairs.
"""

from __future__ import annotations

import functools
import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError
from ..geometry.directions import from_spherical, normalized
from ..reflectance import Reflectance
from .pairs import Pairs

Array = NDArray[np.floating[Any]]

LEAST_COSINE = 0.02
"""Cosines of all pairs exceed this: reflectances that are infinite at the horizon have no finite error beyond it."""

LEAST_ANGLE = 1e-3
"""Below this angle of the half vector, or between the directions, pairs are not crowded further [rad]."""

DISPLAY_GAMMA = 2.2

UNIFORM, HALFWAY, RETRO = 0.3, 0.5, 0.2
"""Shares of the pairs: light uniform, half vector near the normal, light near the viewer."""


class Errors(NamedTuple):
    """How far a reflectance is from a reference."""

    relative_rms: float
    """of f cos(theta_i), in parts of its RMS"""
    display_rms: float
    """of display values min(pi f cos(theta_i), 1)^(1 / 2.2)"""


@functools.lru_cache(maxsize=8)
def importance_pairs(count: int = 16384, seed: int = 0) -> Pairs:
    """`count` pairs with weights that make sums means over the measure. Raises ParameterError for a count below 1."""
    if count < 1:
        raise ParameterError(f"at least one pair is needed, got {count}")
    rng = np.random.default_rng(seed)
    wi, wo = _draw(rng, 2 * count + 256)
    above = np.flatnonzero(wi[:, 2] > LEAST_COSINE)[:count]
    while len(above) < count:  # about three quarters are above
        more = _draw(rng, 2 * count + 256)
        wi, wo = np.concatenate([wi, more[0]]), np.concatenate([wo, more[1]])
        above = np.flatnonzero(wi[:, 2] > LEAST_COSINE)[:count]
    wi, wo = wi[above], wo[above]
    weight = wo[:, 2] / _density(wi, wo)
    return Pairs(wi, wo, weight / weight.sum())


def _draw(rng: np.random.Generator, count: int) -> tuple[Array, Array]:
    """Pairs, some of whose lights are below the horizon."""
    u = rng.random((6, count))
    even = LEAST_COSINE + (1 - LEAST_COSINE) * u[0]
    weighted = np.sqrt(LEAST_COSINE**2 + (1 - LEAST_COSINE**2) * u[0])
    wo = from_spherical(np.arccos(np.where(u[1] < 0.5, even, weighted)), 2 * math.pi * u[2])
    turn = 2 * math.pi * u[3]
    small = LEAST_ANGLE * (math.pi / 2 / LEAST_ANGLE) ** u[4]
    h = from_spherical(small, turn)
    mirrored = 2 * np.sum(wo * h, -1, keepdims=True) * h - wo
    across = normalized(np.cross(wo, [[1.0, 0.0, 0.0]]))
    around = np.cos(turn)[:, None] * across + np.sin(turn)[:, None] * np.cross(wo, across)
    back = np.cos(small)[:, None] * wo + np.sin(small)[:, None] * around
    anywhere = from_spherical(np.arccos(u[4]), turn)
    kind = u[5][:, None]
    wi = np.where(kind < UNIFORM, anywhere, np.where(kind < UNIFORM + HALFWAY, mirrored, back))
    return wi / np.linalg.norm(wi, axis=-1, keepdims=True), wo


def _density(wi: Array, wo: Array) -> Array:
    """Of `_draw`, per steradian of both directions, but for a factor."""
    viewer = 0.5 / (1 - LEAST_COSINE) + wo[:, 2] / (1 - LEAST_COSINE**2)
    h, d = wi + wo, wi - wo
    cos_d = np.linalg.norm(h, axis=-1) / 2
    theta_h = np.arctan2(np.hypot(h[:, 0], h[:, 1]), h[:, 2])
    apart = 2 * np.arctan2(np.linalg.norm(d, axis=-1), 2 * cos_d)
    halfway = _crowded(theta_h) / (4 * np.maximum(cos_d, 1e-9))
    return np.asarray(viewer * (UNIFORM / (2 * math.pi) + HALFWAY * halfway + RETRO * _crowded(apart)))


def _crowded(angle: Array) -> Array:
    """Density per steradian of directions whose logarithmic angle from an axis is uniform."""
    inside = (angle >= LEAST_ANGLE) & (angle <= math.pi / 2)
    angle = np.where(inside, angle, 1.0)
    logarithm = math.log(math.pi / 2 / LEAST_ANGLE)
    return np.where(inside, 1 / (2 * math.pi * np.sin(angle) * angle * logarithm), 0.0)


def relative_rms(reference: Array, other: Array, weight: Array) -> float:
    """RMS of the difference of f cos (N, 3) in parts of the reference's RMS; 0 when both are 0 everywhere."""
    error = float(np.einsum("n,nc->", weight, np.square(other - reference)))
    norm = float(np.einsum("n,nc->", weight, np.square(reference)))
    return math.sqrt(error / norm) if norm else (0.0 if error == 0 else math.inf)


def display_rms(reference: Array, other: Array, weight: Array) -> float:
    """RMS of the difference of display values of f cos (N, 3) [1/sr]; the weights sum to 1."""
    difference = display_value(other) - display_value(reference)
    return math.sqrt(float(np.mean(np.einsum("n,nc->c", weight, np.square(difference)))))


def display_value(f_cos: Array) -> Array:
    """min(pi f cos, 1)^(1 / 2.2): a white diffuser facing the light shows 1."""
    return np.asarray(np.clip(math.pi * f_cos, 0, 1) ** (1 / DISPLAY_GAMMA))


class ErrorsAgainst:
    """Errors against one reference, which is evaluated once.

    `errors = ErrorsAgainst(m, pairs)`, then `errors(other)` for every candidate.
    """

    def __init__(self, reference: Reflectance, pairs: Pairs | None = None) -> None:
        self.pairs = pairs or importance_pairs()
        self.f_cos = np.asarray(reference.f_cos(self.pairs.wi, self.pairs.wo), np.float64)
        """(N, 3) of the reference."""

    def __call__(self, other: Reflectance) -> Errors:
        return self.of(other.f_cos(self.pairs.wi, self.pairs.wo))

    def of(self, f_cos: Array) -> Errors:
        """The errors of values (N, 3) at the pairs."""
        weight = self.pairs.weight
        return Errors(relative_rms(self.f_cos, f_cos, weight), display_rms(self.f_cos, f_cos, weight))


def importance_errors(reference: Reflectance, other: Reflectance, count: int = 16384, seed: int = 0) -> Errors:
    """Both errors at `count` pairs of that seed."""
    return ErrorsAgainst(reference, importance_pairs(count, seed))(other)
