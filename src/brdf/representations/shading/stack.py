"""What a shading map stores: a family of pictures S(r) of one surface, indexed by their average radiance r.

A stack says how the pictures are kept: as they are (`slices`), or as a few numbers a texel (`planes`).
All of them are read by a formula, S(level) at a place, for levels between `lowest` and `highest`; below and above the
shading map scales the picture at that end.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from itertools import pairwise
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...color import LUMINANCE
from ...errors import ParameterError
from ...formula import Scalar, Vec, clip, floor

Picture = NDArray[np.float64]
Place = tuple[Scalar, Scalar]
"""Texture coordinates (row, column)."""

MOST_NODES = 16
"""Pictures a stack may have: each is a term of the formula that finds a level between them."""


BOTTOM = 1e-4
"""The lowest level of pictures that are known down to black, as a share of the brightest."""


class Stack(ABC):
    """Pictures (rows, columns, 3) by average radiance; `nodes` (N,) are the averages of the N that were given.

    `wraps`: whether the picture continues at its opposite edge.
    """

    kinds: ClassVar[dict[str, type[Stack]]] = {}
    bottomless: ClassVar[bool] = False
    """Whether the pictures are known all the way down to black."""

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        Stack.kinds[cls.__name__] = cls

    def __init__(self, texels: NDArray[Any], nodes: ArrayLike, wraps: bool) -> None:
        self._texels = texels
        self.nodes = np.asarray(nodes, np.float64)
        self.wraps = bool(wraps)
        if self.nodes.ndim != 1 or not 1 <= len(self.nodes) <= MOST_NODES:
            raise ParameterError(f"a shading map keeps 1 to {MOST_NODES} pictures, got {self.nodes.size}")
        if not (np.isfinite(self.nodes).all() and self.nodes[0] > 0 and (np.diff(self.nodes) > 0).all()):
            raise ParameterError("the averages of a shading map's pictures must increase, from above 0")

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return self._texels.shape[0], self._texels.shape[1]

    @property
    def highest(self) -> float:
        """The average of the brightest picture."""
        return float(self.nodes[-1])

    @property
    def bytes_per_texel(self) -> float:
        """What the stored numbers cost, without constants that all texels share."""
        return self._texels.nbytes / (self.shape[0] * self.shape[1])

    @property
    def nbytes(self) -> int:
        return self._texels.nbytes

    @property
    def structure(self) -> tuple[Any, ...]:
        """What the formula depends on beside the numbers."""
        return (type(self), self._texels.shape, len(self.nodes), self.wraps)

    @property
    def values(self) -> dict[str, Any]:
        """Numbers of the formula by name: the nodes."""
        return dict(zip(self.node_names, self.nodes.tolist(), strict=True))

    @property
    def node_names(self) -> list[str]:
        return [f"node_{index + 1}" for index in range(len(self.nodes))]

    @property
    @abstractmethod
    def textures(self) -> dict[str, NDArray[np.float32]]:
        """Textures of the formula by name."""

    @abstractmethod
    def value(self, bound: Any, place: Place, level: Scalar) -> Vec:
        """The formula: S(level) at texture coordinates `place` (row, column); `bound` has values and textures."""

    @abstractmethod
    def picture(self, level: float) -> Picture:
        """S(level), (rows, columns, 3)."""

    @property
    def lowest(self) -> float:
        """The level below which the picture there is scaled."""
        return BOTTOM * self.highest if self.bottomless else float(self.nodes[0])

    def scaled_picture(self, r: float) -> Picture:
        """S(r) for any r >= 0: outside the levels known the picture at that end, scaled to r."""
        level = min(max(r, self.lowest), self.highest)
        return self.picture(level) * (r / level)

    @abstractmethod
    def features(self) -> NDArray[np.float32]:
        """(rows, columns, C): few numbers that tell texels apart as the pictures do."""

    @abstractmethod
    def gathered(self, texels: NDArray[np.intp], wraps: bool) -> Self:
        """The stack whose texel at each place is the one of flat index `texels` (rows, columns)."""

    @abstractmethod
    def state(self) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
        """A JSON header and arrays for `restored`."""

    @classmethod
    @abstractmethod
    def restored(cls, header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> Self:
        """The inverse of `state`. May raise KeyError, TypeError or ValueError."""

    # ---- formulas ----------------------------------------------------------------------------------------------

    def place(self, u: Scalar, v: Scalar, tiles: Scalar) -> Place:
        """Texture coordinates (row, column): u to the right, v up, `tiles` copies along each where it wraps."""
        if not self.wraps:
            return 1.0 - v, u
        rows, columns = self.shape
        down, right = -v * tiles, u * tiles
        return _within_rim(down, rows), _within_rim(right, columns)

    def ends(self, bound: Any) -> tuple[Scalar, Scalar]:
        """The lowest and the highest level."""
        highest = getattr(bound, self.node_names[-1])
        return (BOTTOM * highest if self.bottomless else bound.node_1), highest

    def rises(self, bound: Any, level: Scalar) -> list[Scalar]:
        """How far the level lies through each interval between nodes, 0 to 1: piecewise linear without a search."""
        nodes = [getattr(bound, name) for name in self.node_names]
        return [clip((level - low) * (1.0 / (high - low)), 0.0, 1.0) for low, high in pairwise(nodes)]


def _within_rim(x: Scalar, size: int) -> Scalar:
    """The coordinate in a texture that `with_rim` gave a rim to, of a place in repeated copies of `size` texels."""
    return ((x - floor(x)) * size + 1.0) * (1 / (size + 2))


def with_rim(texels: NDArray[np.float32], wraps: bool) -> NDArray[np.float32]:
    """The texture of (rows, columns, …) texels: what wraps gets a rim of its opposite edge, to be filtered with."""
    rim = [(1, 1), (1, 1)] + [(0, 0)] * (texels.ndim - 2)
    return np.pad(texels, rim, mode="wrap") if wraps else texels


def average(pictures: NDArray[np.floating[Any]]) -> NDArray[np.float64]:
    """Mean luminance, in float64, over the first two axes of (rows, columns, …, 3) -> (…)."""
    rows, columns, *inner = pictures.shape
    over_rows = pictures.reshape(rows, -1).sum(0, dtype=np.float64)
    mean = over_rows.reshape(columns, *inner).sum(0) / (rows * columns)
    return np.asarray(mean @ LUMINANCE)
