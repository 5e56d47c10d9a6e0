"""Disney's principled model: every parameter between 0 and 1, every combination plausible."""

from __future__ import annotations

from typing import Any, ClassVar

from ..formula import Scalar, Vec, dot, log, maximum, mix, pi, sqrt, where
from ..geometry.sampling import CosineSampler, GGXSampler, MixtureSampler, Sampler
from ..parameters import RGB, albedo, choice, number
from .model import Model


class Disney(Model):
    """The principled BRDF of 2012: diffuse or flattened subsurface base, sheen, GGX specular lobe, GTR1 clearcoat.

        f(wi, wo) = (1 - metallic) (base mix(f_d, f_ss, subsurface) / pi + sheen C_sheen S(wi . h))
                    + D_s F_s G_s / (4 cos_i cos_o) + clearcoat / 4 D_c F_c G_c / (4 cos_i cos_o)      [1/sr]
        S(c) = (1 - c)^5,   f_d = mix(1, F90, S(cos_i)) mix(1, F90, S(cos_o)),   F90 = 1/2 + 2 roughness (wi . h)^2

    The width is alpha = roughness^2 and D_s is GGX. `masking="2012"` widens G_s to alpha = (1/2 + roughness / 2)^2,
    whatever the anisotropy; "2014" takes Smith's G of D_s itself, as the published source did from 2014 on.
    References: Burley2012, Burley2015.
    """

    breaks: ClassVar[dict[str, str]] = {
        "energy": "the lobes are added without making room for each other, F90 of rough surfaces is 2.5 [Burley2012]"
    }

    base_color: RGB = albedo("colour of the diffuse base and of metals", default=0.5)
    metallic: Scalar = number("0 for dielectrics, 1 for metals", default=0.0, low=0.0, high=1.0)
    subsurface: Scalar = number("from the diffuse base to a flattened one", default=0.0, low=0.0, high=1.0)
    specular: Scalar = number("reflectance at normal incidence over 0.08", default=0.5, low=0.0, high=1.0)
    specular_tint: Scalar = number("how much of the base colour the specular has", default=0.0, low=0.0, high=1.0)
    roughness: Scalar = number("perceptual roughness, root of the width", default=0.5, low=0.0, high=1.0)
    anisotropic: Scalar = number("elongation of the highlight along the tangent", default=0.0, low=0.0, high=1.0)
    sheen: Scalar = number("grazing component of cloth", default=0.0, low=0.0, high=1.0)
    sheen_tint: Scalar = number("how much of the base colour the sheen has", default=0.5, low=0.0, high=1.0)
    clearcoat: Scalar = number("second, colourless highlight", default=0.0, low=0.0, high=1.0)
    clearcoat_gloss: Scalar = number("0 satin, 1 gloss", default=1.0, low=0.0, high=1.0)
    masking: Any = choice("masking of the specular lobe", "2012", {"2012": None, "2014": None})

    @property
    def isotropic(self) -> bool:
        return bool(self.anisotropic == 0)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        h = wi + wo
        h2 = dot(h, h)
        cos_d = 0.5 * sqrt(h2)
        S_i, S_o, S_d = _schlick(wi.z), _schlick(wo.z), _schlick(cos_d)

        # Rec. 601 weights as published
        luminance = 0.3 * self.base_color[0] + 0.6 * self.base_color[1] + 0.1 * self.base_color[2]
        tint = where(luminance > 0.0, self.base_color / maximum(luminance, 1e-9), Vec(1.0, 1.0, 1.0))

        retro = self.roughness * cos_d * cos_d
        f_d = mix(1.0, 0.5 + 2.0 * retro, S_i) * mix(1.0, 0.5 + 2.0 * retro, S_o)
        flat = mix(1.0, retro, S_i) * mix(1.0, retro, S_o)
        f_ss = 1.25 * (flat * (1.0 / (wi.z + wo.z) - 0.5) + 0.5)
        base = self.base_color * (mix(f_d, f_ss, self.subsurface) / pi)
        sheen = mix(1.0, tint, self.sheen_tint) * (self.sheen * S_d)

        alpha_x, alpha_y = self.widths()
        F0 = mix(0.08 * self.specular * mix(1.0, tint, self.specular_tint), self.base_color, self.metallic)
        stretched = ((h.x / alpha_x) ** 2 + (h.y / alpha_y) ** 2 + h.z * h.z) / h2
        D_s = 1.0 / (pi * alpha_x * alpha_y * stretched * stretched)
        if self.masking == "2012":
            wide = (0.5 + 0.5 * self.roughness) ** 2
            V_s = _masked(wi, wide, wide) * _masked(wo, wide, wide)
        else:
            V_s = _masked(wi, alpha_x, alpha_y) * _masked(wo, alpha_x, alpha_y)
        highlight = mix(F0, 1.0, S_d) * (D_s * V_s)

        a2 = mix(0.1, 0.001, self.clearcoat_gloss) ** 2
        D_c = (a2 - 1.0) / (pi * log(a2) * (a2 + (1.0 - a2) * (h.x * h.x + h.y * h.y) / h2))
        coat = 0.25 * self.clearcoat * D_c * mix(0.04, 1.0, S_d) * _masked(wi, 0.25, 0.25) * _masked(wo, 0.25, 0.25)
        return (base + sheen) * (1.0 - self.metallic) + highlight + coat

    def widths(self) -> tuple[Scalar, Scalar]:
        """alpha along tangent and bitangent."""
        alpha = self.roughness * self.roughness
        aspect = sqrt(1.0 - 0.9 * self.anisotropic)
        return maximum(alpha / aspect, 0.001), maximum(alpha * aspect, 0.001)

    def _make_sampler(self) -> Sampler:
        alpha_x, alpha_y = (float(alpha) for alpha in self.widths())
        gloss = 0.1 + (0.001 - 0.1) * self.clearcoat_gloss
        samplers: list[Sampler] = [CosineSampler(), GGXSampler(alpha_x, alpha_y), GGXSampler(gloss, gloss)]
        return MixtureSampler(samplers, [0.9 - 0.6 * self.metallic, 0.4, 0.2 * self.clearcoat])


def _schlick(cosine: Scalar) -> Scalar:
    return maximum(1.0 - cosine, 0.0) ** 5


def _masked(w: Vec, alpha_x: Scalar, alpha_y: Scalar) -> Scalar:
    """Smith's G1 of GGX over 2 cos."""
    return 1.0 / (w.z + sqrt((w.x * alpha_x) ** 2 + (w.y * alpha_y) ** 2 + w.z * w.z))
