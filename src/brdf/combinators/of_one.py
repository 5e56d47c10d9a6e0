"""What reflectances made of one other take from it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from numpy.typing import NDArray

from ..reflectance import Reflectance


class OfOne(Reflectance):
    """A reflectance with a `base`, which it calls by that name in its formula."""

    def __init__(self, base: Reflectance) -> None:
        self._children = {"base": base}
        self.name = base.name

    @property
    def children(self) -> Mapping[str, Reflectance]:
        return self._children

    @property
    def has_formula(self) -> bool:
        return self._children["base"].has_formula

    @property
    def isotropic(self) -> bool:
        return self._children["base"].isotropic

    @property
    def varies(self) -> bool:  # type: ignore[override]
        return self._children["base"].varies

    @property
    def structure(self) -> tuple[Any, ...]:
        return (type(self), self._children["base"].structure)

    @property
    def values(self) -> Mapping[str, Any]:
        return {f"base_{k}": v for k, v in self._children["base"].values.items()}

    @property
    def textures(self) -> Mapping[str, NDArray[Any]]:
        return {f"base_{k}": v for k, v in self._children["base"].textures.items()}
