"""Nodes of a grid without a measurement get their neighbours' values, so that interpolation beside them works."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.floating[Any]]


def fill(values: Array, measured: NDArray[np.bool_], axes: tuple[int, ...]) -> None:
    """Along one axis after the other, give unmeasured nodes the nearest measured value before them, else after them.

    In place: `values` (*shape, C); `measured` (*shape) stays as it is.
    """
    known = measured.copy()
    for axis in axes:
        if known.all():
            return
        _fill_along(values, known, axis)


def _fill_along(values: Array, known: NDArray[np.bool_], axis: int) -> None:
    rows, flags = np.moveaxis(values, axis, 0), np.moveaxis(known, axis, 0)
    for order in (range(1, len(rows)), range(len(rows) - 2, -1, -1)):
        step = order.step
        for i in order:
            taken = ~flags[i] & flags[i - step]
            rows[i][taken] = rows[i - step][taken]
            flags[i] |= taken
