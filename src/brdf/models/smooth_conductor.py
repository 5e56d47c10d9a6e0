"""Smooth metal: a mirror with the Fresnel reflectance of a complex refractive index."""

from __future__ import annotations

import numpy as np

from ..formula import Vec
from ..geometry.sampling import MirrorSampler, Sampler, same_direction
from ..parameters import RGB, rgb
from ..reflectance import Floats
from .model import Model
from .terms.fresnel import conductor


class SmoothConductor(Model):
    """Mirror reflection from a polished metal.

        f(wi, wo) = F(cos_i) delta(wi - r) / cos_i      [1/sr],   r = (-wo.x, -wo.y, wo.z)

    F is the exact Fresnel reflectance of the index eta + i k for unpolarised light, a channel each. A delta
    distribution: the value is 0, `sample` draws r with weight F. References: Born1999, Lagarde2013.
    """

    has_delta = True

    eta: RGB = rgb("refractive index, real part", default=(0.2, 0.92, 1.1), low=1e-3, high=20.0)
    k: RGB = rgb("extinction coefficient", default=(3.91, 2.45, 2.14), low=0.0, high=20.0)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        return Vec(0.0 * wi.z, 0.0 * wi.z, 0.0 * wi.z)

    def _make_sampler(self) -> Sampler:
        return MirrorSampler()

    def _delta_arrays(self, wi: Floats, wo: Floats) -> Floats:
        mirrored = (wo[:, 2] > 0) & same_direction(wi, wo * np.array([-1, -1, 1], wo.dtype))
        eta, k = (np.asarray(values, wi.dtype) for values in (self.eta, self.k))
        reflectance: Floats = conductor(wi[:, 2:], eta, k)
        return np.where(mirrored[:, None], reflectance, 0)
