"""Reflectance -> table: evaluate it at the nodes, or fit the nodes to samples between them by least squares."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ReflectanceError
from ..geometry.warps import Angle
from ..reflectance import Reflectance
from .layout import Layout
from .table import Table

Array = NDArray[np.floating[Any]]
Validity = NDArray[np.bool_]

HORIZON_MARGIN = 0.004
"""How far above the horizon a node below it is evaluated [rad]."""

LEAST_COSINE = 1e-4
"""Directions closer to the horizon than this take no part: many models are unbounded there."""


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


def validity(m: Reflectance, wi: Array, wo: Array) -> NDArray[np.bool_]:
    """Where `m` is well known: clear of the horizon and, in a table with holes, measured."""
    above = np.asarray((wi[..., 2] > LEAST_COSINE) & (wo[..., 2] > LEAST_COSINE))
    return above & m.valid(wi, wo) if isinstance(m, Table) else above


def evaluate(m: Reflectance, layout: Layout, wi: Array, wo: Array, symmetrise: bool) -> tuple[Array, Validity]:
    """Values (..., 3) of `m` and where they are valid; with `symmetrise` the mean over the valid ones of all pairs that
    the table does not tell apart (measurements are neither exactly reciprocal nor mirror symmetric)."""
    if not symmetrise:
        return m(wi, wo), validity(m, wi, wo)
    images = layout.basis.images(wi, wo)
    values = np.stack([m(*pair) for pair in images])
    valid = np.stack([validity(m, *pair) for pair in images])
    usable = np.where(valid.any(0), valid, True)
    mean = np.sum(values * usable[..., None], axis=0) / usable.sum(0)[..., None]
    return mean, np.asarray(valid.any(0))


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
    at_nodes = layout.nodes()
    angles = layout.basis.above_horizon(*at_nodes, margin=HORIZON_MARGIN)
    wi, wo = layout.basis.directions(*angles)
    values, _ = evaluate(m, layout, wi, wo, symmetrise)
    floor = None
    if floor_quantile is not None:
        valid = validity(m, *layout.basis.directions(*at_nodes))
        floor = diffuse_floor(layout.encoding.scale * values, valid, floor_quantile)
    stored = layout.encoding.encode(values, _cos_d(wi, wo), np.zeros(3) if floor is None else floor)
    return Table.encoded(layout, stored, floor).named(m.name, f"{m.source or m.name}, baked at the nodes")


def bake_least_squares(
    m: Reflectance,
    layout: Layout,
    floor_quantile: float,
    symmetrise: bool = False,
    samples: int = 120,
    stiffness: float = 1e-6,
) -> Table:
    """A table whose nodes along the second axis fit `m` best between them.

    Every column of nodes (i, :, k) is fitted by itself to `samples` values along it, as the table will interpolate
    them: weights cos_i cos_o (cos_i + cos_o) + 1e-5 on valid samples, 0 elsewhere, and `stiffness` times the squared
    first differences, which carries the values on below the horizon. See `evaluate`
    for `symmetrise`. Raises ReflectanceError when `m` is not isotropic.
    """
    require_isotropic(m)
    first, _, third = layout.nodes()
    along = (np.arange(samples) + 0.5) / samples * layout.basis.extents[1]
    wi, wo = layout.basis.directions(first, along[None, :, None], third)
    values, valid = evaluate(m, layout, wi, wo, symmetrise)
    floor = diffuse_floor(layout.encoding.scale * values, valid, floor_quantile)
    stored = layout.encoding.encode(values, _cos_d(wi, wo), floor)

    cos_i, cos_o = wi[..., 2], wo[..., 2]
    weight = np.where(valid, cos_i * cos_o * (cos_i + cos_o) + 1e-5, 0.0)
    hats = _interpolation_matrix(layout, along)
    normal = np.einsum("isk,sa,sb->ikab", weight, hats, hats, optimize=True)
    normal += _difference_penalty(layout.shape[1], stiffness)
    known = np.asarray(valid.any(axis=1))
    normal[~known] = np.eye(layout.shape[1])
    right = np.einsum("isk,sa,iskc->ikac", weight, hats, stored, optimize=True)
    fitted = np.linalg.solve(normal, right)
    fitted = np.moveaxis(fitted[_nearest_known(known)], 2, 1)
    return Table.encoded(layout, fitted, floor).named(m.name, f"{m.source or m.name}, baked by least squares")


def _cos_d(wi: Array, wo: Array) -> Array:
    return 0.5 * np.asarray(np.linalg.norm(wi + wo, axis=-1))


def _nearest_known(known: NDArray[np.bool_]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """For each column (i, k) the indices of the known column to take its values from: the nearest i of the same k, or
    of the nearest k where no column of the same k is known."""
    rows, columns = known.shape
    usable = np.flatnonzero(known.any(axis=0))
    k = usable[np.abs(np.arange(columns)[:, None] - usable).argmin(axis=1)]
    apart = np.abs(np.arange(rows)[:, None] - np.arange(rows))
    distance = np.where(known.T[k][:, None, :], apart, rows)  # (k, i, candidate i)
    return distance.argmin(axis=2).T, np.broadcast_to(k, known.shape)


def _interpolation_matrix(layout: Layout, along: Array) -> Array:
    """(samples, nodes): the weights with which the table interpolates at angles of its second axis."""
    warp, count = layout.warps[1], layout.shape[1]
    position = warp.coordinate(Angle(np.sin(along), np.cos(along))) * (count - 1)
    return np.asarray(np.maximum(1 - np.abs(position[:, None] - np.arange(count)), 0))


def _difference_penalty(count: int, stiffness: float) -> Array:
    differences = np.diff(np.eye(count), axis=0)
    return np.asarray(stiffness * differences.T @ differences)
