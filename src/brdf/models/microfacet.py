"""Microfacet reflection: a distribution of mirror facets, their mutual masking, their Fresnel reflectance."""

from __future__ import annotations

from typing import Any

from ..errors import ParameterError
from ..formula import Scalar, Vec, dot, normalize
from ..geometry.sampling import Sampler
from ..parameters import choice
from .model import Model
from .terms import ndf as distributions
from .terms.fresnel import TERMS as FRESNEL_TERMS
from .terms.fresnel import Schlick
from .terms.masking import MASKINGS, SmithCorrelated


class Microfacet(Model):
    """Torrance-Sparrow reflection from a rough surface of mirrors.

        f(wi, wo) = D(h) G(wi, wo) F(wi . h) / (4 cos_i cos_o)      [1/sr],   h = (wi + wo) / |wi + wo|

    Freely mixed from a distribution D (`ndf`), a masking term G (`masking`) and a Fresnel term F (`fresnel`); their
    parameters are given beside the choices. G may also be given as `visibility`, the name for G / (cos_i cos_o).
    References: Torrance1967, Walter2007, Heitz2014, AkenineMoller2008.
    """

    ndf: Any = choice("distribution of facet normals", "ggx", distributions.DISTRIBUTIONS)
    masking: Any = choice("masking-shadowing", "smith", MASKINGS)
    fresnel: Any = choice("Fresnel reflectance", "schlick", FRESNEL_TERMS)

    def __init__(self, /, **given: Any) -> None:
        if "visibility" in given:
            if "masking" in given:
                raise ParameterError("visibility and masking are two names of one choice; give one of them")
            given["masking"] = given.pop("visibility")
        super().__init__(**given)
        vars(self)["breaks"] = type(self).breaks | self._parts["masking"].breaks

    @property
    def isotropic(self) -> bool:
        return self._parts["ndf"].isotropic

    def f(self, wi: Vec, wo: Vec) -> Vec:
        h = normalize(wi + wo)
        F = self.fresnel.F(dot(wi, h))
        return F * self.white(h, wi, wo)

    def white(self, h: Vec, wi: Vec, wo: Vec) -> Scalar:
        """The lobe of facets that reflect everything, F = 1 [1/sr]."""
        D = self.ndf.D(h)
        visibility = self.masking.visibility(self.ndf, wi, wo)  # G / (cos_i cos_o)
        return D * visibility / 4.0

    def _make_sampler(self) -> Sampler:
        return self._parts["ndf"].sampler() or super()._make_sampler()


class GGX(Microfacet):
    """The GGX specular lobe alone: height-correlated Smith masking, Schlick's Fresnel term.

        f(wi, wo) = D(h) F(wi . h) / (4 cos_i cos_o (1 + Lambda(wi) + Lambda(wo)))      [1/sr]

    `alpha` is the isotropic width; give `alpha_x` and `alpha_y` for an anisotropic lobe. References: Walter2007,
    Heitz2014, Schlick1994.
    """

    ndf: Any = choice("distribution of facet normals", "ggx", {"ggx": distributions.GGX})
    masking: Any = choice("masking-shadowing", "smith", {"smith": SmithCorrelated})
    fresnel: Any = choice("Fresnel reflectance", "schlick", {"schlick": Schlick})
