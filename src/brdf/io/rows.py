"""Rows of a goniometer's table as a reflectance."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import CorruptFileError
from ..geometry.directions import from_spherical
from ..representations.scattered import Scattered

Array = NDArray[np.float64]


def scattered(path: Path, wavelengths: Array | None, angles: Array, values: Array) -> Scattered:
    """What `Scattered.from_samples` makes of angles (N, 4), theta and phi of the light and of the viewer [rad].

    Raises CorruptFileError.
    """
    wi, wo = (from_spherical(angles[:, k], angles[:, k + 1]) for k in (0, 2))
    try:
        return Scattered.from_samples(wi, wo, values, wavelengths)
    except ValueError as error:
        raise CorruptFileError(path, f"{error}.") from None
