"""What several test files need."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray


def random_directions(count: int, seed: int = 0, least_cosine: float = 0.0) -> NDArray[np.float64]:
    """Unit vectors, uniform on the part of the upper hemisphere where z >= least_cosine."""
    rng = np.random.default_rng(seed)
    z = rng.uniform(least_cosine, 1.0, count)
    phi = rng.uniform(0.0, 2 * np.pi, count)
    r = np.sqrt(1 - z * z)
    return np.stack([r * np.cos(phi), r * np.sin(phi), z], -1)


def relative_error(value: Any, reference: Any, floor: float = 1e-9) -> NDArray[np.float64]:
    """|value - reference| / max(|reference|, floor)."""
    reference = np.asarray(reference, np.float64)
    return np.abs(np.asarray(value, np.float64) - reference) / np.maximum(np.abs(reference), floor)
