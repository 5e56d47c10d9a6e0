"""Directions for tests, and albedo by quadrature over half vectors: exact for lobes narrower than any grid."""

from __future__ import annotations

import numpy as np

from brdf.reflectance import Reflectance


def direction(theta: float, phi: float = 0.0) -> np.ndarray:
    """The direction at polar angle `theta` and azimuth `phi` [degrees], (3,)."""
    theta, phi = np.radians([theta, phi])
    return np.array([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)])


def half_vectors(n_theta: int, n_phi: int, smallest: float) -> tuple[np.ndarray, np.ndarray]:
    """(N, 3) half vectors and (N,) solid angles: Gauss-Legendre in log(theta) from `smallest` [rad] to the horizon."""
    x, w = np.polynomial.legendre.leggauss(n_theta)
    low, high = np.log(smallest), np.log(np.pi / 2)
    theta = np.exp(low + (high - low) * (x + 1) / 2)
    weight = w * (high - low) / 2 * theta * np.sin(theta) * 2 * np.pi / n_phi
    phi = (np.arange(n_phi) + 0.5) * 2 * np.pi / n_phi
    theta, phi = np.meshgrid(theta, phi, indexing="ij")
    h = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], -1)
    return h.reshape(-1, 3), np.repeat(weight, n_phi)


def lobe_albedo(
    m: Reflectance, wo: np.ndarray, n_theta: int = 160, n_phi: int = 64, smallest: float = 1e-7
) -> np.ndarray:
    """Directional albedo of a specular lobe for one viewing direction, (3,): d wi = 4 (wo . h) d h."""
    h, solid_angle = half_vectors(n_theta, n_phi, smallest)
    cosine = h @ wo
    wi = 2 * cosine[:, None] * h - wo
    use = (cosine > 0) & (wi[:, 2] > 0)
    wi, jacobian = wi[use], (4 * cosine * solid_angle)[use]
    return np.einsum("nc,n->c", m(wi, wo), wi[:, 2] * jacobian)


def random_pairs(n: int, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """(n, 3) pairs above the horizon down to 0.06 degrees: random ones and, from n / 2 on, near-mirror ones."""
    rng = np.random.default_rng(seed)
    cosine, phi = rng.uniform(0.03, 1, (2, n)) ** 2, rng.uniform(0, 2 * np.pi, (2, n))
    sine = np.sqrt(1 - cosine**2)
    wi, wo = np.stack([sine * np.cos(phi), sine * np.sin(phi), cosine], -1)
    near = wo[n // 2 :] * [-1, -1, 1] + rng.normal(size=(n - n // 2, 3)) * 10 ** rng.uniform(-4, -1, (n - n // 2, 1))
    near[:, 2] = np.maximum(np.abs(near[:, 2]), 1e-3)
    wi[n // 2 :] = near / np.linalg.norm(near, axis=-1, keepdims=True)
    return wi, wo
