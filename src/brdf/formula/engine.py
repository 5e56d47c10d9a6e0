"""Evaluation: small inputs run the formula on NumPy as it stands, large ones its compiled kernel.

Both take and return flat (N, 3) arrays and apply the same guards: zero below the horizon, negative values clamped on
request, directions of unit length. In float64 the two agree to the last digits, so a kernel that would have to be
compiled first waits until a formula has been asked for enough to pay for it; float32, the currency of pictures, always
takes the kernel, so that a picture does not depend on what was compiled before.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..errors import DirectionError
from ..threads import in_ranges
from . import ops
from .bound import UV, Bound, bound_value
from .vec import Vec

SMALL = 20_000
"""Pairs below which NumPy is faster than the kernel with its first-call latency."""

WORTH_COMPILING = 1_500_000
"""Pairs that NumPy evaluates in the second or so that compiling takes."""

LENGTH_TOLERANCE = 1e-3

_asked: dict[tuple[Any, ...], int] = {}


def evaluate(reflectance: Any, wi: Any, wo: Any, clamp: bool, uv: Any = None) -> Any:
    """The reflectance at (N, 3) pairs, in their dtype; `uv` (N, 2) for what varies in space. Raises DirectionError."""
    if len(wi) >= SMALL:
        from . import kernels

        if wi.dtype == np.float32 or _pays(reflectance, len(wi)) or kernels.is_ready(reflectance, "float64"):
            return kernels.evaluate(reflectance, wi, wo, clamp, uv)
    check_lengths(wi=wi, wo=wo)
    value = np.empty_like(wi)

    def fill(start: int, stop: int) -> None:
        i, o = Vec(*wi[start:stop].T), Vec(*wo[start:stop].T)
        with np.errstate(all="ignore"):  # lanes below the horizon may divide by zero; they are masked
            place = None if uv is None else Vec(*uv[start:stop].T)
            rgb = run(reflectance, i, o, clamp, place, number=wi.dtype.type)
        for channel, component in enumerate(rgb):
            value[start:stop, channel] = component

    in_ranges(fill, len(wi), SMALL)
    return value


def _pays(reflectance: Any, count: int) -> bool:
    """Whether as much has been asked of this formula in float64 as compiling it costs."""
    key = reflectance.structure
    _asked[key] = _asked.get(key, 0) + count
    return _asked[key] >= WORTH_COMPILING


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


def check_lengths(**directions: Any) -> None:
    """Raises DirectionError when one of the (N, 3) directions, given by name, is not of unit length."""
    for name, w in directions.items():
        squared = np.einsum("ij,ij->i", w, w)
        bad = ~(np.abs(squared - 1) < 2 * LENGTH_TOLERANCE)
        if bad.any():
            refuse_length(name, w, int(np.argmax(bad)))


def refuse_length(name: str, w: Any, index: int) -> None:
    """Raise DirectionError for direction `index`."""
    length = float(np.linalg.norm(w[index]))
    raise DirectionError(f"{name} must hold unit vectors; the one at flat index {index} has length {length:.6g}")
