"""The ideal mirror."""

from __future__ import annotations

import numpy as np

from ..formula import Vec
from ..geometry.sampling import MirrorSampler, Sampler, same_direction
from ..parameters import RGB, albedo
from ..reflectance import Floats
from .model import Model


class Mirror(Model):
    """Ideal mirror reflection: the same share of the light whatever the angle.

        f(wi, wo) = reflectance delta(wi - r) / cos_i      [1/sr],   r = (-wo.x, -wo.y, wo.z)

    A delta distribution: the value is 0, `sample` draws r with weight `reflectance`. Reference: Pharr2023.
    """

    has_delta = True

    lossless = {"reflectance": 1.0}  # noqa: RUF012

    reflectance: RGB = albedo("share of the light that is reflected", default=1.0)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        return self.reflectance * (0.0 * wi.z)

    def _make_sampler(self) -> Sampler:
        return MirrorSampler()

    def _delta_arrays(self, wi: Floats, wo: Floats) -> Floats:
        mirrored = (wo[:, 2] > 0) & same_direction(wi, wo * np.array([-1, -1, 1], wo.dtype))
        return np.where(mirrored[:, None], np.asarray(self.reflectance, wi.dtype), 0)
