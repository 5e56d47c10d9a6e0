"""Base of the analytic models: declared parameters, one formula, self-registration."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..parameters import Parameterised
from ..reflectance import Reflectance

REGISTRY: dict[str, type[Model]] = {}
"""Every concrete model by class name; a model enters by being defined."""


class Model(Parameterised, Reflectance):
    """An analytic model. A subclass declares parameters and gives `f`; see `parameters` for the declarations."""

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        if cls.f is not Reflectance.f:
            REGISTRY[cls.__name__] = cls

    def __init__(self, /, **values: Any) -> None:
        super().__init__(**values)
        self.name = type(self).__name__

    def _state(self) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
        numbers = {k: np.asarray(v).tolist() for k, v in self.values.items()}
        return {"choices": self.choices, "values": numbers}, dict(self.given_textures)

    @classmethod
    def _restore(cls, header: Mapping[str, Any], arrays: Any, children: Any) -> Reflectance:
        return cls(**header["choices"], **header["values"], **arrays)
