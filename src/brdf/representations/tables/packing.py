"""Grids of more axes than a graphics card has textures for, laid out in fewer.

A table over four angles lies in memory as one isotropic grid after the other, azimuth by azimuth. Cards have textures
of three axes or two, and filter within those only: neighbouring grids are read separately and mixed.

    3 axes: (n_phi n1, n2, n3), which is the memory as it is (`Layout.texture_shape`). The place of (phi, x1, x2, x3),
    counted in nodes, is (floor(phi) n1 + x1, x2, x3), and the same at the next azimuth (the first after the last).
    2 axes: tiles of n2 x n3 nodes, `columns` to a row: tile k = phi n1 + x1 at row k // columns, column k % columns.
    Four bilinear lookups for four axes are mixed over phi and x1; two for three axes. Since nodes sit at texel
    centres and reach from 0 to n - 1, no lookup reaches across a tile's edge.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError

MOST_TEXELS = 16384
"""An axis of a texture on common cards."""


def columns_of(tiles: int, height: int, width: int) -> int:
    """The number of tiles a row with which an atlas of `tiles` of so many texels comes closest to a square."""
    return min(max(round(math.sqrt(tiles * height / width)), 1), tiles)


def pack_slices(grid: NDArray[Any], columns: int | None = None) -> NDArray[Any]:
    """A grid (…, n2, n3, C) of any number of axes as one picture (rows n2, columns n3, C) of its slices.

    Tiles left over at the end repeat the last slice. Raises ParameterError when the picture is larger than a card
    takes, or for less than one column.
    """
    height, width, channels = grid.shape[-3:]
    slices = grid.reshape(-1, height, width, channels)
    columns = columns_of(len(slices), height, width) if columns is None else columns
    if columns < 1:
        raise ParameterError(f"an atlas has at least one column, got {columns}")
    rows = -(-len(slices) // columns)
    if max(rows * height, columns * width) > MOST_TEXELS:
        raise ParameterError(
            f"an atlas of {rows * height} x {columns * width} texels is larger than {MOST_TEXELS} an axis; use a "
            "coarser grid"
        )
    filled = slices[np.minimum(np.arange(rows * columns), len(slices) - 1)]
    tiles = filled.reshape(rows, columns, height, width, channels)
    return np.ascontiguousarray(tiles.swapaxes(1, 2).reshape(rows * height, columns * width, channels))


def unpack_slices(picture: NDArray[Any], shape: tuple[int, ...]) -> NDArray[Any]:
    """The grid of `shape` (its axes, channels aside) that `pack_slices` made a picture of.

    Raises ParameterError when the picture does not hold it.
    """
    *leading, height, width = shape
    rows, columns = picture.shape[0] // height, picture.shape[1] // width
    count = math.prod(leading)
    if picture.shape[:2] != (rows * height, columns * width) or not count <= rows * columns < count + columns:
        raise ParameterError(f"a picture of {picture.shape[:2]} texels does not hold a grid of {shape}")
    tiles = picture.reshape(rows, height, columns, width, -1).swapaxes(1, 2)
    return np.ascontiguousarray(tiles.reshape(rows * columns, height, width, -1)[:count].reshape(*shape, -1))
