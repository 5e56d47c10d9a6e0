"""Pictures of a sphere as arrays: what is accepted, and what a storage gives back."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import ParameterError
from ...formula import Vec
from ..storage import storage

Array = NDArray[np.floating[Any]]


def packed(images: ArrayLike, store: str) -> tuple[NDArray[Any], Mapping[str, ArrayLike]]:
    """Codes and constants of images (N, size, size, 3). Raises ParameterError, UnknownNameError."""
    return storage(store).pack(_checked_images(images))


def _checked_images(images: ArrayLike) -> Array:
    """(N, size, size, 3) float32. Raises ParameterError."""
    array = np.asarray(images, np.float32)
    if array.ndim != 4 or array.shape[1] != array.shape[2] or array.shape[3] != 3 or array.shape[1] < 2:
        raise ParameterError(f"images must have shape (N, size, size, 3), got {array.shape}")
    if not np.isfinite(array).all():
        raise ParameterError("the images hold NaN or infinity; replace those pixels first")
    return array


def checked_angles(angles: ArrayLike, count: int | None = None) -> tuple[float, ...]:
    """The angles [degrees]: at least 2 (and `count`), increasing, in [0, 180). Raises ParameterError."""
    array = np.asarray(angles, np.float64)
    if array.ndim != 1 or len(array) < 2:
        raise ParameterError(f"at least 2 pictures at increasing angles are needed, got angles {angles!r}")
    if count is not None and len(array) != count:
        raise ParameterError(f"{count} pictures have {len(array)} angles; give one angle a picture")
    if not (np.all(np.diff(array) > 0) and array[0] >= 0 and array[-1] < 180):
        raise ParameterError(f"angles must increase within [0, 180) degrees, got {[float(a) for a in array]}")
    return tuple(float(a) for a in array)


def decoded(texels: NDArray[Any], store: str, constants: Mapping[str, Array]) -> NDArray[np.float32]:
    """Radiance (..., 3) of texels (..., 3) as that storage has them."""
    channels = storage(store).value(Vec(*np.moveaxis(texels, -1, 0)), _Channels(constants))
    return np.stack(channels.components, -1).astype(np.float32)


class _Channels:
    """(3,) constants of a storage as the formula has them."""

    def __init__(self, values: Mapping[str, Array]) -> None:
        self.__dict__.update({name: Vec(*value) for name, value in values.items()})
