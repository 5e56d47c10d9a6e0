"""Small simulated photographs of flat samples: height fields with gloss, shadows and colour."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

ACQUIRED = (0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 87.0)
BETWEEN = (5.0, 15.0, 25.0, 35.0, 45.0, 55.0, 65.0, 75.0, 84.0)
"""Angles of the light from the normal, degrees."""

SHADOW_STEPS = 48


def noise(size: int, finest: float, coarsest: float, seed: int) -> NDArray[np.float64]:
    """A periodic random field of unit variance, its structure between two sizes in texels."""
    frequency = np.hypot(np.fft.fftfreq(size)[:, None], np.fft.fftfreq(size)[None, :])
    band = (frequency < 1 / finest) & (frequency > 1 / coarsest)
    spectrum = np.fft.fft2(np.random.default_rng(seed).standard_normal((size, size)))
    field = np.fft.ifft2(spectrum * band / np.maximum(frequency, 1e-9)).real
    return field / field.std()


def weave(size: int, period: int) -> NDArray[np.float64]:
    """Two crossing sets of threads."""
    x = np.arange(size) * (2 * np.pi / period)
    over = np.sin(x[:, None] / 2) * np.sin(x[None, :] / 2) > 0
    return np.where(over, np.abs(np.sin(x))[None, :], np.abs(np.sin(x))[:, None])


HEIGHTS = {  # height in texels, albedo, specular share, exponent
    "stone": lambda n: (1.2 * noise(n, 8, 80, 1), (0.45, 0.42, 0.38), 0.02, 20),
    "plastic": lambda n: (0.7 * noise(n, 12, 48, 2), (0.06, 0.10, 0.35), 0.10, 60),
    "suede": lambda n: (0.5 * noise(n, 4, 24, 3), (0.35, 0.22, 0.12), 0.0, 1),
    "cloth": lambda n: (2.0 * weave(n, 32) + 0.2 * noise(n, 4, 16, 4), (0.12, 0.18, 0.40), 0.03, 12),
}


def photograph(name: str, size: int, elevation: float) -> NDArray[np.float32]:
    """(size, size, 3): the sample under a lamp at an angle from the normal [degrees], its light from +x."""
    fine = 2 * size  # twice as fine, then averaged: texels see part of a shadow
    height, albedo, specular, exponent = HEIGHTS[name](fine)
    theta = np.radians(elevation)
    light = np.array([np.sin(theta), 0, np.cos(theta)])
    slope_x = (np.roll(height, -1, 1) - np.roll(height, 1, 1)) / 2
    slope_y = (np.roll(height, 1, 0) - np.roll(height, -1, 0)) / 2
    n = np.stack([-slope_x, -slope_y, np.ones_like(height)], -1)
    n /= np.linalg.norm(n, axis=-1, keepdims=True)
    half = light + np.array([0, 0, 1])
    half /= np.linalg.norm(half)
    lit = np.ones_like(height)
    rise = np.cos(theta) / max(np.sin(theta), 1e-6)
    for step in range(1, SHADOW_STEPS):
        lit = np.minimum(lit, np.clip(1 + 2 * (height + step * rise - np.roll(height, -step, 1)), 0, 1))
    diffuse = np.maximum(n @ light, 0) * lit
    glossy = (exponent + 2) / (2 * np.pi) * np.maximum(n @ half, 0) ** exponent * diffuse
    spotted = np.array(albedo) * (1 + 0.2 * noise(fine, 6, 60, 9)[..., None])
    ambient = 0.03 * np.cos(theta)
    picture = np.maximum(spotted, 0.01) / np.pi * (diffuse + ambient)[..., None] + specular * glossy[..., None]
    return picture.reshape(size, 2, size, 2, 3).mean((1, 3)).astype("f4")


def photographs(name: str, size: int, elevations: tuple[float, ...] = ACQUIRED) -> NDArray[np.float32]:
    """(M, size, size, 3)."""
    return np.stack([photograph(name, size, angle) for angle in elevations])
