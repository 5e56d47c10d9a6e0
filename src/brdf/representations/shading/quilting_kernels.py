# mypy: allow-untyped-defs, allow-untyped-calls
"""Compiled loops of quilting: fine positions of a block, and the cheapest seam through an overlap."""

from __future__ import annotations

from typing import Any

import numba
import numpy as np

from ...formula.machine_code import kept_on_disk

_njit: Any = numba.njit(nogil=True, cache=kept_on_disk(), error_model="numpy")


@_njit
def best_nearby(source, target, filled, row, column, reach):
    """The position within `reach` of (row, column) where a block of the source fits the filled target best."""
    rows, columns, channels = target.shape
    best, found_row, found_column = np.float32(np.inf), row, column
    for r in range(max(row - reach, 0), min(row + reach, source.shape[0] - rows) + 1):
        for c in range(max(column - reach, 0), min(column + reach, source.shape[1] - columns) + 1):
            total = np.float32(0)
            for i in range(rows):
                for j in range(columns):
                    if filled[i, j]:
                        for k in range(channels):
                            d = source[r + i, c + j, k] - target[i, j, k]
                            total += d * d
                if total >= best:
                    break
            if total < best:
                best, found_row, found_column = total, r, c
    return found_row, found_column


@_njit
def seam(cost, start):
    """The cheapest path through `cost` (n, w): its column at each step, neighbours differing by at most 1.

    With `start` >= 0 it begins at that column and ends at most 1 from it, so that it closes when repeated.
    """
    n, w = cost.shape
    total = np.empty((n, w))
    for j in range(w):
        total[0, j] = cost[0, j] if start < 0 or j == start else np.inf
    for i in range(1, n):
        for j in range(w):
            least = total[i - 1, j]
            if j > 0:
                least = min(least, total[i - 1, j - 1])
            if j < w - 1:
                least = min(least, total[i - 1, j + 1])
            total[i, j] = least + cost[i, j]
    path = np.empty(n, np.int64)
    low, high = (0, w - 1) if start < 0 else (max(start - 1, 0), min(start + 1, w - 1))
    path[n - 1] = low + np.argmin(total[n - 1, low : high + 1])
    for i in range(n - 2, -1, -1):
        j = path[i + 1]
        left, right = max(j - 1, 0), min(j + 1, w - 1)
        path[i] = left + np.argmin(total[i, left : right + 1])
    return path
