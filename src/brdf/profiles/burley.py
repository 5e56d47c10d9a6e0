"""Burley's normalised diffusion."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..parameters import RGB, albedo, choice, rgb
from .profile import Floats, Profile

SCALINGS = {
    "searchlight": lambda A: 1.85 - A + 7.0 * np.abs(A - 0.8) ** 3,
    "diffuse": lambda A: 1.9 - A + 3.5 * (A - 0.8) ** 2,
    "diffuse-mean-free-path": lambda A: 3.5 + 100.0 * (A - 0.33) ** 4,
}
"""s(A): the authors' fits to Monte Carlo references."""


class Burley(Profile):
    """Two exponentials that stand for single and multiple scattering together.

        R(r) = A / (8 pi d r) (exp(-r / d) + exp(-r / (3 d)))      [1/mm2],   d = length / s(A)

        searchlight               s = 1.85 - A + 7 |A - 0.8|^3       length = mean free path; light enters straight
        diffuse                   s = 1.9 - A + 3.5 (A - 0.8)^2      length = mean free path; it enters from all sides
        diffuse-mean-free-path    s = 3.5 + 100 (A - 0.33)^4         length = diffuse mean free path on the surface

    Its integral over the plane is A exactly, and its cumulative distribution is 1 - exp(-r/d)/4 - 3/4 exp(-r/(3d)).
    Reference: Christensen2015.
    """

    A: RGB = albedo("surface albedo", default=0.8)
    length: RGB = rgb("mean free path, or diffuse mean free path", default=1.0, low=1e-6, high=1e6, unit="mm")
    scaling: Any = choice("what the length is and how light enters", "searchlight", SCALINGS)

    @property
    def d(self) -> Floats:
        """The length of the shorter exponential [mm], (3,)."""
        return np.asarray(self.length / SCALINGS[self.scaling](self.A))

    def _at(self, r: Floats) -> Floats:
        d = self.d
        return np.asarray(self.A * (np.exp(-r / d) + np.exp(-r / (3 * d))) / (8 * np.pi * d * r))

    def within(self, r: Any) -> Floats:
        """Share of the reflected flux that leaves within r (...) [mm], (..., 3)."""
        x = np.asarray(r, np.float64)[..., None] / self.d
        return np.asarray(1 - 0.25 * np.exp(-x) - 0.75 * np.exp(-x / 3))

    def total(self) -> Floats:
        return np.array(self.A)

    def reach(self) -> Floats:
        return 3 * self.d
