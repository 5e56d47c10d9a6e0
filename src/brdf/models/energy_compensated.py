"""The light that a microfacet model loses because it follows one bounce only, put back."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError
from ..formula import Scalar, Vec, atan2, floor, maximum, normalize, pi, texture1d, texture2d
from ..formula.bound import Bound, bound_value
from ..geometry.quadrature import gauss_legendre
from ..geometry.sampling import CosineSampler, MixtureSampler, Sampler
from ..reflectance import Reflectance
from .microfacet import Microfacet
from .terms.albedo import albedo_coordinate, albedo_table, cosine_mean
from .terms.ndf.projected_area import node_coordinate

AZIMUTHS = 16
"""Azimuths of the albedo table of an anisotropic base; an isotropic one needs one."""

_NODES, _WEIGHTS = (rule.tolist() for rule in gauss_legendre(8))


class EnergyCompensated(Reflectance):
    """A microfacet model and, beside it, a nearly diffuse lobe that reflects what its facets catch again.

        f(wi, wo) = f_base + F_ms (1 - E(wi)) (1 - E(wo)) / (pi (1 - E_mean))      [1/sr]
        F_ms = F_mean^2 E_mean / (1 - F_mean (1 - E_mean))

    E is the directional albedo of the base with white facets (F = 1), tabulated, E_mean and F_mean are cosine-weighted
    means over the hemisphere. Reciprocal; white facets reflect everything. For a masking term that conserves energy:
    E beyond 1 counts as 1. References: Kulla2017.
    """

    base: Any
    white_albedo: Any
    mean_albedo: Any
    given_textures: ClassVar[dict[str, NDArray[Any]]] = {}
    """None: its textures follow from the base."""

    def __init__(self, base: Microfacet, albedo_table: NDArray[np.float32] | None = None) -> None:
        if not isinstance(base, Microfacet):
            raise ParameterError(f"energy is compensated for a Microfacet model, got {type(base).__name__}")
        self._base = base
        self.name = f"{base.name} with energy compensation"
        table = _white_albedo(base) if albedo_table is None else albedo_table
        self._textures = {"white_albedo": table, "mean_albedo": np.full((1, 1), cosine_mean(table[:, :-1]), np.float32)}

    @property
    def isotropic(self) -> bool:
        return self._base.isotropic

    @property
    def structure(self) -> tuple[Any, ...]:
        return (EnergyCompensated, self._textures["white_albedo"].shape, self._base.structure)

    @property
    def values(self) -> Mapping[str, Any]:
        return {f"base_{k}": v for k, v in self._base.values.items()}

    @property
    def textures(self) -> Mapping[str, NDArray[Any]]:
        return self._textures | {f"base_{k}": v for k, v in self._base.textures.items()}

    @property
    def children(self) -> Mapping[str, Reflectance]:
        return {"base": self._base}

    @property
    def lossless(self) -> Mapping[str, Any] | None:  # type: ignore[override]
        return {"F0": 1.0} if "F0" in self._base.values else None

    def f(self, wi: Vec, wo: Vec) -> Vec:
        lost = (1.0 - self.white_albedo_of(wi)) * (1.0 - self.white_albedo_of(wo))
        E_mean = texture1d(self.mean_albedo, 0.5)[0]
        F_mean = Vec(0.0, 0.0, 0.0)
        for cosine, weight in zip(_NODES, _WEIGHTS, strict=True):
            F_mean = F_mean + self.base.fresnel.F(cosine) * (2.0 * weight * cosine)
        F_ms = F_mean * F_mean * E_mean / (1.0 - F_mean * (1.0 - E_mean))
        several: Vec = F_ms * (lost / (pi * maximum(1.0 - E_mean, 1e-6)))
        return self.base.f(wi, wo) + several

    def white_albedo_of(self, w: Vec) -> Scalar:
        """E of one direction."""
        across = albedo_coordinate(w.z)
        turn = atan2(w.y, w.x) / (2.0 * pi)
        around = node_coordinate(turn - floor(turn), self.white_albedo.shape[1])
        return texture2d(self.white_albedo, across, around)[0]

    def _make_sampler(self) -> Sampler:
        missing = 1 - float(self._textures["mean_albedo"][0, 0])
        return MixtureSampler([self._base.sampler, CosineSampler()], [1 - missing, max(missing, 0.01)])

    def _state(self) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
        return {}, {"white_albedo": self._textures["white_albedo"]}

    @classmethod
    def _restore(cls, header: Any, arrays: Any, children: Mapping[str, Reflectance]) -> Reflectance:
        return cls(children["base"], arrays["white_albedo"])  # type: ignore[arg-type]

    def replaced(self, **changes: Any) -> EnergyCompensated:
        """Around the base with other values."""
        return EnergyCompensated(self._base.replaced(**changes))

    def __repr__(self) -> str:
        return f"EnergyCompensated({self._base!r})"


def _white_albedo(base: Microfacet) -> NDArray[np.float32]:
    """E over (root of the cosine, azimuth), (64, 2 or 17, 1)."""
    values, textures = base.values, base.textures
    formula = Bound(base, lambda name: textures[name] if name in textures else bound_value(values[name], float))
    phi = np.linspace(0, 2 * np.pi, 2 if base.isotropic else AZIMUTHS + 1)
    table = albedo_table(lambda wi, wo: formula.white(normalize(wi + wo), wi, wo), phi[:-1].tolist())
    return np.concatenate([table, table[:, :1]], axis=1)
