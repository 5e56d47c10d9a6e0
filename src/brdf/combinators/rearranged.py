"""Reflectances at other directions: turned about the normal, or with light and viewer exchanged."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ReflectanceError
from ..formula.vec import Vec
from ..geometry.arguments import MIDDLE
from ..reflectance import Floats, Reflectance
from .of_one import OfOne


class Rearranged(OfOne):
    """f(wi, wo) = f_base at a pair of directions made of the given ones, which keeps them above the horizon.

    Raises ReflectanceError for a base that transmits or mirrors.
    """

    def __init__(self, base: Reflectance) -> None:
        if base.transmits or base.has_delta:
            raise ReflectanceError(f"{base.name or type(base).__name__} transmits or mirrors; only values can be moved")
        super().__init__(base)
        self.source = base.source

    @abstractmethod
    def pair(self, wi: Vec, wo: Vec) -> tuple[Vec, Vec]:
        """The directions at which the base is evaluated."""

    def f(self, wi: Vec, wo: Vec) -> Vec:
        bound: Any = self
        value: Vec = bound.base.f(*self.pair(wi, wo))
        return value

    def _evaluate_arrays(self, wi: Floats, wo: Floats, clamp: bool) -> Floats:
        return self._evaluate_places(wi, wo, np.full((len(wi), 2), MIDDLE, wi.dtype), clamp)

    def _evaluate_places(self, wi: Floats, wo: Floats, uv: Floats, clamp: bool) -> Floats:
        base = self._children["base"]
        moved_wi, moved_wo = (np.stack(w.components, -1) for w in self.pair(Vec(*wi.T), Vec(*wo.T)))
        value: Floats = (base if clamp else base.raw)(moved_wi, moved_wo, uv)
        return value

    def _state(self) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
        return {}, {}

    @classmethod
    def _restore(cls, header: Any, arrays: Any, children: Mapping[str, Reflectance]) -> Reflectance:
        return cls(children["base"])


class QuarterTurned(Rearranged):
    """The base, lying on the surface turned by 90 degrees about the normal: its tangent is the bitangent here."""

    def pair(self, wi: Vec, wo: Vec) -> tuple[Vec, Vec]:
        return Vec(wi.y, -wi.x, wi.z), Vec(wo.y, -wo.x, wo.z)


class Transposed(Rearranged):
    """The base with light and viewer exchanged, f(wi, wo) = f_base(wo, wi): itself where it is reciprocal."""

    def pair(self, wi: Vec, wo: Vec) -> tuple[Vec, Vec]:
        return wo, wi
