"""Reflectance -> table: evaluate it at the nodes."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ReflectanceError
from ...reflectance import Reflectance
from ..tables.bases import Basis
from ..tables.layout import Layout
from ..tables.table import Table

Array = NDArray[np.floating[Any]]
Validity = NDArray[np.bool_]

HORIZON_MARGIN = 0.004
"""How far above the horizon a node below it is evaluated [rad]."""

LEAST_COSINE = 1e-4
"""Directions closer to the horizon than this take no part: many models are unbounded there."""


_MIRRORED = np.array([[0.0, 0.0, 1.0], [0.36, 0.48, 0.8]])
"""Viewers whom a scale too large for single precision shows itself to, with the light opposite."""


def require_isotropic(m: Reflectance) -> None:
    """Raises ReflectanceError for what a table over three angles cannot hold."""
    if not m.isotropic:
        raise ReflectanceError(
            f"{m.name or type(m).__name__} is anisotropic; a table over three angles holds isotropic reflectances only"
        )
    require_values(m)


def require_values(m: Reflectance) -> None:
    """Raises ReflectanceError for what no table can hold."""
    if m.transmits:
        raise ReflectanceError(f"{m.name or type(m).__name__} transmits; a table holds reflection only")
    if m.has_delta:
        raise ReflectanceError(
            f"{m.name or type(m).__name__} mirrors like a polished surface, which has no values a table could hold; "
            "give it a width (a GGX lobe) first"
        )
    require_storable(m, m(_MIRRORED * [-1, -1, 1], _MIRRORED), "a table")


def require_storable(m: Reflectance, values: Array, kind: str, below: float = 1e30) -> None:
    """Raises ReflectanceError for values that readers of this kind of file take for broken ones."""
    largest = float(np.abs(values).max())
    if not largest < below:
        found = f"reaches {largest:.3g} 1/sr" if np.isfinite(largest) else "is NaN or infinite in some directions"
        raise ReflectanceError(
            f"{m.name or type(m).__name__} {found}, and {kind} holds values below {below:g} alone; give it a "
            "smaller scale or a width, or write another format"
        )


def validity(m: Reflectance, wi: Array, wo: Array) -> Validity:
    """Where `m` is well known: clear of the horizon and, in a table with holes, measured."""
    above = np.asarray((wi[..., 2] > LEAST_COSINE) & (wo[..., 2] > LEAST_COSINE))
    return above & m.valid(wi, wo) if isinstance(m, Table) else above


def evaluate(m: Reflectance, basis: Basis, wi: Array, wo: Array, symmetrise: bool) -> tuple[Array, Validity]:
    """Values (..., 3) of `m` and where they are valid; with `symmetrise` the mean over the valid ones of all pairs that
    the basis does not tell apart (measurements are neither exactly reciprocal nor mirror symmetric). Below the horizon
    the values are 0."""
    above = (wi[..., 2] > 0) & (wo[..., 2] > 0)
    wi, wo = wi[above], wo[above]
    images = basis.images(wi, wo) if symmetrise else [(wi, wo)]
    total, count = np.zeros((len(wi), 3)), np.zeros(len(wi))
    plain, valid = np.zeros((len(wi), 3)), np.zeros(len(wi), np.bool_)
    for pair in images:
        value, known = m(*pair), validity(m, *pair)
        total += np.where(known[:, None], value, 0)
        count += known
        plain += value / len(images)
        valid |= known
    values, validities = np.zeros((*above.shape, 3)), np.zeros(above.shape, np.bool_)
    values[above] = np.where(valid[:, None], total / np.maximum(count, 1)[:, None], plain)
    validities[above] = valid
    return values, validities


def diffuse_floor(values: Array, valid: NDArray[np.bool_], quantile: float) -> Array:
    """(3,) the least (or a low quantile) of the valid values (..., 3) of each channel; never negative."""
    kept = values[valid]
    if not len(kept):
        raise ReflectanceError("no valid value to bake: every sample is below the horizon or unmeasured")
    low = np.quantile(kept, quantile, axis=0)
    return np.asarray(np.maximum(low, 0).astype(np.float32), np.float64)


def bake_points(m: Reflectance, layout: Layout, floor_quantile: float | None = None, symmetrise: bool = False) -> Table:
    """A table of `m` evaluated at the nodes.

    Nodes below the horizon take the value just above it (interpolation needs them). With `floor_quantile` the encoding
    subtracts that quantile of the values (0: their minimum); see `evaluate` for
    `symmetrise`. Raises ReflectanceError when `m` is not isotropic but the layout is.
    """
    require_isotropic(m) if layout.basis.isotropic else require_values(m)
    basis, encoding = layout.basis, layout.encoding
    stored = np.empty((*layout.texture_shape, 3), np.float32)
    known = np.empty(layout.texture_shape, np.bool_)
    for rows, angles in layout.slabs():
        wi, wo = basis.directions(*basis.above_horizon(*angles, margin=HORIZON_MARGIN))
        stored[rows] = evaluate(m, basis, wi, wo, symmetrise)[0] if symmetrise else m(wi, wo)
        if floor_quantile is not None:
            known[rows] = validity(m, *basis.directions(*angles))
    _require_finite(m, stored)
    floor = None if floor_quantile is None else diffuse_floor(encoding.scale * stored, known, floor_quantile)
    for rows, angles in layout.slabs():
        wi, wo = basis.directions(*basis.above_horizon(*angles, margin=HORIZON_MARGIN))
        stored[rows] = encoding.encode(stored[rows], _cos_d(wi, wo), np.zeros(3) if floor is None else floor)
    table = Table.encoded(layout, stored.reshape(*layout.shape, 3), floor)
    return table.named(m.name, f"{m.source or m.name}, baked at the nodes")


def _require_finite(m: Reflectance, values: Array) -> None:
    broken = int(np.count_nonzero(~np.isfinite(values).all(axis=-1)))
    if broken:
        raise ReflectanceError(
            f"{m.name or type(m).__name__} is NaN or infinite at {broken} of {values[..., 0].size} nodes; mask or fill "
            "them before baking"
        )


def _cos_d(wi: Array, wo: Array) -> Array:
    return 0.5 * np.asarray(np.linalg.norm(wi + wo, axis=-1))
