"""How far two evaluations that should agree lie apart."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.floating[Any]]


def asymmetry(a: Floats, b: Floats, weight: Floats) -> tuple[float, int]:
    """Weighted mean of |a - b| over that of (|a| + |b|) / 2, and the index of the pair that contributes most.

    `a`, `b`: (N, C); `weight`: (N,). 0 where both vanish, infinite where a value is not finite.
    """
    with np.errstate(invalid="ignore"):
        difference = np.abs(a - b).sum(-1) * weight
    total = float(((np.abs(a) + np.abs(b)).sum(-1) * weight).sum()) / 2
    worst = int(np.argmax(np.where(np.isfinite(difference), difference, np.inf)))
    if not np.isfinite(total):
        return np.inf, worst
    return (float(difference.sum()) / total if total > 0 else 0.0), worst
