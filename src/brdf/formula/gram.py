"""Products of the rows of a block, for kernels that accumulate normal equations."""

from __future__ import annotations

from typing import Any

from numba import njit

from .machine_code import kept_on_disk


@njit(nogil=True, cache=kept_on_disk(), error_model="numpy", fastmath={"contract", "nsz", "reassoc"})
def add_products(work: Any, first: int, rows: int, size: int, count: int, out: Any) -> None:
    """Add sum_i row_a[i] row_b[i], i < count, to out[a, b] for b <= a.

    Row k of `rows` is `work[(first + k) * size :]`. The sums of a block may be taken in any order (that is what makes
    them fast) and are in the numbers of `work`; `out` is float64.
    """
    for a in range(rows):
        at_a = (first + a) * size
        for b in range(a + 1):
            at_b = (first + b) * size
            total = work.dtype.type(0)
            for i in range(count):
                total += work[at_a + i] * work[at_b + i]
            out[a, b] += total
