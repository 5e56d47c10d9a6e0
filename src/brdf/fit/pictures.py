"""The image-space loss: spheres under point lights and in an environment, compared pixel by pixel.

Pixels are compared by the cube root of their radiance, near the eye's response (Fores2012). The environment is a studio
of soft lights given by a formula, sampled at directions that are the same for every reflectance.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..geometry.directions import from_spherical, normalized
from ..metrics import sphere_lights, sphere_pairs
from ..metrics.sphere import sphere_frames
from ..reflectance import Reflectance
from .equations import Equations, Normal
from .losses import LOSSES
from .samples import Samples

Array = NDArray[np.floating[Any]]

POINT_ANGLES = (0.0, 30.0, 60.0, 90.0, 120.0)
"""Degrees between viewer and light."""
POINT_SIZE, STUDIO_SIZE = 32, 20
"""Pixels across."""
RIM = 0.02
"""Squared cosine between normal and view below which a pixel of the studio's sphere is left out."""
STUDIO_SAMPLES = 128
"""Directions from which light of the studio arrives at each pixel."""
STUDIO_LIGHTS = (((0.5, 0.6, 0.6), 40.0, 0.5), ((-0.8, 0.3, 0.5), 12.0, 0.3), ((0.0, -0.4, -0.9), 6.0, 0.2))
"""Axis (viewer's frame), concentration and share of each light: lobes exp(k (cos - 1)), the rest falls off around."""
STUDIO_IRRADIANCE = 2 * math.pi
"""Of a surface that faces all of it: twice what makes a white diffuser show 1."""

DARKEST = 1e-6
"""Radiance that counts as black: the cube root is too steep below."""


class Pixels(NamedTuple):
    """Pairs of directions, pixel by pixel."""

    wi: Array
    """(N, 3)"""
    wo: Array
    """(N, 3)"""
    share: Array
    """(N,) what f cos(theta_i) of a pair adds to its pixel's radiance"""
    first: NDArray[np.intp]
    """(M,) the first pair of each pixel"""
    weight: Array
    """(M,) of each pixel; they sum to 1, half for either kind of light"""


@functools.lru_cache(maxsize=1)
def pixels() -> Pixels:
    """All pixels of all pictures."""
    point = sphere_pairs(POINT_SIZE, POINT_ANGLES)
    lit = len(sphere_lights(POINT_SIZE, POINT_ANGLES))
    wi, wo, first = _studio()
    wi, wo = (np.concatenate([a, b]) for a, b in ((point[0], wi), (point[1], wo)))
    share = np.concatenate([np.full(lit, math.pi), np.full(len(wi) - lit, STUDIO_IRRADIANCE / STUDIO_SAMPLES)])
    weight = np.concatenate([np.full(lit, 0.5 / lit), np.full(len(first), 0.5 / len(first))])
    return Pixels(wi, wo, share, np.concatenate([np.arange(lit), lit + first]), weight)


def _studio() -> tuple[Array, Array, NDArray[np.intp]]:
    """Lit pairs of a sphere in the studio, and where each pixel's begin."""
    light = np.concatenate([_lobe(*lamp) for lamp in STUDIO_LIGHTS])
    frame = sphere_frames(STUDIO_SIZE)
    frame = frame[frame[:, 2, 2] ** 2 > RIM]
    wi = np.einsum("pij,kj->pki", frame, light)
    lit = wi[..., 2] > 1e-3
    counts = lit.sum(1)
    seen = counts > 0
    wo = np.broadcast_to(frame[:, None, :, 2], wi.shape)
    first = np.concatenate([[0], np.cumsum(counts[seen])[:-1]])
    return wi[lit].astype(np.float32), wo[lit].astype(np.float32), first


def _lobe(axis: tuple[float, float, float], concentration: float, share: float) -> Array:
    """Directions distributed as one light of the studio, on a spiral."""
    count = round(share * STUDIO_SAMPLES)
    u = (np.arange(count) + 0.5) / count
    cosine = 1 + np.log(1 - u * (1 - math.exp(-2 * concentration))) / concentration
    local = from_spherical(np.arccos(np.clip(cosine, -1, 1)), 2 * math.pi * (math.sqrt(5) - 1) / 2 * np.arange(count))
    z = np.asarray(axis) / np.linalg.norm(axis)
    x = normalized(np.cross([0.0, 1.0, 0.0], z))
    return np.asarray(local @ np.stack([x, np.cross(z, x), z]))


def radiances(m: Reflectance) -> Array:
    """(M, 3) of all pixels."""
    p = pixels()
    return np.asarray(np.add.reduceat(m.f_cos(p.wi, p.wo).astype(np.float64) * p.share[:, None], p.first))


def picture_error(reference: Array, other: Array) -> float:
    """RMS difference of the cube roots of radiances (M, 3), point lights and environment counting alike."""
    difference = np.square(_compressed(reference) - _compressed(other))
    return math.sqrt(float(np.einsum("m,mc->", pixels().weight, difference)) / 3)


def _compressed(radiance: Array) -> Array:
    return np.cbrt(np.maximum(radiance, DARKEST))


class PictureEquations:
    """As `Equations`, for the pixels of pictures; their weights have mean 1."""

    def __init__(self, m: Reflectance, reference: Array) -> None:
        """`reference`: radiances (M, 3)."""
        p = pixels()
        self._target, self._root_weight = _compressed(reference), np.sqrt(p.weight * len(p.weight))
        self._parameters = sum(np.size(v) for v in m.values.values())
        nothing = np.zeros(p.wi.shape)
        self._values = Equations(m, Samples(p.wi, p.wo, nothing, nothing + 1), LOSSES["l2"], "float64")
        self.size = self._target.size

    def __call__(self, numbers: NDArray[np.float64]) -> Normal:
        gradient = np.zeros(self._parameters)
        hessian, cost = np.zeros((self._parameters, self._parameters)), 0.0
        for ids, J, residual in self._rows(numbers):
            hessian[np.ix_(ids, ids)] += J @ J.T
            gradient[ids] += J @ residual
            cost += 0.5 * float(residual @ residual)
        return Normal(cost, gradient, hessian)

    def sandwich(
        self, numbers: NDArray[np.float64], is_monochrome: bool
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """As `covariance.sandwich`: each pixel is a measurement, of three channels or of copies of one."""
        curvature, products = np.zeros((2, self._parameters, self._parameters))
        together = np.zeros((self._parameters, len(pixels().weight)))
        for ids, J, residual in self._rows(numbers):
            scores, block = J * residual, np.ix_(ids, ids)
            curvature[block] += J @ J.T
            products[block] += scores @ scores.T
            together[ids] += scores
        return curvature, together @ together.T if is_monochrome else products

    def _rows(
        self, numbers: NDArray[np.float64]
    ) -> Iterator[tuple[list[int], NDArray[np.float64], NDArray[np.float64]]]:
        """Of each channel the numbers that act on it, the derivatives by them and the residuals of all pixels."""
        p = pixels()
        for channel, rows in enumerate(self._values.rows_at(numbers)):
            summed = np.add.reduceat(rows * p.share, p.first, axis=1)
            radiance = np.maximum(summed[-1], DARKEST)
            root = np.cbrt(radiance)
            slope = np.where(summed[-1] > DARKEST, root / (3 * radiance), 0)
            residual = self._root_weight * (root - self._target[:, channel])
            yield list(self._values.active(channel)), summed[:-1] * slope * self._root_weight, residual
