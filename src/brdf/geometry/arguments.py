"""What a call is given, as flat arrays: directions and places of any shape that broadcasts."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import DirectionError

Floats = NDArray[np.floating[Any]]


def as_directions(name: str, w: ArrayLike) -> Floats:
    """(..., 3) floats; float32 stays float32. Raises DirectionError."""
    array = np.asarray(w)
    if array.dtype != np.float32:
        if array.dtype.kind == "c":
            raise DirectionError(f"{name} must hold real numbers, got {array.dtype}")
        try:
            array = array.astype(np.float64, copy=False)
        except (TypeError, ValueError):
            raise DirectionError(f"{name} must hold numbers, got {array.dtype}") from None
    if array.ndim == 0 or array.shape[-1] != 3:
        raise DirectionError(f"{name} must have shape (..., 3), got {array.shape}")
    return array


MIDDLE = (0.5, 0.5)
"""Where what varies in space is taken when no place is given."""


def broadcast_places(wi: ArrayLike, wo: ArrayLike, uv: Any) -> tuple[Floats, Floats, Floats, tuple[int, ...]]:
    """As `broadcast_directions`, with the places as (N, 2). Raises DirectionError."""
    wi, wo = as_directions("wi", wi), as_directions("wo", wo)
    places = np.asarray(MIDDLE if uv is None else uv)
    if places.shape[-1:] != (2,) or places.dtype.kind not in "fiu":
        raise DirectionError(f"uv must have shape (..., 2), got {places.shape}")
    try:
        shape = np.broadcast_shapes(wi.shape[:-1], wo.shape[:-1], places.shape[:-1])
    except ValueError:
        raise DirectionError(f"wi {wi.shape}, wo {wo.shape} and uv {places.shape} do not broadcast") from None
    flat_wi, flat_wo, _ = broadcast_directions(np.broadcast_to(wi, (*shape, 3)), wo)
    return flat_wi, flat_wo, flat_places(places, shape).astype(flat_wi.dtype, copy=False), shape


def flat_places(uv: Any, shape: tuple[int, ...]) -> Floats:
    """Places (..., 2) as (N, 2), one for each element of `shape`."""
    return np.broadcast_to(np.asarray(uv), (*shape, 2)).reshape(-1, 2)


def broadcast_directions(wi: ArrayLike, wo: ArrayLike) -> tuple[Floats, Floats, tuple[int, ...]]:
    """Both as (N, 3) of one dtype, and the shape they broadcast to. Raises DirectionError."""
    wi, wo = as_directions("wi", wi), as_directions("wo", wo)
    try:
        shape = np.broadcast_shapes(wi.shape[:-1], wo.shape[:-1])
    except ValueError:
        raise DirectionError(f"wi {wi.shape} and wo {wo.shape} do not broadcast") from None
    dtype = np.result_type(wi, wo)
    flat = [np.broadcast_to(w.astype(dtype, copy=False), (*shape, 3)).reshape(-1, 3) for w in (wi, wo)]
    return flat[0], flat[1], shape
