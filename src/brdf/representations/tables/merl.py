"""MERL's layout as a table: 90 x 90 x 180 bins over (theta_h, theta_d, phi_d), theta_h warped by a square root.

A bin's value belongs to its lower edges, theta_h = (i / 90)^2 90 degrees, theta_d = j degrees, phi_d = k degrees: they
are the table's nodes, between which it interpolates. phi_d has a period of 180 degrees; a copy of its first slice
closes the circle. Source: Matusik2003.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ReflectanceError
from ...geometry.warps import square_root, uniform
from ...reflectance import Reflectance
from ..baking.bake import require_isotropic
from .bases import HalfBasis
from .encoding import Encoding
from .layout import Layout
from .table import Table

BINS = (90, 90, 180)
"""Bins over theta_h, theta_d, phi_d."""

MISSING = -1.0
"""What `to_merl` gives for bins without a value."""

ROUNDING = 1e-12
"""Cosines up to this count as the horizon: rounding decides the sign of a bin that lies on it."""

LAYOUT = Layout(
    HalfBasis("half-turn"),
    (square_root((89 / 90) ** 2 * math.pi / 2), uniform(math.radians(89)), uniform(math.pi)),
    (90, 90, 181),
    Encoding(),
    "float32",
)


def from_merl(values: NDArray[np.floating[Any]], name: str = "", source: str = "") -> Table:
    """The table of MERL bins `values`, (90, 90, 180, 3) in 1/sr, a negative value or NaN in any channel marking a bin
    without a measurement (below the horizon, or a hole).

    Such bins are filled, so that interpolation beside them works: with the last measured bin of smaller theta_d, else
    the next of larger theta_d, else a neighbour along phi_d or theta_h. `Table.measured` and `Table.valid` tell them
    apart. Raises ReflectanceError for a wrong shape or a table without a single measured bin.
    """
    if values.shape != (*BINS, 3):
        raise ReflectanceError(f"{name or 'a MERL table'} must have shape {(*BINS, 3)}, got {values.shape}")
    padded = np.empty((*LAYOUT.shape, 3), np.float32)
    padded[:, :, :-1] = values
    measured = np.empty(LAYOUT.shape, np.bool_)
    known = values >= 0
    measured[:, :, :-1] = known[..., 0] & known[..., 1] & known[..., 2]
    measured[:, :, -1] = measured[:, :, 0]
    if not measured.any():
        raise ReflectanceError(f"{name or 'a MERL table'} holds no measured bin")
    _fill(padded[:, :, :-1], measured[:, :, :-1])
    padded[:, :, -1] = padded[:, :, 0]
    return Table(LAYOUT, padded, measured=measured).named(name, source)


def to_merl(m: Reflectance) -> NDArray[np.float32]:
    """MERL bins of any isotropic reflectance, (90, 90, 180, 3) float32 in 1/sr; -1 where a direction lies below the
    horizon or, in a table read from MERL bins, nothing was measured. Such a table gives its very bins back.

    Raises ReflectanceError when `m` is anisotropic.
    """
    require_isotropic(m)
    if isinstance(m, Table) and m.layout == LAYOUT:
        return np.where(m.measured[:, :, :-1, None], m.codes[:, :, :-1], np.float32(MISSING))
    values = np.empty((*BINS, 3), np.float32)
    theta_h, theta_d, phi_d = LAYOUT.nodes()
    for i in range(BINS[0]):  # a slice at a time: the whole grid's directions would take half a gigabyte
        wi, wo = LAYOUT.basis.directions(theta_h[i], theta_d[0], phi_d[0, :, :-1])
        above = (wi[..., 2] > ROUNDING) & (wo[..., 2] > ROUNDING)
        values[i] = np.where(above[..., None], m(wi, wo), MISSING)
    return values


def _fill(values: NDArray[np.float32], measured: NDArray[np.bool_]) -> None:
    """Give the bins without a measurement values from their neighbours, in place."""
    theta_d = np.arange(BINS[1], dtype=np.int16)[None, :, None]
    last = np.maximum.accumulate(np.where(measured, theta_d, np.int16(-1)), axis=1)
    empty_columns = last[:, -1] < 0
    i, j, k = np.nonzero(~measured)
    source = last[i, j, k]
    early = source < 0
    if early.any():
        source[early] = measured.argmax(axis=1)[i[early], k[early]]
    values[i, j, k] = values[i, source, k]
    if empty_columns.any():
        _fill_columns(values, empty_columns)


def _fill_columns(values: NDArray[np.float32], empty: NDArray[np.bool_]) -> None:
    """Copy whole columns over theta_d from the nearest one measured: along phi_d (a circle), else along theta_h."""
    rows = np.flatnonzero(~empty.all(axis=1))
    for i in rows:
        known = np.flatnonzero(~empty[i])
        for k in np.flatnonzero(empty[i]):
            distance = np.abs(known - k)
            values[i, :, k] = values[i, :, known[np.minimum(distance, BINS[2] - distance).argmin()]]
    for i in np.flatnonzero(empty.all(axis=1)):
        values[i] = values[rows[np.abs(rows - i).argmin()]]
