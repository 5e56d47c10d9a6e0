"""Principal components of many short vectors, on all cores."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..threads import in_ranges, map_threads

BLOCK = 16384
"""Vectors a thread takes at a time: few enough for sums in float32."""


class Components(NamedTuple):
    """vectors ≈ mean + coefficients @ basis."""

    mean: NDArray[np.float64]
    """(D,)"""
    basis: NDArray[np.float64]
    """(C, D) orthonormal, the largest variance first"""
    coefficients: NDArray[np.float32]
    """(N, C)"""


def principal_components(vectors: NDArray[np.float32], count: int) -> Components:
    """The `count` directions in which the `vectors` (N, D) vary most, and their coordinates along them."""
    starts = range(0, len(vectors), BLOCK)
    guess = vectors[:: max(1, len(vectors) // 1024)].mean(0)  # near the mean: sums of squares then do not cancel

    def moments(start: int) -> tuple[NDArray[Any], NDArray[Any]]:
        block = vectors[start : start + BLOCK] - guess
        return block.sum(0, dtype=np.float64), (block.T @ block).astype(np.float64)

    sums = map_threads(moments, starts)
    offset = sum((first for first, _ in sums), np.zeros(vectors.shape[1])) / len(vectors)
    second = sum((square for _, square in sums), np.zeros((vectors.shape[1],) * 2)) / len(vectors)
    _, directions = np.linalg.eigh(second - np.outer(offset, offset))
    basis = np.ascontiguousarray(directions.T[::-1][:count])
    basis *= np.where(basis.sum(1, keepdims=True) < 0, -1, 1)  # a direction and its opposite are the same: choose one
    mean = guess + offset
    coefficients = np.empty((len(vectors), count), np.float32)

    def project(start: int, stop: int) -> None:
        np.matmul(
            vectors[start:stop] - mean.astype(np.float32), basis.T.astype(np.float32), out=coefficients[start:stop]
        )

    in_ranges(project, len(vectors), BLOCK)
    return Components(mean, basis, coefficients)
