"""Smooth glass or water: the light that meets the boundary of two media is reflected or refracted."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..formula import Scalar, Vec
from ..geometry.directions import refracted
from ..geometry.sampling import Sampler, same_direction
from ..parameters import number
from ..reflectance import Floats
from .model import Model
from .terms.fresnel import dielectric


class SmoothDielectric(Model):
    """Ideal reflection and refraction at the boundary of two transparent media: a BSDF, defined on the whole sphere.

        f(wi, wo) = F(cos_o) delta(wi - r) / |cos_i| + (n_o / n_i)^2 (1 - F(cos_o)) delta(wi - t) / |cos_i|     [1/sr]

    r mirrors wo in the normal; t continues it beyond the boundary by Snell's law, n_i sin_i = n_o sin_o; n_i and n_o
    are the indices on the light's and on the viewer's side, `eta` below over above. F is the exact reflectance of
    unpolarised light; where no t exists it is 1 (total internal reflection). Radiance that enters the denser medium
    grows by the square of the index: f(wi, wo) / n_o^2 is reciprocal, and the flux, which `albedo` counts, is kept.
    `sample` reflects with probability F, else refracts. The renderer looks up what a refracted direction sees in the
    environment; it follows no light through the body. References: Born1999, Veach1997, Pharr2023.
    """

    transmits = True
    has_delta = True

    lossless = {}  # noqa: RUF012

    eta: Scalar = number("refractive index below the surface over that above", default=1.5, low=0.25, high=4.0)

    @property
    def relative_index(self) -> float:
        return float(self.eta)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        return Vec(0.0 * wi.z, 0.0 * wi.z, 0.0 * wi.z)

    def _make_sampler(self) -> Sampler:
        return BoundarySampler(float(self.eta))

    def _delta_arrays(self, wi: Floats, wo: Floats) -> Floats:
        crosses = wi[:, 2] * wo[:, 2] < 0
        index_ratio = np.where(wo[:, 2] > 0, 1 / self.eta, self.eta)  # n_o / n_i where the light crosses
        radiance = np.where(crosses, index_ratio**2, 1).astype(wi.dtype)
        carried = self.sampler.event_probability(wi, wo) * radiance  # type: ignore[attr-defined]
        return np.repeat(carried[:, None], 3, axis=1)


class BoundarySampler:
    """Two delta events: reflection with the probability of the Fresnel reflectance, else refraction.

    `eta` is the refractive index below the surface over that above.
    """

    def __init__(self, eta: float) -> None:
        self._eta = eta

    def _reflectance(self, wo: Floats) -> Floats:
        """(N,) Fresnel reflectance for light or viewer at `wo`, on either side."""
        eta = np.where(wo[:, 2] > 0, self._eta, 1 / self._eta).astype(wo.dtype)
        reflectance: Floats = dielectric(np.abs(wo[:, 2]), eta)
        return reflectance

    def _directions(self, wo: Floats) -> tuple[Floats, Floats]:
        return wo * np.array([-1, -1, 1], wo.dtype), refracted(wo, self._eta)

    def sample(self, wo: Floats, u: Floats) -> tuple[Floats, NDArray[np.bool_]]:
        reflection, refraction = self._directions(wo)
        reflects = u[:, 0] < self._reflectance(wo)
        return np.where(reflects[:, None], reflection, refraction), np.ones(len(wo), bool)

    def pdf(self, wi: Floats, wo: Floats) -> Floats:
        return np.zeros(len(wi), wi.dtype)

    def event_probability(self, wi: Floats, wo: Floats) -> Floats:
        reflection, refraction = self._directions(wo)
        F = self._reflectance(wo)
        crosses = wi[:, 2] * wo[:, 2] < 0
        met = np.where(crosses, same_direction(wi, refraction), same_direction(wi, reflection))
        return np.where(met, np.where(crosses, 1 - F, F), 0).astype(wi.dtype)
