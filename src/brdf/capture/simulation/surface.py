"""A small piece of a material: a height field that tiles the plane, and what its surface reflects."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError
from ...reflectance import Reflectance

Floats = NDArray[np.float32]


@dataclass(frozen=True)
class Layer:
    """A reflectance that counts as much as its weight says.

    Raises ParameterError for a reflectance without values: a mirror, glass.
    """

    reflectance: Reflectance
    weight: Floats
    """(n, n, 3), or (1, 1, 3) for the same everywhere"""

    def __post_init__(self) -> None:
        m = self.reflectance
        if m.has_delta or m.transmits:
            raise ParameterError(f"{m.name or type(m).__name__} mirrors or transmits; a relief needs rough reflection")

    def weights(self, texels: NDArray[np.int32]) -> Floats:
        """(N, 3) or (1, 3) weights of the texels, numbered row by row."""
        flat = self.weight.reshape(-1, 3)
        return flat if len(flat) == 1 else flat[texels]


@dataclass(frozen=True)
class MicroSurface:
    """A height field of n x n texels that continues itself on all sides; f = sum of weight times reflectance.

    `height` (n, n) in widths of the tile, first row at the top. Raises ParameterError for heights that are none.
    """

    height: NDArray[np.floating[Any]]
    layers: Sequence[Layer]

    def __post_init__(self) -> None:
        height = np.asarray(self.height, np.float32)
        if height.ndim != 2 or height.shape[0] != height.shape[1] or not height.size or not np.isfinite(height).all():
            raise ParameterError(f"a height field must be square and finite, got shape {height.shape}")
        object.__setattr__(self, "height", height)
        if not self.layers:
            raise ParameterError("a surface needs at least one reflectance")

    @property
    def size(self) -> int:
        return int(self.height.shape[0])

    def covered_by(self, reflectance: Reflectance) -> MicroSurface:
        """The same relief, of one reflectance all over."""
        return MicroSurface(self.height, (Layer(reflectance, np.ones((1, 1, 3), np.float32)),))
