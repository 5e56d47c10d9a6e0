"""Layouts made for one reflectance: along every axis nodes where the interpolation error is, and as many as it earns.

Each axis has a monotone spline warp. A few times over: the error that linear interpolation along one axis alone makes
is measured at importance pairs, by evaluating the reflectance at the two nodes on either side. Nodes move to where it
is large; axes with larger errors get more of them.

With E the error energy between two knots and n the density of nodes there, E n^4 is the squared second derivative,
and the density that minimises the sum of the errors is proportional to (E n^4)^(1/5).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...formula import Vec
from ...geometry.warps import Angle, FarPower, Spline, Warp, square_root, uniform
from ...metrics.importance import ErrorsAgainst, display_value
from ...reflectance import Reflectance
from ..tables.bases import Basis, HalfBasis, NormalBasis, cos_difference_of
from ..tables.encoding import Encoding
from ..tables.layout import Layout
from ..tables.triangle_bases import ShearedBasis
from .bake import HORIZON_MARGIN

Array = NDArray[np.floating[Any]]

KNOTS = 20
"""Weights of each spline: a compromise between how sharply nodes can crowd and what a lookup costs."""

ROUNDS = 5

EVEN_SHARE = 0.15
"""Share of the nodes that are spread evenly over the base warp, whatever the error."""

LEAST_NODES = 4
"""Along each axis."""

STARTS: dict[str, tuple[Basis, tuple[Warp, ...], tuple[float, ...]]] = {
    "half": (HalfBasis("quarter-turn"), (square_root(), uniform(), uniform()), (2, 2, 0.5)),
    "sheared": (ShearedBasis(), (square_root(), uniform(), FarPower(math.pi, 2.0)), (1, 1, 2)),
    "normal": (NormalBasis(), (uniform(), uniform(), FarPower(math.pi, 2.0)), (1, 1, 2)),
    "irreciprocal": (HalfBasis("mirror"), (square_root(), uniform(), uniform(math.pi)), (2, 2, 1)),
}
"""Basis, base warps and proportions of the nodes from which the rounds start. The last is a half basis for
measurements that change when the directions are exchanged."""


@dataclass(frozen=True)
class Adapted:
    """A layout and how many nodes it may have."""

    layout: Layout
    proportions: tuple[float, ...]
    """Of the numbers of nodes along the axes."""

    def sized(self, entries: int, **changes: Any) -> Layout:
        """The layout at another number of nodes, with other fields (encoding, storage, filter)."""
        return replace(self.layout, shape=shape_of(self.proportions, entries), **changes)


def shape_of(proportions: tuple[float, ...], entries: int) -> tuple[int, ...]:
    """Whole numbers of nodes, each at least `LEAST_NODES`, whose product comes close to `entries` from below."""
    scale = (entries / math.prod(proportions)) ** (1 / len(proportions))
    ideal = [scale * p for p in proportions]
    order = np.argsort(ideal)
    shape, rest = [0] * len(ideal), float(entries)
    for place, axis in enumerate(order):  # short axes first: what rounding costs there the longer ones make up
        others = order[place + 1 :]
        wanted = (rest / math.prod(ideal[k] for k in others) / ideal[axis]) ** (1 / (len(others) + 1)) * ideal[axis]
        shape[axis] = max(LEAST_NODES, int(wanted) if not len(others) else round(wanted))
        rest /= shape[axis]
    return tuple(shape)


def adapt(
    m: Reflectance,
    against: ErrorsAgainst,
    entries: int,
    basis: str,
    encoding: Encoding,
    error_of: Callable[[Layout], float] | None = None,
    rounds: int = ROUNDS,
) -> Adapted:
    """A layout of about `entries` nodes adapted to `m`, whose errors are measured at the pairs of `against`.

    `basis` is a key of `STARTS`. Of all rounds the layout of the least `error_of` is kept, else the last one.
    """
    chosen, bases, proportions = STARTS[basis]
    measured = _AxisErrors(m, against, chosen, encoding)
    densities: list[Array] = [np.ones(KNOTS) for _ in bases]
    best, least = None, math.inf
    for turn in range(rounds + 1):
        warps = tuple(Spline(b.extent, b, tuple(map(float, d))) for b, d in zip(bases, densities, strict=True))
        layout = Layout(chosen, warps, shape_of(proportions, entries), encoding)
        error = error_of(layout) if error_of else -turn
        if error < least:
            best, least = Adapted(layout, proportions), error
        if turn == rounds:
            break
        energies = measured(layout, bases)
        if basis == "normal":  # light and viewer alike
            energies[0] = energies[1] = (energies[0] + energies[1]) / 2
        densities = [_equidistributed(d, e) for d, e in zip(densities, energies, strict=True)]
        earned = [n * max(e.sum(), 1e-30) ** 0.25 for n, e in zip(layout.shape, energies, strict=True)]
        proportions = tuple(_bounded(earned, entries))
    assert best is not None
    return best


def _equidistributed(density: Array, energy: Array) -> Array:
    """Better weights of a spline, of mean 1."""
    wanted = (energy * density**4) ** 0.2
    wanted = np.convolve(np.pad(wanted, 1, mode="edge"), (0.25, 0.5, 0.25), "valid")
    mean = wanted.mean()
    return density if mean <= 0 else (1 - EVEN_SHARE) * wanted / mean + EVEN_SHARE


def _bounded(earned: list[float], entries: int) -> list[float]:
    """Numbers of nodes of that product, none below the least; the product is right before the bounds count."""
    scale = (entries / math.prod(earned)) ** (1 / len(earned))
    return [max(scale * n, LEAST_NODES) for n in earned]


class _AxisErrors:
    """The error energy of linear interpolation along each axis by itself."""

    def __init__(self, m: Reflectance, against: ErrorsAgainst, basis: Basis, encoding: Encoding) -> None:
        wi, wo, weight = against.pairs
        self._m, self._basis, self._encoding = m, basis, encoding
        self._cosine = wi[:, 2]
        self._cos_d = cos_difference_of(wi, wo)
        angles = basis.angles(Vec(*wi.T), Vec(*wo.T))
        self._sines = [Angle(np.asarray(a.sine), np.asarray(a.cosine)) for a in angles]
        self._angles = [np.arctan2(a.sine, a.cosine) for a in angles]
        self._display = display_value(against.f_cos)
        self._exact = against.f_cos
        totals = [np.einsum("n,nc->", weight, np.square(v)) for v in (self._exact, self._display)]
        self._linear, self._shown = (weight / max(float(t), 1e-30) for t in totals)

    def __call__(self, layout: Layout, bases: tuple[Warp, ...]) -> list[Array]:
        """For each axis (KNOTS,) energies, each shared by the two knots of the base warp on its sides."""
        ends, shares = [], []
        for axis, (angle, warp, count) in enumerate(zip(self._sines, layout.warps, layout.shape, strict=True)):
            position = np.clip(np.asarray(warp.coordinate(angle)) * (count - 1), 0, count - 1)
            below = np.minimum(position.astype(np.intp), count - 2)
            nodes = warp.nodes(count)
            shares.append((position - below)[:, None])
            for end in (below, below + 1):
                moved = list(self._angles)
                moved[axis] = nodes[end]
                ends.append(self._basis.above_horizon(*moved, margin=HORIZON_MARGIN))
        stored = self._stored([np.concatenate(parts) for parts in zip(*ends, strict=True)])
        energies: list[Array] = []
        for angle, base, low, high, share in zip(self._sines, bases, stored[::2], stored[1::2], shares, strict=True):
            energy = self._energy(low + share * (high - low))
            place = np.asarray(base.coordinate(angle)) * (KNOTS - 1)
            below = np.clip(place.astype(np.intp), 0, KNOTS - 2)
            right = np.clip(place - below, 0, 1)
            left = np.bincount(below, energy * (1 - right), KNOTS)
            energies.append(np.asarray(left + np.bincount(below + 1, energy * right, KNOTS), np.float64))
        return energies

    def _stored(self, angles: list[Array]) -> list[Array]:
        """The encoded values at angles, cut into arrays of one value a pair."""
        wi, wo = self._basis.directions(*angles)
        f = np.asarray(self._m(wi.astype(np.float32), wo.astype(np.float32)), np.float64)
        encoded = self._encoding.encode(f, cos_difference_of(wi, wo), np.zeros(3))
        return np.split(encoded, len(encoded) // len(self._cosine))

    def _energy(self, stored: Array) -> Array:
        encoding = self._encoding
        g = encoding.transform.value(stored) / encoding.grazing_factor(self._cos_d)[:, None]
        f_cos = np.maximum(g / encoding.scale, 0) * self._cosine[:, None]
        linear = np.square(f_cos - self._exact).sum(-1)
        shown = np.square(display_value(f_cos) - self._display).sum(-1)
        return np.asarray(self._linear * linear + self._shown * shown)
