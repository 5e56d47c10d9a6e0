"""Base of the profiles: declared parameters, R(r), what it integrates to."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import ParameterError
from ..parameters import Parameterised

Floats = NDArray[np.float64]

REGISTRY: dict[str, type[Profile]] = {}
"""Every profile by its name in lower case; a profile enters by being defined."""


class Profile(Parameterised, ABC):
    """A reflectance profile R(r) in three channels, over distances in millimetres."""

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        REGISTRY[cls.__name__.lower()] = cls

    def __init__(self, /, **values: Any) -> None:
        super().__init__(**values)
        self.name = type(self).__name__

    def __call__(self, r: ArrayLike) -> Floats:
        """R(r) [1/mm2], (..., 3), at distances r (...) > 0 [mm]. Raises ParameterError."""
        distance = np.asarray(r, np.float64)
        if not np.all(distance > 0):
            raise ParameterError("distances must be above 0 mm")
        return self._at(distance[..., None])

    @abstractmethod
    def _at(self, r: Floats) -> Floats:
        """R at distances (..., 1)."""

    @abstractmethod
    def total(self) -> Floats:
        """Integral of 2 pi r R(r) over all distances, in closed form: the albedo, (3,)."""

    @abstractmethod
    def reach(self) -> Floats:
        """The longest length in the exponentials [mm], (3,): how far light spreads."""
