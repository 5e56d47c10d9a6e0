"""Reflectance -> table by projection: the table nearest to it everywhere between the nodes, not at the nodes alone.

Least squares over the cells of the grid, in the values the table interpolates: with the hat functions H of the nodes
at samples inside the cells and V the values there, the nodes are (H^T H)^-1 H^T V along each axis in turn. What a table
can hold it comes back as; and since the hats add up to 1, the sum over the samples is kept: where a table shrinks, what
falls between its nodes is not lost, as it would be by reading it there.
"""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError, ReflectanceError
from ...reflectance import Reflectance
from ..tables.bases import cos_difference_of
from ..tables.layout import Layout
from ..tables.table import Table
from .bake import HORIZON_MARGIN, require_isotropic, require_values

Array = NDArray[np.floating[Any]]

SAMPLES = 2
"""Samples in each cell of each axis; twice as many as make the nodes determinate."""

MOST_SAMPLES = 16


def bake_projection(m: Reflectance, layout: Layout, samples: int | None = None) -> Table:
    """The table of `layout` nearest to `m` in the values it interpolates.

    `samples` inside each cell, along each axis: by default 2, or of a table of the same basis as many as see all its
    nodes. Directions below the horizon count as the last ones above it. Raises ReflectanceError as `bake_points`,
    ParameterError for fewer than 2 samples.
    """
    require_isotropic(m) if layout.basis.isotropic else require_values(m)
    if samples is not None and not SAMPLES <= samples <= MOST_SAMPLES:
        raise ParameterError(f"samples must lie between {SAMPLES} and {MOST_SAMPLES}, got {samples}")
    counts = [samples or needed for needed in _samples(m, layout)]
    axes = [_Axis(*axis) for axis in zip(layout.shape, (w.periodic for w in layout.warps), counts, strict=True)]
    angles = [warp.angle(axis.coordinates) for warp, axis in zip(layout.warps, axes, strict=True)]
    *leading, second, third = axes
    total: Array = np.zeros((*layout.shape, 3))
    for place in itertools.product(*(range(len(axis.coordinates)) for axis in leading)):
        first = [angle[index].reshape(1, 1) for angle, index in zip(angles, place, strict=False)]
        values = _stored(m, layout, (*first, angles[-2][:, None], angles[-1][None, :]))
        plane = np.einsum("as,stc->atc", second.projector, values, optimize=True)
        plane = np.einsum("bt,atc->abc", third.projector, plane, optimize=True)
        for near in itertools.product(*(axis.hats_at(i) for axis, i in zip(leading, place, strict=True))):
            total[tuple(index for index, _ in near)] += math.prod(share for _, share in near) * plane
    for number, axis in enumerate(leading):
        first_last = np.moveaxis(total, number, -1)[..., None]
        total = np.moveaxis(np.linalg.solve(axis.hats.T @ axis.hats, first_last)[..., 0], -1, number)
    return Table.encoded(layout, total).named(m.name, f"{m.source or m.name}, baked by projection")


class _Axis:
    """The samples of one axis and the hats of its nodes there."""

    def __init__(self, count: int, periodic: bool, samples: int) -> None:
        self.count = count
        cells = count if periodic else count - 1
        position = (np.arange(cells * samples) + 0.5) / samples
        self.coordinates = position / cells
        below = position.astype(int)
        self.hats = np.zeros((len(position), count))
        rows = np.arange(len(position))
        self.hats[rows, below] = 1 - (position - below)
        self.hats[rows, (below + 1) % count] = position - below

    @property
    def projector(self) -> Array:
        """(count, samples): values at the samples -> nodes."""
        return np.asarray(np.linalg.solve(self.hats.T @ self.hats, self.hats.T))

    def hats_at(self, sample: int) -> list[tuple[int, float]]:
        """The nodes with a share in a sample."""
        return [(int(node), float(self.hats[sample, node])) for node in np.flatnonzero(self.hats[sample])]


def _samples(m: Reflectance, layout: Layout) -> list[int]:
    if not isinstance(m, Table) or m.layout.basis != layout.basis:
        return [SAMPLES] * len(layout.shape)
    ratios = (math.ceil(2 * n / own) for n, own in zip(m.layout.shape, layout.shape, strict=True))
    return [min(max(ratio, SAMPLES), MOST_SAMPLES) for ratio in ratios]


def _stored(m: Reflectance, layout: Layout, angles: tuple[Array, ...]) -> Array:
    basis = layout.basis
    wi, wo = basis.directions(*basis.above_horizon(*angles, margin=HORIZON_MARGIN))
    values = m(wi, wo)
    if not np.isfinite(values).all():
        raise ReflectanceError(
            f"{m.name or type(m).__name__} is NaN or infinite between the nodes; mask or fill it first"
        )
    return layout.encoding.encode(values, cos_difference_of(wi, wo), np.zeros(3))
