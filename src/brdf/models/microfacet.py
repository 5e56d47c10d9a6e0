"""Microfacet reflection: a distribution of mirror facets, their mutual masking, their Fresnel reflectance."""

from __future__ import annotations

from typing import Any

from ..formula import Vec, dot, normalize
from ..geometry.sampling import Sampler
from ..parameters import choice
from .model import Model
from .terms import ndf as distributions
from .terms.fresnel import Conductor, Dielectric, Schlick
from .terms.masking import SmithCorrelated, SmithSeparable

DISTRIBUTIONS = {"ggx": distributions.GGX, "beckmann": distributions.Beckmann}


class Microfacet(Model):
    """Torrance-Sparrow reflection from a rough surface of mirrors.

        f(wi, wo) = D(h) G(wi, wo) F(wi . h) / (4 cos_i cos_o)      [1/sr],   h = (wi + wo) / |wi + wo|

    Freely mixed from a distribution D (`ndf`), a masking term G (`masking`) and a Fresnel term F (`fresnel`); their
    parameters are given beside the choices. References: Torrance1967, Walter2007, Heitz2014.
    """

    ndf: Any = choice("distribution of facet normals", "ggx", DISTRIBUTIONS)
    masking: Any = choice("masking-shadowing", "smith", {"smith": SmithCorrelated, "smith-separable": SmithSeparable})
    fresnel: Any = choice(
        "Fresnel reflectance", "schlick", {"schlick": Schlick, "dielectric": Dielectric, "conductor": Conductor}
    )

    @property
    def isotropic(self) -> bool:
        return self._parts["ndf"].isotropic

    def f(self, wi: Vec, wo: Vec) -> Vec:
        h = normalize(wi + wo)
        D = self.ndf.D(h)
        visibility = self.masking.visibility(self.ndf, wi, wo)  # G / (cos_i cos_o)
        F = self.fresnel.F(dot(wi, h))
        return F * (D * visibility / 4.0)

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
