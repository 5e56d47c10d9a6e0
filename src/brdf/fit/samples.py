"""What a model is fitted to: values at pairs of directions, each with a weight."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..color import rgb_weights
from ..errors import ParameterError, ReflectanceError
from ..formula.engine import check_lengths
from ..geometry.directions import pairs_from_spherical
from ..metrics import direction_pairs
from ..reflectance import Reflectance
from ..representations.tables.merl import LAYOUT
from ..representations.tables.table import Table

Array = NDArray[np.floating[Any]]

GRAZING = 80.0
"""Degrees from the normal beyond which values are left out: measurements are least reliable there (Ngan2005)."""


@dataclass(frozen=True, eq=False)
class Samples:
    """Values [1/sr] at pairs of directions; invalid ones are not among them."""

    wi: Array
    """(N, 3)"""
    wo: Array
    """(N, 3)"""
    values: Array
    """(N, 3) f without the cosine [1/sr]"""
    weight: Array
    """(N, 3) of squared residuals, with mean 1"""
    name: str = ""
    source: str = ""
    grazing: float = 90.0
    """Degrees from the normal beyond which nothing is fitted."""
    left_out: int = 0
    """Pairs that were given and are not used: invalid, or beyond the grazing angle."""

    def __len__(self) -> int:
        return len(self.wi)

    @classmethod
    def of(
        cls, wi: ArrayLike, wo: ArrayLike, values: ArrayLike, weight: ArrayLike = 1.0, grazing: float = GRAZING,
        name: str = "", source: str = "",
    ) -> Samples:  # fmt: skip
        """From unit directions (N, 3), values (N, 3) or (N,) in 1/sr and weights that broadcast to them.

        Rows with a value that is no number or below zero, without weight, or with a direction beyond `grazing` degrees
        are left out. Raises DirectionError, ParameterError for shapes that do not fit or when nothing is left.
        """
        require_grazing(grazing)
        wi, wo, values, weight = (_numbers(a) for a in (wi, wo, values, weight))
        if values.ndim == 1:
            values = np.repeat(values[:, None], 3, 1)
        if wi.ndim != 2 or wi.shape[1:] != (3,) or wo.shape != wi.shape or values.shape != wi.shape:
            raise ParameterError(
                f"samples need directions and values of shape (N, 3), got {wi.shape}, {wo.shape}, {values.shape}"
            )
        check_lengths(wi=wi, wo=wo)
        if weight.ndim == 1:
            weight = weight[:, None]
        if weight.ndim > 2 or any(n not in (1, m) for n, m in zip(weight.shape, values.shape, strict=False)):
            raise ParameterError(f"weights {weight.shape} do not fit values {values.shape}")
        given = np.broadcast_to(weight, values.shape)
        least = max(math.cos(math.radians(grazing)), 1e-6)
        with np.errstate(invalid="ignore"):
            good = (values >= 0).all(1) & np.isfinite(values).all(1) & (given >= 0).all(1) & (given.sum(1) > 0)
        good &= (wi[:, 2] >= least) & (wo[:, 2] >= least)
        if not good.any():
            raise ParameterError(f"{name or 'the data'} holds no valid value within {grazing:g} degrees of the normal")
        chosen = given[good]
        return cls(
            wi[good].astype(np.float32), wo[good].astype(np.float32), values[good], chosen / chosen.mean(), name,
            source, grazing, int(np.count_nonzero(~good)),
        )  # fmt: skip

    @property
    def is_monochrome(self) -> bool:
        """Whether the channels are copies of each other, but for rounding: one measurement, not three."""
        return bool(np.allclose(self.values, self.values[:, :1], 1e-6, 0))

    def __getitem__(self, rows: Any) -> Samples:
        """Some of them."""
        return replace(self, wi=self.wi[rows], wo=self.wo[rows], values=self.values[rows], weight=self.weight[rows])

    def reweighted(self, weight: Array) -> Samples:
        """The same with other weights (N, 3)."""
        return replace(self, weight=weight)


def require_grazing(angle: float) -> None:
    """Raises ParameterError."""
    if not isinstance(angle, (int, float, np.floating)) or not 0 < angle <= 90:
        raise ParameterError(f"the grazing angle must lie in (0, 90] degrees, got {angle!r}")


def samples_of(data: Any, grazing: float = GRAZING) -> Samples:
    """The samples that stand for some data.

    A table of MERL's layout gives its measured bins, weighted by the solid angles that they stand for; any other
    reflectance is evaluated at `metrics.direction_pairs`, without those where it holds no measurement; `Samples` stay
    what they are. Raises ParameterError, ReflectanceError.
    """
    if isinstance(data, Samples):
        return data
    if not isinstance(data, Reflectance):
        raise ParameterError(f"a fit needs a reflectance or Samples, got {type(data).__name__}")
    if data.transmits:
        raise ReflectanceError(f"{data.name or type(data).__name__} transmits; fits are of what is reflected")
    if isinstance(data, Table) and data.layout == LAYOUT:
        return _bins(data, grazing)
    wi, wo, weight = direction_pairs(polar=64, difference=32, azimuth=48)
    values = data.raw(wi, wo)
    if isinstance(data, Table) and data.has_holes:
        values = np.where(data.valid(wi, wo)[:, None], values, np.nan)
    return Samples.of(wi, wo, values, weight, grazing, data.name, data.source)


def _bins(table: Table, grazing: float) -> Samples:
    """The measured bins of a MERL table; a bin's weight is the measure d wi d wo of the cell around its node."""
    grid = _grid()
    chosen = np.flatnonzero(table.measured[:, :, :-1].ravel() & (grid.least >= math.cos(math.radians(grazing))))
    values = table.codes[:, :, :-1].reshape(-1, 3)[chosen]
    made = Samples.of(grid.wi[chosen], grid.wo[chosen], values, grid.weight[chosen], 90.0, table.name, table.source)
    return replace(made, grazing=grazing, left_out=len(grid.least) - len(made))


class _Grid(NamedTuple):
    """All bins of a MERL table in their order; those below the horizon have directions, too."""

    wi: Array
    wo: Array
    least: Array
    """(N,) the smaller cosine of the two directions"""
    weight: Array


@functools.lru_cache(maxsize=1)
def _grid() -> _Grid:
    theta_h, theta_d, phi_d = (axis.ravel() for axis in LAYOUT.nodes())
    phi_d = phi_d[:-1]
    shape = (len(theta_h), len(theta_d), len(phi_d))
    wi, wo = np.empty((2, *shape, 3), np.float32)
    for i, theta in enumerate(theta_h):  # a slice at a time bounds the memory
        wi[i], wo[i] = LAYOUT.basis.directions(np.asarray(theta), theta_d[:, None], phi_d[None, :])
    # d wi d wo = 4 cos(theta_d) d omega_h d omega_d
    weight = _cells(theta_h)[:, None, None] * (_cells(theta_d) * np.cos(theta_d))[:, None]
    least = np.minimum(wi[..., 2], wo[..., 2]).ravel()
    weights = np.broadcast_to(weight, shape).astype(np.float32).ravel()
    return _Grid(wi.reshape(-1, 3), wo.reshape(-1, 3), least, weights)


def _edges(nodes: Array) -> Array:
    """Midpoints between nodes, with the first and the last node at the ends."""
    return np.concatenate([nodes[:1], (nodes[1:] + nodes[:-1]) / 2, nodes[-1:]])


def _cells(theta: Array) -> Array:
    """Share of the sphere of each cell around nodes of a polar angle."""
    return -np.diff(np.cos(_edges(theta)))


def from_rows(angles: Array, spectra: Array, wavelengths: Array, grazing: float, name: str, source: str) -> Samples:
    """From the rows of a goniometer: angles (N, 4) in radians and spectra (N, W) in 1/sr; each row counts the same."""
    values = np.maximum(spectra @ rgb_weights(wavelengths), 0)  # of measured colours outside the gamut
    values[~(spectra >= 0).all(1)] = np.nan
    return Samples.of(*pairs_from_spherical(angles), values, 1.0, grazing, name, source)


def _numbers(given: ArrayLike) -> Array:
    """In single precision at least. Raises ParameterError."""
    array = np.asarray(given)
    if array.dtype.kind not in "fiub":
        raise ParameterError(f"samples are numbers, got {array.dtype}")
    return np.asarray(array, np.result_type(array, np.float32))
