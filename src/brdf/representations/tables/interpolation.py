"""Linear interpolation on a grid as a sparse matrix: what fitting a table to scattered samples needs."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray


def reading(coordinates: Sequence[Any], grid: tuple[int, ...]) -> tuple[NDArray[np.intp], Any]:
    """The nodes (flat indices) that a linear lookup at N texture coordinates reads, and its weights, sparse (N, nodes).

    Coordinates (N,) each are those of `texture3d`: the first and the last node are the centres of the outer texels.
    """
    from scipy.sparse import csr_array

    positions = [np.clip(u * n - 0.5, 0, n - 1) for u, n in zip(coordinates, grid, strict=True)]
    below = [np.minimum(p.astype(np.intp), n - 2) for p, n in zip(positions, grid, strict=True)]
    count = len(positions[0])
    nodes, weights = np.empty((8, count), np.intp), np.empty((8, count))
    for corner, steps in enumerate(itertools.product((0, 1), repeat=3)):
        nodes[corner] = np.ravel_multi_index([b + s for b, s in zip(below, steps, strict=True)], grid)
        weights[corner] = math.prod(
            p - b if s else 1 - (p - b) for p, b, s in zip(positions, below, steps, strict=True)
        )
    used, columns = np.unique(nodes, return_inverse=True)
    rows = np.broadcast_to(np.arange(count), nodes.shape)
    return used, csr_array((weights.ravel(), (rows.ravel(), columns.ravel())), shape=(count, len(used)))
