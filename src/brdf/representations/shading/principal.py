"""Principal components of many short vectors.

The linear algebra library uses all cores by itself: threads of ours on top would only get in its way.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

BLOCK = 16384
"""Vectors taken at a time: few enough for sums in float32."""


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

    offset = np.zeros(vectors.shape[1])
    second = np.zeros((vectors.shape[1],) * 2)
    for start in starts:
        block = vectors[start : start + BLOCK] - guess
        offset += block.sum(0, dtype=np.float64) / len(vectors)
        second += (block.T @ block).astype(np.float64) / len(vectors)
    _, directions = np.linalg.eigh(second - np.outer(offset, offset))
    basis = np.ascontiguousarray(directions.T[::-1][:count])
    basis *= np.where(basis.sum(1, keepdims=True) < 0, -1, 1)  # a direction and its opposite are the same: choose one
    mean = guess + offset
    coefficients = np.empty((len(vectors), count), np.float32)
    for start in starts:
        block = vectors[start : start + BLOCK] - mean.astype(np.float32)
        np.matmul(block, basis.T.astype(np.float32), out=coefficients[start : start + BLOCK])
    return Components(mean, basis, coefficients)
