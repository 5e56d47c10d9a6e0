"""A sheet that reflects on both of its sides."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ReflectanceError
from ..formula import where
from ..formula.vec import Vec
from ..geometry.sampling import Sampler, event_probability
from ..reflectance import Floats, Reflectance


class TwoSided(Reflectance):
    """`front` for light and viewer above the surface, `back` for both below it, 0 through it.

        f(wi, wo) = f_front(wi, wo)            where wi.z > 0 and wo.z > 0
                  = f_back(wi', wo')           where wi.z < 0 and wo.z < 0,   w' = (w.x, w.y, -w.z)
                  = 0                          else

    Without a `back` both sides are alike. Raises ReflectanceError for sides that transmit or vary in kind.
    """

    transmits = True

    def __init__(self, front: Reflectance, back: Reflectance | None = None) -> None:
        self._children = {"front": front} if back is None else {"front": front, "back": back}
        for side, m in self._children.items():
            if m.transmits:
                raise ReflectanceError(f"the {side} of a two-sided reflectance must not transmit, {m.name} does")
        self.name = " | ".join(m.name or type(m).__name__ for m in self._children.values())

    @property
    def children(self) -> Mapping[str, Reflectance]:
        return self._children

    @property
    def _sides(self) -> tuple[Reflectance, Reflectance]:
        return self._children["front"], self._children.get("back", self._children["front"])

    @property
    def has_formula(self) -> bool:
        return all(m.has_formula for m in self._children.values())

    @property
    def isotropic(self) -> bool:
        return all(m.isotropic for m in self._children.values())

    @property
    def varies(self) -> bool:  # type: ignore[override]
        return any(m.varies for m in self._children.values())

    @property
    def structure(self) -> tuple[Any, ...]:
        return (TwoSided, *((side, m.structure) for side, m in self._children.items()))

    @property
    def values(self) -> Mapping[str, Any]:
        return {f"{side}_{k}": v for side, m in self._children.items() for k, v in m.values.items()}

    @property
    def textures(self) -> Mapping[str, NDArray[Any]]:
        return {f"{side}_{k}": v for side, m in self._children.items() for k, v in m.textures.items()}

    def f(self, wi: Vec, wo: Vec) -> Vec:
        bound: Any = self
        side = where(wo.z < 0.0, -1.0, 1.0)
        above_wi, above_wo = Vec(wi.x, wi.y, wi.z * side), Vec(wo.x, wo.y, wo.z * side)
        value = bound.front.f(above_wi, above_wo)
        if "back" in self.children:
            value = where(wo.z < 0.0, bound.back.f(above_wi, above_wo), value)
        lit: Vec = where((above_wi.z > 0.0) & (above_wo.z > 0.0), value, 0.0 * wi.z)
        return lit

    def _evaluate_arrays(self, wi: Floats, wo: Floats, clamp: bool) -> Floats:
        return self._evaluate_places(wi, wo, np.full((len(wi), 2), 0.5, wi.dtype), clamp)

    def _evaluate_places(self, wi: Floats, wo: Floats, uv: Floats, clamp: bool) -> Floats:
        value = np.zeros_like(wi)
        for m, part, flip in _by_side(self._sides, wo):
            evaluate = m if clamp else m.raw
            value[part] = evaluate(wi[part] * flip, wo[part] * flip, uv[part])
        return value

    def _delta_arrays(self, wi: Floats, wo: Floats) -> Floats:
        carried = np.zeros_like(wi)
        for m, part, flip in _by_side(self._sides, wo):
            carried[part] = m.delta(wi[part] * flip, wo[part] * flip)
        return carried

    def _make_sampler(self) -> Sampler:
        return TwoSidedSampler(self._sides)

    def _state(self) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
        return {}, {}

    @classmethod
    def _restore(cls, header: Any, arrays: Any, children: Mapping[str, Reflectance]) -> Reflectance:
        return cls(children["front"], children.get("back"))


class TwoSidedSampler:
    """Each side's own sampler, mirrored in the surface for viewers below it."""

    def __init__(self, sides: tuple[Reflectance, Reflectance]) -> None:
        self._sides = sides

    def sample(self, wo: Floats, u: Floats) -> tuple[Floats, NDArray[np.bool_]]:
        wi, is_delta = np.empty_like(wo), np.zeros(len(wo), bool)
        for m, part, flip in _by_side(self._sides, wo):
            drawn, is_delta[part] = m.sampler.sample(wo[part] * flip, u[part])
            wi[part] = drawn * flip
        return wi, is_delta

    def pdf(self, wi: Floats, wo: Floats) -> Floats:
        density = np.zeros(len(wi), wi.dtype)
        for m, part, flip in _by_side(self._sides, wo):
            density[part] = m.sampler.pdf(wi[part] * flip, wo[part] * flip)
        return density

    def event_probability(self, wi: Floats, wo: Floats) -> Floats:
        probability = np.zeros(len(wi), wi.dtype)
        for m, part, flip in _by_side(self._sides, wo):
            probability[part] = event_probability(m.sampler, wi[part] * flip, wo[part] * flip)
        return probability


def _by_side(sides: tuple[Reflectance, Reflectance], wo: Floats) -> list[tuple[Reflectance, NDArray[Any], Floats]]:
    """(side, the pairs whose viewer is on it, what turns them above the surface)."""
    below = wo[:, 2] < 0
    signs = (np.array([1, 1, sign], wo.dtype) for sign in (1, -1))
    parts = (np.flatnonzero(~below), np.flatnonzero(below))
    return [(m, part, flip) for m, part, flip in zip(sides, parts, signs, strict=True) if len(part)]
