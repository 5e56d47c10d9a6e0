"""Diffuse light from under a rough surface, which takes what that surface leaves."""

from __future__ import annotations

from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from ..errors import ReflectanceError
from ..formula import Scalar, Vec, pi, texture1d
from ..geometry.directions import from_spherical
from ..geometry.sampling import CosineSampler, Sampler
from ..parameters import RGB, albedo, texture
from ..reflectance import Reflectance
from .model import Model


class KelemenDiffuse(Model):
    """Matte component coupled to a specular one by that one's directional albedo a(cos).

        f(wi, wo) = albedo / pi (1 - a(cos_i)) (1 - a(cos_o)) / (1 - a_mean)      [1/sr]

    a_mean is the cosine-weighted mean of a over the hemisphere. Reciprocal, and with `albedo` = 1 the directional
    albedo is exactly 1 - a(cos_o), so that both components together return all the light. a is a table over the
    cosine, evenly spaced from grazing (cosine 0) to normal (cosine 1), linear between; `KelemenDiffuse.beneath(m)`
    makes it for any isotropic reflectance m. Reference: Kelemen2001.
    """

    albedo: RGB = albedo("share of the light that enters the surface and comes out again", default=0.5)
    specular_albedo: Any = texture(
        "directional albedo a of the specular component (n, 3), from grazing to normal",
        [[1.0] * 3, [0.268] * 3, [0.07] * 3, [0.041] * 3, [0.04] * 3], 1, 3, 0.0, 1.0,
    )  # fmt: skip

    @classmethod
    def beneath(cls, specular: Reflectance, albedo: Any = 0.5, nodes: int = 65, samples: int = 4096) -> Self:
        """The matte component that fits under `specular`, whose albedo is taken at `nodes` cosines.

        Raises ReflectanceError for an anisotropic reflectance or one that transmits, ParameterError for an albedo above
        1.
        """
        if not specular.isotropic or specular.transmits:
            raise ReflectanceError(
                f"{specular.name or type(specular).__name__} is anisotropic or transmits; "
                "a table over one cosine fits under isotropic reflection only"
            )
        cosine = np.maximum(np.linspace(0, 1, nodes), 1e-4)
        table = Reflectance.albedo(specular, from_spherical(np.arccos(cosine), 0.0), samples)
        return cls(albedo=albedo, specular_albedo=table)

    def derived_textures(self) -> dict[str, NDArray[np.float32]]:
        """(1 - a) / sqrt(1 - a_mean), the factor that either direction contributes."""
        passed = 1 - self._given_textures["specular_albedo"].astype(np.float64)
        return {"coupling": (passed / np.sqrt(np.maximum(_mean(passed), 1e-12))).astype(np.float32)}

    def f(self, wi: Vec, wo: Vec) -> Vec:
        return self.albedo * self.factor(wi.z) * self.factor(wo.z) * (1 / pi)

    def factor(self, cosine: Scalar) -> Vec:
        # the first and the last texel's centres lie half a texel inside the texture
        n = self.coupling.shape[0]
        return texture1d(self.coupling, (cosine * (n - 1.0) + 0.5) / n)

    def _make_sampler(self) -> Sampler:
        return CosineSampler()


def _mean(table: NDArray[np.float64]) -> NDArray[np.float64]:
    """(3,) the integral of 2 c t(c) over c in [0, 1] for a table (n, 3) linear between its nodes."""
    c = np.linspace(0, 1, len(table))[:, None]
    low, high = table[:-1], table[1:]
    # per interval, of width h from c0: the integral of 2 c t is h (c0 (t0 + t1) + h (t0 + 2 t1) / 3)
    h = c[1] - c[0]
    total: NDArray[np.float64] = (h * (c[:-1] * (low + high) + h * (low + 2 * high) / 3)).sum(0)
    return total
