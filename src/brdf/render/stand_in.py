"""A lobe of closed form that stands in for a reflectance where a shader has to draw directions."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..color import luminance
from ..geometry.directions import from_spherical
from ..geometry.sampling import CosineSampler, GGXSampler, MixtureSampler
from ..reflectance import Reflectance

Floats = NDArray[np.float64]

WIDTHS = np.geomspace(0.01, 1, 24)
"""Widths that are tried."""
VIEWS = np.radians([5.0, 35.0, 60.0, 78.0])
"""Angles between normal and viewer."""
PROPOSED = np.geomspace(0.01, 1, 8)
"""Widths of the lobes that directions are drawn by."""
DRAWN = 512
"""Directions a view."""
LEAST_SHARE = 0.05
"""Of either lobe: what the other one misses still comes to light."""


def stand_in(m: Reflectance) -> tuple[float, float]:
    """Width and share of a GGX lobe beside a diffuse one that are likeliest to have drawn the light `m` reflects.

    Directions are drawn by lobes of many widths at a few views, and weighed by f cos. Whatever the answer, pictures are
    right: it decides their noise alone.
    """
    n = np.arange(DRAWN * len(VIEWS))
    u = np.stack([(0.5 + n * 0.7548776662466927) % 1, (0.5 + n * 0.5698402909980532) % 1], -1)  # R2 sequence
    wo = from_spherical(np.repeat(VIEWS, DRAWN), 2 * np.pi * (n * 0.6180339887498949 % 1))
    uv = np.stack([n * 0.8191725133961645 % 1, n * 0.6710436067037893 % 1], -1)
    proposal = MixtureSampler([CosineSampler(), *(GGXSampler(a, a) for a in PROPOSED)], [1.0] * (1 + len(PROPOSED)))
    wi, _ = proposal.sample(wo, u)
    density = proposal.pdf(wi, wo)
    if m.transmits:  # as often below as above
        wi[n % 2 > 0, 2] *= -1
        density = density / 2
    value = np.asarray(m(wi, wo, uv) if m.varies else m(wi, wo), np.float64)
    with np.errstate(divide="ignore", invalid="ignore"):
        weight = np.nan_to_num(luminance(value) * np.abs(wi[:, 2]) / density, nan=0.0, posinf=0.0)
    usable = (weight > 0) & (np.abs(wi[:, 2]) > 1e-4)
    if not usable.any():
        return 1.0, LEAST_SHARE
    wi, wo, weight = (np.asarray(a[usable], np.float64) for a in (wi, wo, weight))
    matte = np.abs(wi[:, 2]) / np.pi * (0.5 if m.transmits else 1.0)
    best = (-np.inf, 1.0, LEAST_SHARE)
    for alpha in WIDTHS:
        lobe = lobe_density(wi, wo, float(alpha))
        share = 0.5
        for _ in range(12):  # expectation maximisation; a dozen rounds leave the share within a few percent
            mixture = share * lobe + (1 - share) * matte
            share = float(np.average(share * lobe / mixture, weights=weight))
            share = min(max(share, LEAST_SHARE), 1 - LEAST_SHARE)
        likelihood = float(np.average(np.log(share * lobe + (1 - share) * matte), weights=weight))
        best = max(best, (likelihood, float(alpha), share))
    return best[1:]


def lobe_density(wi: Floats, wo: Floats, alpha: float) -> Floats:
    """Density of `wi` [1/sr] when a visible normal of GGX mirrors `wo` (N, 3); 0 below the horizon."""
    h = wi + wo
    h = h / np.maximum(np.linalg.norm(h, axis=-1, keepdims=True), 1e-12)
    slope = (h[:, 0] ** 2 + h[:, 1] ** 2) / alpha**2 + h[:, 2] ** 2
    normals = 1 / (np.pi * alpha**2 * slope**2)
    seen = 2 * wo[:, 2] / (wo[:, 2] + np.sqrt(alpha**2 + (1 - alpha**2) * wo[:, 2] ** 2))
    density: Floats = np.where(wi[:, 2] > 0, normals * seen / (4 * wo[:, 2]), 0.0)
    return density
