"""Ashikhmin and Premoze's distribution-based BRDF."""

from __future__ import annotations

from typing import Any

from ..formula import Vec, dot, normalize
from ..parameters import choice
from .model import Model
from .terms import ndf as distributions
from .terms.fresnel import TERMS as FRESNEL_TERMS


class AshikhminPremoze(Model):
    """A half-vector distribution of any shape with Fresnel reflectance and a denominator that needs no masking.

        f(wi, wo) = D(h) F(h . wi) / (4 (cos_i + cos_o - cos_i cos_o))      [1/sr]

    The constant that the paper leaves to normalisation is 1/4 for D normalised as a distribution of facets: a narrow
    lobe then reflects F at normal incidence, and F cos / (2 - cos) at oblique angles. Reference: Ashikhmin2007.
    """

    ndf: Any = choice(
        "distribution of half vectors", "ggx", {"ggx": distributions.GGX, "beckmann": distributions.Beckmann}
    )
    fresnel: Any = choice("Fresnel reflectance", "schlick", FRESNEL_TERMS)

    @property
    def isotropic(self) -> bool:
        return self._parts["ndf"].isotropic

    def f(self, wi: Vec, wo: Vec) -> Vec:
        h = normalize(wi + wo)
        return self.fresnel.F(dot(wi, h)) * (self.ndf.D(h) / (4.0 * (wi.z + wo.z - wi.z * wo.z)))
