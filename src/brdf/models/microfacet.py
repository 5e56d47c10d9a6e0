"""Microfacet reflection: a distribution of mirror facets, their mutual masking, their Fresnel reflectance."""

from __future__ import annotations

from ..formula import Scalar, Vec, dot, normalize
from ..geometry.sampling import Sampler
from ..parameters import RGB, choice
from .model import Model
from .terms.fresnel import Conductor, Dielectric, Schlick
from .terms.masking import SmithCorrelated, SmithSeparable
from .terms.ndf import GGX as GGXDistribution
from .terms.ndf import Beckmann


class Microfacet(Model):
    """Torrance-Sparrow reflection from a rough surface of mirrors.

        f(wi, wo) = D(h) G(wi, wo) F(wi . h) / (4 cos_i cos_o)      [1/sr],   h = (wi + wo) / |wi + wo|

    Freely mixed from a distribution D (`ndf`), a masking term G (`masking`) and a Fresnel term F (`fresnel`); their
    parameters are given beside the choices. References: Torrance1967, Walter2007, Heitz2014.
    """

    ndf: str = choice("distribution of facet normals", "ggx", {"ggx": GGXDistribution, "beckmann": Beckmann})
    masking: str = choice("masking-shadowing", "smith", {"smith": SmithCorrelated, "smith-separable": SmithSeparable})
    fresnel: str = choice(
        "Fresnel reflectance", "schlick", {"schlick": Schlick, "dielectric": Dielectric, "conductor": Conductor}
    )

    @property
    def isotropic(self) -> bool:
        return self._parts["ndf"].isotropic

    def f(self, wi: Vec, wo: Vec) -> Vec:
        h = normalize(wi + wo)
        D = self.ndf.D(h)
        G = self.masking.G(self.ndf, wi, wo)
        F = self.fresnel.F(dot(wi, h))
        return F * (D * G / (4.0 * wi.z * wo.z))

    def _make_sampler(self) -> Sampler:
        return self._parts["ndf"].sampler() or super()._make_sampler()


class GGX(Microfacet):
    """The GGX specular lobe alone: height-correlated Smith masking, Schlick's Fresnel term.

        f(wi, wo) = D(h) F(wi . h) / (4 cos_i cos_o (1 + Lambda(wi) + Lambda(wo)))      [1/sr]

    `alpha` is the isotropic width; give `alpha_x` and `alpha_y` for an anisotropic lobe. References: Walter2007,
    Heitz2014, Schlick1994.
    """

    ndf: str = choice("distribution of facet normals", "ggx", {"ggx": GGXDistribution})
    masking: str = choice("masking-shadowing", "smith", {"smith": SmithCorrelated})
    fresnel: str = choice("Fresnel reflectance", "schlick", {"schlick": Schlick})
