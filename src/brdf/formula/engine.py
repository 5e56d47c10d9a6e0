"""Evaluation: small inputs run the formula on NumPy as it stands, large ones its compiled kernel.

Both take and return flat (N, 3) arrays and apply the same guards: zero below the horizon, negative values clamped on
request, directions of unit length.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..errors import DirectionError
from . import ops
from .bound import UV, Bound, bound_value
from .vec import Vec

SMALL = 20_000
"""Pairs below which NumPy is faster than the kernel with its first-call latency."""

LENGTH_TOLERANCE = 1e-3


def evaluate(reflectance: Any, wi: Any, wo: Any, clamp: bool, uv: Any = None) -> Any:
    """The reflectance at (N, 3) pairs, in their dtype; `uv` (N, 2) for what varies in space. Raises DirectionError."""
    if len(wi) >= SMALL:
        from . import kernels

        return kernels.evaluate(reflectance, wi, wo, clamp, uv)
    check_lengths(wi, wo)
    with np.errstate(all="ignore"):  # lanes below the horizon may divide by zero; they are masked
        place = None if uv is None else Vec(*uv.T)
        rgb = run(reflectance, Vec(*wi.T), Vec(*wo.T), clamp, place, number=wi.dtype.type)
    value = np.empty_like(wi)
    for channel, component in enumerate(rgb):
        value[:, channel] = component
    return value


def run(reflectance: Any, wi: Vec, wo: Vec, clamp: bool, uv: Vec | None = None, number: Any = float) -> Vec:
    """The guarded formula on components of any array library."""

    def lookup(name: str) -> Any:
        if name == UV:
            return uv
        values = reflectance.values
        return bound_value(values[name], number) if name in values else reflectance.textures[name]

    rgb: Vec = Bound(reflectance, lookup).f(wi, wo)
    if not reflectance.transmits:
        rgb = ops.where((wi.z > 0) & (wo.z > 0), rgb, 0.0 * wi.z)
    guarded: Vec = ops.maximum(rgb, 0.0 * wi.z) if clamp else rgb
    return guarded


def check_lengths(wi: Any, wo: Any) -> None:
    """Raises DirectionError when a direction is not of unit length."""
    for name, w in (("wi", wi), ("wo", wo)):
        squared = np.einsum("ij,ij->i", w, w)
        bad = ~(np.abs(squared - 1) < 2 * LENGTH_TOLERANCE)
        if bad.any():
            refuse_length(name, w, int(np.argmax(bad)))


def refuse_length(name: str, w: Any, index: int) -> None:
    """Raise DirectionError for direction `index`."""
    length = float(np.linalg.norm(w[index]))
    raise DirectionError(f"{name} must hold unit vectors; the one at flat index {index} has length {length:.6g}")
