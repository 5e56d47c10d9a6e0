"""OpenPBR Surface, the part without transmission: a diffuse or metallic base, a coat, a fuzz on top."""

from __future__ import annotations

from typing import Any, ClassVar

from ..formula import Scalar, Vec, abs, dot, maximum, minimum, mix, normalize, pow, sqrt, texture2d, texture3d
from ..geometry.quadrature import gauss_legendre
from ..geometry.sampling import CosineSampler, GGXSampler, MixtureSampler, Sampler
from ..parameters import RGB, albedo, number
from .eon import eon, fitted_G_over_pi
from .model import Model
from .sheen import charlie
from .terms.fresnel import dielectric
from .terms.ggx import ggx_lobe
from .terms.layer_albedo import dielectric_albedo, dielectric_coordinates, fuzz_albedo, fuzz_coordinates

_NODES, _WEIGHTS = (rule.tolist() for rule in gauss_legendre(8))
LEAST_WIDTH = 1e-3
"""Stands for the mirror of roughness 0, which no finite value describes."""


class OpenPBR(Model):
    """OpenPBR Surface 1.1: base, specular, coat and fuzz layers, opaque, layered by scaling with albedos.

        f(wi, wo) = W w_f f_fuzz + (1 - W E_fuzz(wo)) [C f_coat + (1 - C E_coat(wo)) T f_base]      [1/sr]
        f_base = mix(w_s f_spec + (1 - E_spec(wo)) f_EON, f_metal, metalness),   T = mix(1, w_c Delta, C)

    W and C are fuzz and coat weight, w_f, w_s and w_c the layers' colours; E are the tabulated directional albedos of
    the white lobes. f_metal has the F82-tint Fresnel term; under a coat the specular
    lobe is rougher and meets the relative index of base and coat; Delta darkens the base by what the coat reflects
    back into it. In place of the specification's fitted fuzz lobe stands `CharlieSheen`; the coat tints as at normal
    incidence; no light is added for multiple scattering among facets. Reference: OpenPBR2024.
    """

    breaks: ClassVar[dict[str, str]] = {
        "reciprocity": "layers are scaled by the albedo towards the viewer alone [OpenPBR2024]"
    }

    base_weight: Scalar = number("scale of the base colour", default=1.0, low=0.0, high=1.0)
    base_color: RGB = albedo("colour of the diffuse base and of metals", default=0.8)
    base_diffuse_roughness: Scalar = number("roughness of the diffuse base", default=0.0, low=0.0, high=1.0)
    base_metalness: Scalar = number("0 for dielectrics, 1 for metals", default=0.0, low=0.0, high=1.0)
    specular_weight: Scalar = number("scale of the specular reflectance", default=1.0, low=0.0, high=1.0)
    specular_color: RGB = albedo("tint of the specular; of metals at 82 degrees", default=1.0)
    specular_roughness: Scalar = number("perceptual roughness of the specular", default=0.3, low=0.0, high=1.0)
    specular_roughness_anisotropy: Scalar = number("elongation along the tangent", default=0.0, low=0.0, high=1.0)
    specular_ior: Scalar = number("refractive index of the base", default=1.5, low=1.0, high=3.0)
    coat_weight: Scalar = number("presence of the coat", default=0.0, low=0.0, high=1.0)
    coat_color: RGB = albedo("tint of what is seen through the coat", default=1.0)
    coat_roughness: Scalar = number("perceptual roughness of the coat", default=0.0, low=0.0, high=1.0)
    coat_ior: Scalar = number("refractive index of the coat", default=1.6, low=1.0, high=3.0)
    coat_darkening: Scalar = number("how much the coat darkens the base", default=1.0, low=0.0, high=1.0)
    fuzz_weight: Scalar = number("presence of the fuzz", default=0.0, low=0.0, high=1.0)
    fuzz_color: RGB = albedo("tint of the fuzz", default=1.0)
    fuzz_roughness: Scalar = number("roughness of the fuzz", default=0.5, low=0.1, high=1.0)

    @property
    def isotropic(self) -> bool:
        return bool(self.specular_roughness_anisotropy == 0)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        cosine = dot(wi, normalize(wi + wo))
        color = self.base_weight * self.base_color
        alpha_x, alpha_y = self.specular_widths()
        lobe = ggx_lobe(wi, wo, alpha_x, alpha_y)
        diffuse = eon(wi, wo, color, self.base_diffuse_roughness, fitted_G_over_pi)
        highlight = self.specular_color * (dielectric(cosine, self.specular_eta()) * lobe)
        plastic = highlight + diffuse * (1.0 - self.albedo_of(wo.z, sqrt(alpha_x * alpha_y), self.specular_root()))
        metal = _f82_tint(cosine, color, self.specular_color) * (self.specular_weight * lobe)
        base = mix(plastic, metal, self.base_metalness)

        coat = self.coat_weight * dielectric(cosine, self.coat_ior) * ggx_lobe(wi, wo, *self.coat_widths())
        coat_root = (self.coat_ior - 1.0) / (self.coat_ior + 1.0)
        E_coat = self.albedo_of(wo.z, self.coat_widths()[0], coat_root)
        through = (1.0 - self.coat_weight * E_coat) * self.tint_below_coat(wo.z, color)
        coated = base * through + coat

        fuzz = self.fuzz_color * (self.fuzz_weight * charlie(wi, wo, self.fuzz_roughness))
        E_fuzz = texture2d(self.fuzz_albedo, *fuzz_coordinates(wo.z, self.fuzz_roughness))[0]
        return fuzz + coated * (1.0 - self.fuzz_weight * E_fuzz)

    def albedo_of(self, cosine: Scalar, alpha: Scalar, root: Scalar) -> Scalar:
        """E of a white dielectric lobe whose F0 is root^2."""
        return texture3d(self.dielectric_albedo, *dielectric_coordinates(cosine, alpha, root))[0]

    def specular_root(self) -> Scalar:
        """The root of the base's F0, which the specular weight scales."""
        eta = mix(self.specular_ior, self.specular_ior / self.coat_ior, self.coat_weight)
        return sqrt(self.specular_weight) * abs(eta - 1.0) / (eta + 1.0)

    def specular_eta(self) -> Scalar:
        """Relative index that meets light at the base."""
        root = self.specular_root()
        return (1.0 + root) / (1.0 - root)

    def specular_widths(self) -> tuple[Scalar, Scalar]:
        """alpha along tangent and bitangent; a rough coat blurs what is seen through it."""
        blurred = pow(self.specular_roughness**4 + 2.0 * self.coat_roughness**4 + 1e-24, 0.25)
        roughness = mix(self.specular_roughness, minimum(blurred, 1.0), self.coat_weight)
        kept = 1.0 - self.specular_roughness_anisotropy
        alpha_x = roughness * roughness * sqrt(2.0 / (1.0 + kept * kept))
        return maximum(alpha_x, LEAST_WIDTH), maximum(kept * alpha_x, LEAST_WIDTH)

    def coat_widths(self) -> tuple[Scalar, Scalar]:
        alpha = maximum(self.coat_roughness * self.coat_roughness, LEAST_WIDTH)
        return alpha, alpha

    def tint_below_coat(self, cos_o: Scalar, color: Vec) -> Vec:
        """What coat colour and light reflected back into the base make of it."""
        eta = self.coat_ior
        mean = 0.0
        for cosine, weight in zip(_NODES, _WEIGHTS, strict=True):
            mean = mean + 2.0 * weight * cosine * dielectric(cosine, eta)
        diffusely = 1.0 - (1.0 - mean) / (eta * eta)
        share = mix(1.0, self.specular_roughness, self.base_metalness)
        K = mix(dielectric(cos_o, eta), diffusely, share)
        darkened = (1.0 - K) / (1.0 - color * K)
        return mix(1.0, self.coat_color * mix(1.0, darkened, self.coat_darkening), self.coat_weight)

    def derived_textures(self) -> dict[str, Any]:
        return {"dielectric_albedo": dielectric_albedo(), "fuzz_albedo": fuzz_albedo()}

    def _make_sampler(self) -> Sampler:
        alpha_x, alpha_y = (float(alpha) for alpha in self.specular_widths())
        samplers: list[Sampler] = [
            CosineSampler(),
            GGXSampler(alpha_x, alpha_y),
            GGXSampler(*map(float, self.coat_widths())),
        ]
        return MixtureSampler(samplers, [1 - 0.8 * self.base_metalness, 0.5, 0.3 * self.coat_weight])


def _f82_tint(cosine: Scalar, F0: Vec, tint: Vec) -> Vec:
    """Schlick's curve pulled down to `tint` times itself at cosine 1/7; kept at 0 where that would be less."""
    at_82 = 1.0 / 7.0
    schlick = F0 + (1.0 - F0) * (1.0 - at_82) ** 5
    dip = schlick * (1.0 - tint) / (at_82 * (1.0 - at_82) ** 6)
    grazing = maximum(1.0 - cosine, 0.0)
    curve: Vec = maximum(F0 + (1.0 - F0) * grazing**5 - dip * (cosine * grazing**6), 0.0)
    return curve
