"""Rows of a goniometer's table as a reflectance."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..color import xyz_to_rgb
from ..errors import CorruptFileError
from ..geometry.directions import pairs_from_spherical
from ..representations.scattered import Scattered

Array = NDArray[np.float64]


def scattered(path: Path, wavelengths: Array | None, angles: Array, values: Array) -> Scattered:
    """What `Scattered.from_samples` makes of angles (N, 4), theta and phi of the light and of the viewer [rad].

    Raises CorruptFileError.
    """
    try:
        return Scattered.from_samples(*pairs_from_spherical(angles), values, wavelengths)
    except ValueError as error:
        raise CorruptFileError(path, f"{error}.") from None


def measured_rgb(xyz: NDArray[np.floating[Any]]) -> Array:
    """RGB (N, 3) of measured XYZ: colours out of gamut are clamped; rows with a negative value, a hole, stay."""
    rgb = np.where(xyz.min(1, keepdims=True) >= 0, np.maximum(xyz_to_rgb(xyz), 0), xyz)
    return rgb.astype(np.float64, copy=False)
