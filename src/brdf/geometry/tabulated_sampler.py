"""A sampler for any reflectance, tabulated from its values.

For a set of viewing directions ("nodes") the distribution of the half vector that follows f cos_i is stored as
a piecewise constant density; viewing directions between nodes choose one of the neighbours at random, and the
density is the exact blend. A share of the draws, chosen node by node, is cosine-weighted.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..threads import in_ranges
from .directions import dot, from_spherical, reflected

Floats = NDArray[np.floating[Any]]

THETA_O_LAST = np.radians(89.5)
"""Polar angle of the last node; closer to the horizon it stands in for all."""

COSINE_SHARES = (1 / 16, 2 / 16, 3 / 16, 5 / 16, 6 / 16, 8 / 16, 10 / 16, 12 / 16, 15 / 16)
"""Candidates for the share of cosine-weighted draws; never 0, so that no direction is left out. In sixteenths: of 16
well-spread numbers, as many choose them every time."""

SUBSAMPLES = 2
"""Values taken along each side of a cell."""

BLOCK = 1 << 14
"""Directions a thread takes at a time."""


class _Grid(NamedTuple):
    """Sizes of the table."""

    theta_o: int
    phi_o: int
    theta_h: int
    phi_h: int


ISOTROPIC = _Grid(16, 1, 64, 32)
ANISOTROPIC = _Grid(8, 16, 48, 32)


class _Table(NamedTuple):
    """The distributions; n nodes, t rings of the polar angle of h, p sectors of its azimuth."""

    shares: NDArray[np.float64]
    """(n,) share of cosine-weighted draws"""
    rings: NDArray[np.float64]
    """(n * t,) cumulative probability of the node's rings"""
    sectors: NDArray[np.float64]
    """(n * t * p,) cumulative probability of the ring's sectors"""
    density: NDArray[np.float64]
    """(n * t * p,) density of h times (1 - share) / 4 [1/sr]"""


class TabulatedSampler:
    """Follows f cos_i of any reflectance that does not transmit; built on first use.

    `reflectance`: called with (N, 3) directions wi, wo, gives (N, 3) values >= 0; `isotropic`: whether it stays
    when both directions turn together. The rings are evenly spaced in u = (1 - cos theta_h)^(1/6), which resolves
    lobes of width 0.002 as well as diffuse ones. The azimuth of h counts from the viewer's when the reflectance is
    isotropic, from the tangent when it is not.
    """

    def __init__(self, reflectance: Callable[[Floats, Floats], Floats], isotropic: bool) -> None:
        self._reflectance = reflectance
        self._isotropic = isotropic
        self._grid = ISOTROPIC if isotropic else ANISOTROPIC
        self._made: _Table | None = None

    @property
    def _table(self) -> _Table:
        if self._made is None:
            self._made = _tabulated(self._reflectance, self._grid)
        return self._made

    def sample(self, wo: Floats, u: Floats) -> tuple[Floats, NDArray[np.bool_]]:
        """As `Sampler.sample`."""
        from . import tabulated_kernels as kernels

        table, wi, u = self._table, np.empty(wo.shape, wo.dtype), u.astype(np.float64, copy=False)
        draw = kernels.compiled(kernels.sample, wo.dtype.name)
        tables = (table.shares, table.rings, table.sectors, tuple(self._grid), THETA_O_LAST, self._isotropic)
        in_ranges(lambda start, stop: draw(start, stop, wo, u, *tables, wi), len(wo), BLOCK)
        return wi, np.zeros(len(wo), bool)

    def pdf(self, wi: Floats, wo: Floats) -> Floats:
        """As `Sampler.pdf`."""
        from . import tabulated_kernels as kernels

        table, pdf = self._table, np.empty(len(wi), wi.dtype)
        fill = kernels.compiled(kernels.density, wi.dtype.name)
        tables = (table.shares, table.density, tuple(self._grid), THETA_O_LAST, self._isotropic)
        in_ranges(lambda start, stop: fill(start, stop, wi, wo, *tables, pdf), len(wi), BLOCK)
        return pdf


def _ring_edge(index: NDArray[np.intp], grid: _Grid) -> NDArray[np.float64]:
    """1 - cos theta_h at an edge between rings."""
    squared = np.square(index / grid.theta_h)
    edge: NDArray[np.float64] = squared * squared * squared
    return edge


def _ring_edges(grid: _Grid) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The inner and the outer edge of every ring, (t,) each."""
    rings = np.arange(grid.theta_h)
    return _ring_edge(rings, grid), _ring_edge(rings + 1, grid)


def _tabulated(reflectance: Callable[[Floats, Floats], Floats], grid: _Grid) -> _Table:
    """Evaluate the reflectance node by node."""
    made = [_node(reflectance, wo, grid) for wo in _node_directions(grid)]
    shares = np.array([share for share, _ in made])
    mass = np.array([cells for _, cells in made])
    rings = mass.sum(2)
    per_ring = rings[..., None]
    sectors = np.divide(mass, per_ring, out=np.full_like(mass, 1 / grid.phi_h), where=per_ring > 0)
    inner, outer = _ring_edges(grid)
    solid_angle = (outer - inner) * (2 * np.pi / grid.phi_h)
    density = mass / solid_angle[:, None] * ((1 - shares) / 4)[:, None, None]
    return _Table(shares, _cumulative(rings), _cumulative(sectors), density.ravel())


def _cumulative(probabilities: NDArray[np.float64]) -> NDArray[np.float64]:
    """Cumulative probabilities along the last axis, flat."""
    sums: NDArray[np.float64] = np.minimum(np.cumsum(probabilities, axis=-1), 1)
    return sums.ravel()


def _node_directions(grid: _Grid) -> NDArray[np.float64]:
    theta = np.linspace(0, THETA_O_LAST, grid.theta_o)
    phi = np.arange(grid.phi_o) * (2 * np.pi / grid.phi_o)
    return from_spherical(theta[:, None], phi).reshape(-1, 3).astype(np.float64)


def _node(
    reflectance: Callable[[Floats, Floats], Floats], wo: NDArray[np.float64], grid: _Grid
) -> tuple[float, NDArray[np.float64]]:
    """Share of cosine-weighted draws and probabilities (t, p) of the cells of h for one viewing direction."""
    s = SUBSAMPLES
    inner, outer = (edge[:, None] for edge in _ring_edges(grid))
    t = (inner + (np.arange(s) + 0.5) / s * (outer - inner)).ravel()
    phi = (np.arange(grid.phi_h * s) + 0.5) * (2 * np.pi / (grid.phi_h * s))
    radius = np.sqrt(t * (2 - t))[:, None]
    h = np.stack(np.broadcast_arrays(radius * np.cos(phi), radius * np.sin(phi), 1 - t[:, None]), axis=-1)
    viewer = np.broadcast_to(wo, h.shape)
    wi = reflected(viewer, h)
    cosine = wi[..., 2]
    above = (cosine > 0) & (dot(viewer, h) > 0)
    value = np.zeros(above.shape)
    value[above] = reflectance(wi[above], viewer[above]).mean(-1) * cosine[above]
    jacobian = np.where(above, 4 * dot(viewer, h), 0)
    solid_angle = np.repeat((outer - inner).ravel(), s)[:, None] * (2 * np.pi / grid.phi_h / s**2)
    return _shared(np.nan_to_num(value, posinf=0), jacobian, cosine, solid_angle, grid)


def _shared(
    value: Floats, jacobian: Floats, cosine: Floats, solid_angle: Floats, grid: _Grid
) -> tuple[float, NDArray[np.float64]]:
    """The cells' probabilities, and the share of cosine-weighted draws that gives the least variance."""
    s = SUBSAMPLES
    mass = (value * jacobian * solid_angle).reshape(grid.theta_h, s, grid.phi_h, s).sum((1, 3))
    total = mass.sum()
    if not 0 < total < np.inf:
        return 1.0, np.full_like(mass, 1 / mass.size)
    probability = mass / total
    cell = solid_angle[::s] * s**2
    lobe = np.kron(probability / cell, np.ones((s, s)))
    per_light = np.divide(lobe, jacobian, out=np.zeros_like(lobe), where=jacobian > 0)
    squared = value**2 * jacobian * solid_angle
    moments = []
    for share in COSINE_SHARES:
        density = share * np.maximum(cosine, 0) / np.pi + (1 - share) * per_light
        moments.append(np.divide(squared, density, out=np.zeros_like(squared), where=value > 0).sum())
    return COSINE_SHARES[int(np.argmin(moments))], probability
