"""A stack of pictures as they were taken, or resampled to even steps of average radiance."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from ...formula import Scalar, Vec, texture3d
from .principal import principal_components
from .stack import Picture, Place, Stack, average, with_rim

FEATURES = 3
"""Principal components that texels are compared by: they hold nearly all of the pictures' variance."""


class Slices(Stack):
    """N pictures, linearly interpolated between their averages.

    The nodes are measured on what is stored, so that the mean luminance of S(r) is r whatever rounding did.
    """

    def __init__(self, pictures: NDArray[np.float32], wraps: bool = False) -> None:
        """`pictures` (rows, columns, N, 3), linear, darkest first. Raises ParameterError when their averages do not
        increase.
        """
        super().__init__(pictures, average(pictures), wraps)

    @property
    def pictures(self) -> NDArray[np.float32]:
        """(rows, columns, N, 3)."""
        return self._texels

    @cached_property
    def textures(self) -> dict[str, NDArray[np.float32]]:
        return {"pictures": with_rim(self.pictures, self.wraps)}

    def value(self, bound: Any, place: Place, level: Scalar) -> Vec:
        layer = (sum(self.rises(bound, level), 0.0 * level) + 0.5) * (1 / len(self.nodes))
        value: Vec = texture3d(bound.pictures, *place, layer)
        return value

    def picture(self, level: float) -> Picture:
        below = max(0, min(int(np.searchsorted(self.nodes, level, side="right")) - 1, len(self.nodes) - 2))
        if len(self.nodes) == 1:
            return self.pictures[:, :, 0].astype(np.float64)
        share = (level - self.nodes[below]) / (self.nodes[below + 1] - self.nodes[below])
        low, high = (self.pictures[:, :, k].astype(np.float64) for k in (below, below + 1))
        return np.asarray((1 - share) * low + share * high)

    def features(self) -> NDArray[np.float32]:
        vectors = self.vectors()
        found = principal_components(vectors, min(FEATURES, vectors.shape[1]))
        return found.coefficients.reshape(*self.shape, -1)

    def vectors(self) -> NDArray[np.float32]:
        """(rows · columns, 3 N): what each texel shows in all pictures."""
        return self.pictures.reshape(self.shape[0] * self.shape[1], -1)

    def gathered(self, texels: NDArray[np.intp], wraps: bool) -> Self:
        taken = self.vectors()[texels]
        return type(self)(taken.reshape(*texels.shape, len(self.nodes), 3), wraps)

    def halved(self) -> Self:
        """Half as many rows and columns (rounded up): each picture averaged by area, the levels left alone.

        A picture's average is that of its area means, so that the nodes stay; averaging neighbouring levels, too, as a
        three-dimensional mip chain does, would shift them.
        """
        smaller: NDArray[np.float64] = self.pictures.astype(np.float64)
        for axis in (0, 1):
            smaller = _halved_along(smaller, axis)
        return type(self)(smaller.astype(np.float32), self.wraps)

    def state(self) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
        return {"wraps": self.wraps}, {"pictures": self.pictures}

    @classmethod
    def restored(cls, header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> Self:
        pictures = arrays["pictures"]
        if pictures.ndim != 4 or pictures.shape[-1] != 3 or pictures.dtype != np.float32 or not pictures.size:
            raise ValueError(f"pictures must be (rows, columns, N, 3) float32, got {pictures.shape} {pictures.dtype}")
        if not np.isfinite(pictures).all():
            raise ValueError("a picture holds NaN or infinity")
        return cls(pictures, header["wraps"])


def _halved_along(a: NDArray[np.float64], axis: int) -> NDArray[np.float64]:
    """Means over two texels; of an odd number n over n / ((n + 1) / 2), shares of texels included: means are kept."""
    size = a.shape[axis]
    if size == 1:
        return a
    count = (size + 1) // 2
    edges = np.arange(count + 1) * (size / count)
    zero = np.zeros_like(a.take([0], axis))
    sums = np.concatenate([zero, np.cumsum(a, axis)], axis)
    whole = np.minimum(edges.astype(int), size - 1)
    part = (edges - whole).reshape([-1 if k == axis else 1 for k in range(a.ndim)])
    at_edges = sums.take(whole, axis) + part * a.take(whole, axis)
    return np.asarray(np.diff(at_edges, axis=axis) * (count / size))
