"""A sampler for any reflectance, tabulated from its values.

For a set of viewing directions ("nodes") the distribution of the half vector that follows f cos_i is stored as
a piecewise constant density; viewing directions between nodes choose one of the neighbours at random, and the
density is the exact blend. A share of the draws, chosen node by node, is cosine-weighted.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..threads import in_ranges
from .directions import cosine_weighted, dot, from_spherical, reflected

Floats = NDArray[np.floating[Any]]

THETA_O_LAST = np.radians(89.5)
"""Polar angle of the last node; closer to the horizon it stands in for all."""

COSINE_SHARES = (0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.75, 0.95)
"""Candidates for the share of cosine-weighted draws; never 0, so that no direction is left out."""

SUBSAMPLES = 2
"""Values taken along each side of a cell."""

BLOCK = 1 << 14
"""Directions a thread works on at once, so that the intermediate arrays stay in the processor's cache."""


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
    """(n * t,) node index + cumulative probability of the rings"""
    sectors: NDArray[np.float64]
    """(n * t * p,) ring index + cumulative probability of its sectors"""
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
        table, wi = self._table, np.empty_like(wo)

        def draw(start: int, stop: int) -> None:
            wi[start:stop] = self._sample(table, wo[start:stop], u[start:stop].astype(np.float64))

        in_ranges(draw, len(wo), BLOCK)
        return wi, np.zeros(len(wo), bool)

    def _sample(self, table: _Table, wo: Floats, u: Floats) -> Floats:
        grid, first, second = self._grid, u[:, 0], u[:, 1]
        node = np.zeros(len(wo), np.intp)
        for lower, upper, weight, stride in self._neighbours(wo):
            up, first = _choice(first, weight)
            node += np.where(up, upper, lower) * stride
        diffuse, first = _choice(first, table.shares[node])

        ring, along = _inverted(table.rings, node, first, grid.theta_h)
        sector, around = _inverted(table.sectors, ring, second, grid.phi_h)
        inner, outer = _ring_edge(ring % grid.theta_h, grid), _ring_edge(ring % grid.theta_h + 1, grid)
        t = inner + along * (outer - inner)
        phi = (sector % grid.phi_h + around) * (2 * np.pi / grid.phi_h)
        radius, cosine, sine = np.sqrt(t * (2 - t)), np.cos(phi), np.sin(phi)
        if self._isotropic:
            cos_o, sin_o = _azimuth(wo)
            cosine, sine = cosine * cos_o - sine * sin_o, sine * cos_o + cosine * sin_o
        h = np.stack([radius * cosine, radius * sine, 1 - t], axis=-1).astype(wo.dtype, copy=False)
        wi = reflected(wo, h)
        wi[diffuse] = cosine_weighted(np.stack([first[diffuse], second[diffuse]], axis=-1))
        return wi

    def pdf(self, wi: Floats, wo: Floats) -> Floats:
        """As `Sampler.pdf`."""
        table, density = self._table, np.empty(len(wi), wi.dtype)

        def fill(start: int, stop: int) -> None:
            density[start:stop] = self._pdf(table, wi[start:stop], wo[start:stop])

        in_ranges(fill, len(wi), BLOCK)
        return density

    def _pdf(self, table: _Table, wi: Floats, wo: Floats) -> Floats:
        grid = self._grid
        h = wi + wo
        length = np.sqrt(dot(h, h))
        usable = (wi[:, 2] > 0) & (wo[:, 2] > 0) & (length > 0)
        safe = np.where(usable, length, 1)
        x, y, z = h[:, 0] / safe, h[:, 1] / safe, np.where(usable, h[:, 2] / safe, 1)
        t = ((x * x + y * y) / (1 + z)).clip(0, 1)
        ring = (np.cbrt(np.sqrt(t)) * grid.theta_h).astype(np.intp).clip(0, grid.theta_h - 1)
        if self._isotropic:
            cos_o, sin_o = _azimuth(wo)
            x, y = x * cos_o + y * sin_o, y * cos_o - x * sin_o
        sector = (np.arctan2(y, x) * (grid.phi_h / (2 * np.pi))).astype(np.float64)
        cell = ring * grid.phi_h + np.floor(sector).astype(np.intp) % grid.phi_h

        nodes = [(np.zeros(len(wi), np.intp), np.ones(len(wi)))]
        for lower, upper, weight, stride in self._neighbours(wo):
            ends = ((lower, 1 - weight), (upper, weight))
            nodes = [(n + end * stride, w * blend) for n, w in nodes for end, blend in ends]
        cells = grid.theta_h * grid.phi_h
        share = sum(w * table.shares[n] for n, w in nodes)
        lobe = sum(w * table.density[n * cells + cell] for n, w in nodes)
        # a half vector's solid angle is that of wi over 4 wo.h, and wo.h is half the length of wi + wo
        return np.where(usable, share * wi[:, 2] / np.pi + lobe / (safe / 2), 0)

    def _neighbours(self, wo: Floats) -> Iterator[tuple[Any, Any, Floats, int]]:
        """Per axis of the nodes: lower and upper index, weight of the upper one, stride of the axis."""
        grid = self._grid
        theta = np.arccos(wo[:, 2].astype(np.float64).clip(-1, 1))
        position = np.minimum(theta / THETA_O_LAST, 1) * (grid.theta_o - 1)
        lower = np.minimum(position.astype(np.intp), grid.theta_o - 2)
        yield lower, lower + 1, position - lower, grid.phi_o
        if grid.phi_o > 1:
            position = np.arctan2(wo[:, 1], wo[:, 0]).astype(np.float64) * (grid.phi_o / (2 * np.pi))
            lower = np.floor(position).astype(np.intp)
            yield lower % grid.phi_o, (lower + 1) % grid.phi_o, position - lower, 1


def _choice(u: Floats, share: Floats) -> tuple[NDArray[np.bool_], Floats]:
    """What happens with probability `share` (N,), decided by `u` (N,) in [0, 1), and the uniform numbers left over."""
    happens = u < share
    left = (u - np.where(happens, 0, share)) / np.where(happens, share, 1 - share)
    return happens, left.clip(0, np.nextafter(1, 0))


def _azimuth(w: Floats) -> tuple[Floats, Floats]:
    """Cosine and sine of the azimuth; 1 and 0 along the normal."""
    radius = np.hypot(w[:, 0], w[:, 1])
    off_axis = radius > 0
    safe = np.where(off_axis, radius, 1)
    return np.where(off_axis, w[:, 0] / safe, 1), np.where(off_axis, w[:, 1] / safe, 0)


def _ring_edge(index: NDArray[np.intp], grid: _Grid) -> NDArray[np.float64]:
    """1 - cos theta_h at an edge between rings."""
    squared = np.square(index / grid.theta_h)
    edge: NDArray[np.float64] = squared * squared * squared
    return edge


def _ring_edges(grid: _Grid) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The inner and the outer edge of every ring, (t,) each."""
    rings = np.arange(grid.theta_h)
    return _ring_edge(rings, grid), _ring_edge(rings + 1, grid)


def _inverted(cumulative: NDArray[np.float64], row: Any, u: Any, size: int) -> tuple[Any, NDArray[np.float64]]:
    """The entry that `u` falls into within a row of cumulative probabilities, and where in it, in [0, 1].

    Entry e of row r holds r + (probability of the row's entries up to and with e): the whole array is sorted.
    """
    key = row + u
    entry = np.searchsorted(cumulative, key, side="right")
    entry = np.clip(entry, row * size, row * size + size - 1)
    below = np.where(entry % size == 0, row, cumulative[entry - 1])
    width = cumulative[entry] - below
    return entry, np.clip(np.divide(key - below, width, out=np.full_like(key, 0.5), where=width > 0), 0, 1)


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
    return _Table(shares, _keys(rings), _keys(sectors), density.ravel())


def _keys(probabilities: NDArray[np.float64]) -> NDArray[np.float64]:
    """Cumulative probabilities along the last axis plus the index of the row, flat and sorted."""
    rows = probabilities.reshape(-1, probabilities.shape[-1])
    cumulative = np.minimum(np.cumsum(rows, axis=-1), 1)
    keys: NDArray[np.float64] = cumulative + np.arange(float(len(rows)))[:, None]
    return keys.ravel()


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
