"""Search in running sums, for kernels to call."""

from __future__ import annotations

from typing import Any

from numba import njit


@njit(error_model="numpy", nogil=True)
def first_above(sums: Any, u: Any, low: Any, high: Any) -> Any:
    """The first entry of sums[low:high + 1], which increase, that is above u; at most `high`."""
    while low < high:
        middle = (low + high) // 2
        if sums[middle] > u:
            high = middle
        else:
            low = middle + 1
    return low
