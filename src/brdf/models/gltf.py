"""The material of glTF 2.0 files."""

from __future__ import annotations

from typing import ClassVar

from ..formula import Scalar, Vec, length, maximum, mix, pi
from ..geometry.sampling import CosineSampler, GGXSampler, MixtureSampler, Sampler
from ..parameters import RGB, albedo, number
from .model import Model
from .terms.ggx import ggx_lobe


class GltfMetallicRoughness(Model):
    """Metallic-roughness material in the implementation that the specification suggests (Appendix B).

        f(wi, wo) = mix(mix(base / pi, s, F(0.04)), s F(base), metallic)      [1/sr],   s = D V
        F(F0) = F0 + (1 - F0)(1 - wo . h)^5

    D is GGX of width alpha = roughness^2, V Smith's height-correlated masking over 4 cos_i cos_o. A width below 0.001
    counts as 0.001: roughness 0 is a mirror, which no finite value describes. Reference: Khronos2021.
    """

    breaks: ClassVar[dict[str, str]] = {
        "energy": "the mix leaves the diffuse part too much where the highlight is strong [Khronos2021]"
    }

    base_color: RGB = albedo("diffuse reflectance of dielectrics, reflectance of metals at the normal", default=1.0)
    metallic: Scalar = number("0 for dielectrics, 1 for metals", default=1.0, low=0.0, high=1.0)
    roughness: Scalar = number("perceptual roughness, root of the width", default=1.0, low=0.0, high=1.0)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        h = wi + wo
        grazing = maximum(1.0 - 0.5 * length(h), 0.0) ** 5
        alpha = maximum(self.roughness * self.roughness, 0.001)
        specular = ggx_lobe(wi, wo, alpha, alpha)
        metal = specular * mix(self.base_color, 1.0, grazing)
        dielectric = mix(self.base_color * (1 / pi), specular, mix(0.04, 1.0, grazing))
        return mix(dielectric, metal, self.metallic)

    def _make_sampler(self) -> Sampler:
        alpha = max(self.roughness**2, 0.001)
        diffuse = (1 - self.metallic) * float(self.base_color.mean())
        return MixtureSampler([CosineSampler(), GGXSampler(alpha, alpha)], [diffuse + 0.05, 0.3])
