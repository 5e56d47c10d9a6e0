"""How a table is laid out: which angles, where the nodes lie, what is stored, how it is read between nodes."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ReflectanceError
from ...formula import Scalar, Vec, floor, mix, texture3d, where
from ...geometry.warps import Angle, Warp, warp_from
from ..storage import storage
from . import anisotropic, specular, triangle_bases  # noqa: F401  # they enter the registry of bases
from .bases import Basis, basis_from
from .encoding import Encoding, encoding_from
from .filters import texture_filter

Array = NDArray[np.floating[Any]]


@dataclass(frozen=True)
class Layout:
    """Everything of a table but its numbers.

    The nodes of an axis sit at its ends (vertex-centred): node i of n has the warp's coordinate i / (n - 1). The
    azimuth of an anisotropic basis is a circle: there it is i / n. Such a grid of four axes lies in a texture of three,
    one isotropic grid after the other along the first axis, which is how it lies in memory anyway; it is read by two
    trilinear lookups and a mix, for which cubic filters are not made. See `filters` for `filter`.
    """

    basis: Basis
    warps: tuple[Warp, ...]
    shape: tuple[int, ...]
    encoding: Encoding
    storage: str = "float32"
    filter: str = "linear"

    def __post_init__(self) -> None:
        axes = self.basis.axes
        if not len(axes) == len(self.warps) == len(self.shape) or min(self.shape) < 2:
            raise ReflectanceError(
                f"a table over {', '.join(axes)} has {len(axes)} axes of at least 2 nodes and a warp for each, "
                f"got shape {self.shape} and {len(self.warps)} warps"
            )
        if [warp.periodic for warp in self.warps] != [not self.basis.isotropic, False, False, False][-len(axes) :]:
            raise ReflectanceError("the azimuth of a table over four angles, and nothing else, lies on a Circle")
        if not self.basis.isotropic and self.warps[0].extent != self.basis.extents[0]:
            raise ReflectanceError(f"the azimuth's circle must have extent {self.basis.extents[0]:g}, as its basis")
        storage(self.storage)
        if texture_filter(self.filter) not in ("nearest", "linear") and not self.basis.isotropic:
            raise ReflectanceError(f"a table over four angles is read nearest or linear, not by {self.filter!r}")

    @property
    def texture_shape(self) -> tuple[int, ...]:
        """The three axes of the texture that holds the grid."""
        return math.prod(self.shape[:-2]), *self.shape[-2:]

    def nodes(self) -> tuple[Array, ...]:
        """The angles [rad] of the nodes, shaped to broadcast over the grid: (n, 1, 1), (1, n, 1), (1, 1, n)."""
        axes = [warp.nodes(n) for warp, n in zip(self.warps, self.shape, strict=True)]
        return tuple(np.meshgrid(*axes, indexing="ij", sparse=True))

    def slabs(self, most: int = 1 << 15) -> Iterator[tuple[slice, tuple[Array, ...]]]:
        """Rows of the texture, and the angles of their nodes: at most so many nodes at once (one row at least).

        What is done slab by slab needs memory for a slab, not for a grid of directions.
        """
        *leading, second, third = (warp.nodes(n) for warp, n in zip(self.warps, self.shape, strict=True))
        firsts = [axis.ravel() for axis in np.meshgrid(*leading, indexing="ij")]
        rows, step = self.texture_shape[0], max(most // math.prod(self.shape[-2:]), 1)
        for start in range(0, rows, step):
            block = slice(start, start + step)
            yield block, (*(axis[block, None, None] for axis in firsts), second[:, None], third)

    def positions(self, angles: tuple[Angle, ...]) -> list[Scalar]:
        """The formula: where angles lie between the nodes: i at node i, up to n - 1, or up to n around a circle."""
        axes = zip(self.warps, angles, self.shape, strict=True)
        return [warp.coordinate(angle) * (n if warp.periodic else n - 1) for warp, angle, n in axes]

    def texture_coordinates(self, angles: tuple[Angle, ...]) -> list[Scalar]:
        """The formula for three axes: texture coordinates that put node i at the centre of texel i."""
        return _coordinates(self.positions(angles), self.shape)

    def fetch(self, grid: Any, angles: tuple[Angle, ...], filter: str | None = None) -> Vec:
        """The formula: the channels of a texture of `texture_shape`, interpolated at angles (by another filter)."""
        how = texture_filter(filter or self.filter)
        if self.basis.isotropic:
            u, v, w = self.texture_coordinates(angles)
            return texture3d(grid, u, v, w, filter=how)
        turn, first, *others = self.positions(angles)
        count, rows = self.shape[:2]

        def read(index: Scalar) -> Vec:
            row = where(index < count - 0.5, index, index - count) * rows + first
            u, v, w = _coordinates([row, *others], self.texture_shape)
            return texture3d(grid, u, v, w, filter=how)

        below = floor(turn + 0.5 if how == "nearest" else turn)
        value: Vec = read(below) if how == "nearest" else mix(read(below), read(below + 1.0), turn - below)
        return value

    @property
    def wasted(self) -> float:
        """The share of the grid's volume, in coordinates, whose directions lie below the horizon."""
        u, weights = _graded_rule(64)
        first, third = (warp.angle(u) for warp in (self.warps[-3], self.warps[-1]))
        horizon = self.basis.horizon(first[:, None], third)
        used = self.warps[-2].coordinate(Angle(np.sin(horizon), np.cos(horizon)))
        return float(1 - weights @ used @ weights)

    @property
    def state(self) -> dict[str, Any]:
        return {
            "basis": self.basis.state,
            "warps": [warp.state for warp in self.warps],
            "shape": list(self.shape),
            "encoding": self.encoding.state,
            "storage": self.storage,
            "filter": self.filter,
        }


def layout_from(state: Mapping[str, Any]) -> Layout:
    """The layout that `Layout.state` describes. May raise any error for a broken description."""
    warps = tuple(map(warp_from, state["warps"]))
    shape = tuple(map(int, state["shape"]))
    encoding, how = encoding_from(state["encoding"]), state.get("filter", "linear")
    return Layout(basis_from(state["basis"]), warps, shape, encoding, state["storage"], how)


def _coordinates(positions: list[Scalar], shape: tuple[int, ...]) -> list[Scalar]:
    return [(position + 0.5) * (1 / n) for position, n in zip(positions, shape, strict=True)]


def _graded_rule(count: int) -> tuple[Array, Array]:
    """Points and weights over [0, 1], crowded at the ends and the middle, where horizons have corners."""
    x, weights = np.polynomial.legendre.leggauss(count)
    t = (x + 1) / 2
    graded, slope = t * t * (3 - 2 * t) / 2, 3 * t * (1 - t)
    return np.concatenate([graded, 0.5 + graded]), np.tile(slope * weights / 2, 2)
