"""Directional albedo by quadrature, so that the difference of two reflectances is free of sampling noise."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..reflectance import Reflectance

Array = NDArray[np.floating[Any]]

ALBEDO_ANGLES = (0.0, 30.0, 60.0, 80.0)
"""Polar angles [degrees] at which directional albedos are compared."""


def directional_albedo(m: Reflectance, angle: float, polar: int = 96, azimuth: int = 64) -> Array:
    """(3,) share of the light from polar angle `angle` [degrees] that is reflected, by a midpoint rule over the half
    vector: d wi = 4 (wo . h) d h. A delta distribution adds what it mirrors; what is transmitted does not count.
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
    mirrored = m.delta(wo * (-1, -1, 1), wo) if m.has_delta else 0.0
    return np.asarray(np.einsum("n,nc->c", weight, m.f_cos(wi[usable], wo[None])) + mirrored)
