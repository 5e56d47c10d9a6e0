"""The classical dipole."""

from __future__ import annotations

import numpy as np

from ..parameters import RGB, Scalar, number, rgb
from .profile import Floats, Profile


class Dipole(Profile):
    """Diffusion from two point sources, one below the surface and its negative image above it.

        R(r) = alpha' / (4 pi) (z_r (1 + s d_r) exp(-s d_r) / d_r^3 + z_v (1 + s d_v) exp(-s d_v) / d_v^3)   [1/mm2]
        sigma_t' = sigma_a + sigma_s',   alpha' = sigma_s' / sigma_t',   s = sqrt(3 sigma_a sigma_t')
        z_r = 1 / sigma_t',   z_v = z_r (1 + 4/3 A),   d = sqrt(r^2 + z^2)
        A = (1 + F_dr) / (1 - F_dr),   F_dr = -1.440 / eta^2 + 0.710 / eta + 0.668 + 0.0636 eta

    Its integral over the plane is alpha'/2 (1 + exp(-4/3 A q)) exp(-q) with q = sqrt(3 (1 - alpha')). The fit of F_dr
    holds for eta > 1; at eta = 1 nothing is reflected back and A = 1. Reference: Jensen2001.
    """

    sigma_s: RGB = rgb("reduced scattering coefficient", default=1.0, low=1e-6, high=1e6, unit="1/mm")
    sigma_a: RGB = rgb("absorption coefficient", default=0.01, low=0.0, high=1e6, unit="1/mm")
    eta: Scalar = number("refractive index of the medium", default=1.3, low=1.0, high=3.0)

    @property
    def A(self) -> float:
        """How much brighter it is below the boundary, for what the boundary reflects back."""
        if self.eta == 1.0:
            return 1.0
        F_dr = -1.440 / self.eta**2 + 0.710 / self.eta + 0.668 + 0.0636 * self.eta
        return float((1 + F_dr) / (1 - F_dr))

    @property
    def alpha(self) -> Floats:
        """Reduced albedo alpha' of the medium, (3,)."""
        return np.asarray(self.sigma_s / (self.sigma_s + self.sigma_a))

    def _at(self, r: Floats) -> Floats:
        sigma_t = self.sigma_s + self.sigma_a
        s = np.sqrt(3 * self.sigma_a * sigma_t)
        z_r = 1 / sigma_t
        z_v = z_r * (1 + 4 / 3 * self.A)
        d_r, d_v = np.sqrt(r * r + z_r * z_r), np.sqrt(r * r + z_v * z_v)
        real = z_r * (1 + s * d_r) * np.exp(-s * d_r) / d_r**3
        mirrored = z_v * (1 + s * d_v) * np.exp(-s * d_v) / d_v**3
        return np.asarray(self.alpha / (4 * np.pi) * (real + mirrored))

    def total(self) -> Floats:
        q = np.sqrt(3 * (1 - self.alpha))
        return np.asarray(self.alpha / 2 * (1 + np.exp(-4 / 3 * self.A * q)) * np.exp(-q))

    def reach(self) -> Floats:
        sigma_t = self.sigma_s + self.sigma_a
        # without absorption the profile falls as 1 / r^3 from the depth of the image on
        return np.asarray(np.minimum(1 / np.sqrt(np.maximum(3 * self.sigma_a * sigma_t, 1e-300)), 10 / sigma_t))
