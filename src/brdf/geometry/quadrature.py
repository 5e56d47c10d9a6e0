"""Integration over directions: randomised point sets and product rules for the upper hemisphere.

The point sets serve samplers (an estimate and, from replicates, its error); the rules serve as references that
depend on no sampler.
"""

from __future__ import annotations

import functools
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .directions import Floats, dot, from_spherical, reflected

REPLICATES = 16
"""Independent randomisations: enough that the error estimated from them is itself good to about 20 %."""

SEED = 20_240_229
"""Fixed, so that an albedo is the same number every time it is asked for."""


class Rule(NamedTuple):
    """Nodes and weights: the integral of g over the upper hemisphere is sum(weights * g(directions))."""

    directions: Floats
    """(N, 3) unit vectors with z > 0"""
    weights: Floats
    """(N,) solid angles [sr]"""


@functools.lru_cache(maxsize=8)
def replicated_points(samples: int) -> NDArray[np.float64]:
    """About `samples` points in [0, 1)^2 as (16, n, 2): 16 independent randomisations of one well-spread set.

    n is the power of 2 nearest to samples / 16. Each replicate is a Hammersley set whose binary digits are flipped at
    random: every point is uniform, so means are unbiased, and every dyadic box of area 1/n holds one point. The
    array is read-only and always the same. References: Hammersley1964, LEcuyer2002.
    """
    bits = max(round(np.log2(max(samples, 1) / REPLICATES)), 0)
    index = np.arange(1 << bits, dtype=np.uint64)
    reversed_index = np.zeros_like(index)
    for bit in range(bits):
        reversed_index |= ((index >> np.uint64(bit)) & np.uint64(1)) << np.uint64(bits - 1 - bit)
    digits = np.stack([index, reversed_index], axis=-1) << np.uint64(52 - bits)
    flips = np.random.default_rng(SEED).integers(1 << 52, size=(REPLICATES, 1, 2), dtype=np.uint64)
    points = (digits ^ flips).astype(np.float64) * 2.0**-52
    points.flags.writeable = False
    return points


def gauss_legendre(count: int, low: float = 0.0, high: float = 1.0) -> tuple[Floats, Floats]:
    """Nodes and weights (count,) of the Gauss-Legendre rule on [low, high]."""
    nodes, weights = np.polynomial.legendre.leggauss(count)
    return low + (nodes + 1) * (high - low) / 2, weights * (high - low) / 2


def hemisphere_rule(n_theta: int = 32, n_phi: int = 64) -> Rule:
    """Gauss-Legendre over the cosine times even azimuths; exact for cos^k theta with k < 2 n_theta."""
    cosine, weight = gauss_legendre(n_theta)
    phi = (np.arange(n_phi) + 0.5) * (2 * np.pi / n_phi)
    directions = from_spherical(np.arccos(cosine)[:, None], phi)
    weights = np.broadcast_to(weight[:, None] * (2 * np.pi / n_phi), directions.shape[:2])
    return Rule(directions.reshape(-1, 3), weights.ravel())


def half_vector_rule(wo: ArrayLike, n_theta: int = 256, n_phi: int = 128) -> Rule:
    """A rule over `wi` that is dense where wi mirrors `wo` (3,): for sharp lobes, which an even rule misses.

    It runs over the half vector, 1 - cos theta_h = u^4 with Gauss-Legendre in u, even azimuths from the viewer's.
    Half vectors that mirror `wo` below the horizon are left out.
    """
    view = np.asarray(wo, np.float64)
    u, weight = gauss_legendre(n_theta)
    t, phi = u**4, (np.arange(n_phi) + 0.5) * (2 * np.pi / n_phi) + np.arctan2(view[1], view[0])
    radius = np.sqrt(t * (2 - t))[:, None]
    parts = np.broadcast_arrays(radius * np.cos(phi), radius * np.sin(phi), 1 - t[:, None])
    h = np.stack(parts, axis=-1).reshape(-1, 3)
    viewer = np.broadcast_to(view, h.shape)
    wi, wo_dot_h = reflected(viewer, h), dot(viewer, h)
    weights = np.repeat(weight * 4 * u**3, n_phi) * (2 * np.pi / n_phi) * 4 * wo_dot_h
    above = (wi[:, 2] > 0) & (wo_dot_h > 0)
    return Rule(wi[above], weights[above])
