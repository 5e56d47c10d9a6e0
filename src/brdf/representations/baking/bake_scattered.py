"""Scattered samples -> table: the nodes whose linear interpolation fits values at any pairs of directions best.

Made for photographs and goniometers: samples lie where they lie, carry noise and a few gross errors, and leave most of
the table unseen. With q the stored values at the nodes and q0 those of a prior reflectance,

    minimise   sum_s w_s rho(decode(A q)_s - f_s)  +  smoothness |D (q - q0)|^2  +  pull |q - q0|^2

A: the weights with which the table interpolates (sparse, 8 a sample); D: second differences along each axis, first
differences at a hundredth of their weight, so that what is not seen continues what is; rho: Huber's loss. What the
samples say is thus a smooth departure from the prior; where they say nothing the table is the prior. Decoding is not
linear (logarithms are stored), so that Gauss-Newton steps are taken, each solved by conjugate gradients. The symmetries
that the basis folds (reciprocity, mirror symmetry) cost nothing: folded samples fall on one node. Reference: Huber1964.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import ParameterError, ReflectanceError
from ...formula.vec import Vec
from ...geometry.arguments import broadcast_directions
from ...reflectance import Reflectance
from ..tables.interpolation import reading
from ..tables.layout import Layout
from ..tables.table import Table
from .bake import HORIZON_MARGIN, LEAST_COSINE

Array = NDArray[np.floating[Any]]

SMOOTHNESS = 1e-3
"""Weight of squared second differences between nodes, when the samples' weights sum to the number of nodes."""
FIRST_DIFFERENCES = 0.01
"""Of first differences, as a share of that."""
PULL = 1e-3
"""Of the departure from the prior, as a share of `smoothness`."""
ITERATIONS = 6
CONVERGED = 5e-3
"""Stored units: less than the 10 bits of a slice stack tell apart."""
LARGEST_STEP = 1.0
"""In stored units: a Gauss-Newton step up an exponential overshoots."""
HUBER = 3.0
"""Residuals of more than so many typical ones (1.4826 medians of their size) count linearly."""
MERGED = 4
"""Samples in the same of so many parts of the space between two nodes, along each axis, become their weighted mean."""
_DIFFERENCE = 1e-4
"""Stored units, for the derivative of decoding."""


def bake_scattered(
    wi: ArrayLike,
    wo: ArrayLike,
    values: ArrayLike,
    layout: Layout,
    *,
    weight: ArrayLike | None = None,
    prior: Reflectance | None = None,
    floor: ArrayLike | None = None,
    smoothness: float = SMOOTHNESS,
    pull: float = PULL,
) -> Table:
    """A table fitted to `values` (N, 3) [1/sr] at pairs of directions `wi`, `wo` (N, 3).

    `weight` (N,) or (N, 3), not negative: of squared errors of f, up to a common factor; all 1 by default. `prior`: an
    isotropic reflectance that unseen directions continue; by default Lambert's law with the samples' weighted mean.
    `floor` (3,): what the encoding subtracts (in units of its `scale`), for layouts that want one; 0 by default.
    Samples at the horizon take no part. Raises ParameterError for shapes that do not fit, numbers that are not
    finite or negative weights; ReflectanceError when no usable sample is left.
    """
    wi, wo, values, weights = _checked(wi, wo, values, weight)
    if not (smoothness > 0 and pull > 0):
        raise ParameterError(f"smoothness and pull must be above 0, got {smoothness:g} and {pull:g}")
    floor = np.zeros(3) if floor is None else np.asarray(floor, np.float64)
    coordinates = layout.texture_coordinates(layout.basis.angles(Vec(*wi.T), Vec(*wo.T)))
    start = _prior_nodes(prior, layout, floor, values, weights)
    places = np.stack([*coordinates, 0.5 * np.linalg.norm(wi + wo, axis=-1)], -1)
    penalty = smoothness * (_roughness(layout.shape) + pull * _identity(math.prod(layout.shape)))
    places, values, weights = _merged(places, values, weights, layout.shape)
    used, shares = reading(list(places[:, :3].T), layout.shape)
    fitted = np.empty_like(start)
    for channel in range(3):
        share = weights[:, channel] * (len(start) / weights[:, channel].sum())

        def decode(stored: Array, c: int = channel) -> Array:
            return np.asarray(layout.encoding.decode(Vec(stored, stored, stored), places[:, 3], float(floor[c]))[0])

        fitted[:, channel] = _gauss_newton(decode, values[:, channel], share, used, shares, start[:, channel], penalty)
    return Table.encoded(layout, fitted.reshape(*layout.shape, 3), floor if np.any(floor) else None)


def _checked(wi: ArrayLike, wo: ArrayLike, values: ArrayLike, weight: ArrayLike | None) -> tuple[Array, ...]:
    """The usable samples: directions, values and weights (N, 3)."""
    wi, wo, _ = broadcast_directions(wi, wo)
    values = np.asarray(values, np.float64)
    if values.shape != wi.shape:
        raise ParameterError(f"values must have the directions' shape {wi.shape}, got {values.shape}")
    weights = np.asarray(1.0 if weight is None else weight, np.float64)
    weights = weights[:, None] if weights.ndim == 1 else weights
    try:
        weights = np.broadcast_to(weights, values.shape)
    except ValueError:
        raise ParameterError(f"weight must be (N,) or (N, 3) for {len(wi)} samples, got {weights.shape}") from None
    if not (np.isfinite(values).all() and np.isfinite(weights).all() and weights.min(initial=0) >= 0):
        raise ParameterError("values and weights must be finite, and weights not below 0")
    usable = (wi[:, 2] > LEAST_COSINE) & (wo[:, 2] > LEAST_COSINE) & (weights > 0).any(1)
    if not (weights[usable] > 0).any(0).all():
        raise ReflectanceError("no sample to bake: every one is at or below the horizon, or has no weight")
    return tuple(np.asarray(a[usable], np.float64) for a in (wi, wo, values, weights))


def _merged(places: Array, values: Array, weights: Array, shape: tuple[int, ...]) -> tuple[Array, Array, Array]:
    """Samples that lie close together as one: the mean of their places, the weighted mean of their values, the sum of
    their weights. Millions of pixels become tens of thousands of samples, and each of these is less noisy."""
    fine = np.array(shape) * MERGED
    cells = np.ravel_multi_index(tuple(np.clip((places[:, :3] * fine).astype(np.intp), 0, fine - 1).T), tuple(fine))
    found, cell, counts = np.unique(cells, return_inverse=True, return_counts=True)

    def total(column: Array) -> Array:
        return np.asarray(np.bincount(cell, column, len(found)), np.float64)

    weight = np.stack([total(w) for w in weights.T], -1)
    value = np.stack([total(v * w) for v, w in zip(values.T, weights.T, strict=True)], -1)
    place = np.stack([total(p) for p in places.T], -1) / counts[:, None]
    return place, value / np.where(weight > 0, weight, 1), weight


def _prior_nodes(prior: Reflectance | None, layout: Layout, floor: Array, values: Array, weights: Array) -> Array:
    """(nodes, 3) stored values of the prior; nodes below the horizon take the value just above it."""
    wi, wo = layout.basis.directions(*layout.basis.above_horizon(*layout.nodes(), margin=HORIZON_MARGIN))
    mean = np.sum(weights * values, 0) / weights.sum(0)
    known = np.broadcast_to(np.maximum(mean, 0), wi.shape) if prior is None else prior(wi, wo)
    return layout.encoding.encode(known, 0.5 * np.linalg.norm(wi + wo, axis=-1), floor).reshape(-1, 3)


def _identity(count: int) -> Any:
    from scipy.sparse import eye_array

    return eye_array(count, format="csr")


def _roughness(shape: tuple[int, ...]) -> Any:
    """The matrix of squared second differences along each axis, with a little of first differences, sparse."""
    from scipy.sparse import csr_array, kron

    total: Any = 0
    for axis, count in enumerate(shape):
        first = np.diff(np.eye(count), axis=0)
        second = np.diff(np.eye(count), n=2, axis=0)
        along: Any = csr_array(second.T @ second + FIRST_DIFFERENCES * first.T @ first)
        before, after = math.prod(shape[:axis]), math.prod(shape[axis + 1 :])
        total = total + kron(kron(_identity(before), along), _identity(after), format="csr")
    return total


def _gauss_newton(
    decode: Any, values: Array, weights: Array, used: NDArray[np.intp], shares: Any, start: Array, penalty: Any
) -> Array:
    """The nodes (n,) that minimise the module's sum for one channel."""
    from scipy.sparse.linalg import LinearOperator, cg

    nodes = start.copy()
    for _ in range(ITERATIONS):
        stored = shares @ nodes[used]
        model = decode(stored)
        slope = (decode(stored + _DIFFERENCE) - model) / _DIFFERENCE
        residual = values - model
        share = weights * _huber(residual * np.sqrt(weights))
        right = -(penalty @ (nodes - start))
        right[used] += shares.T @ (share * slope * residual)
        curvature = share * slope * slope
        normal = _placed(shares.T @ (shares * curvature[:, None]), used, len(nodes)) + penalty
        diagonal = normal.diagonal()
        scaled = LinearOperator(normal.shape, matvec=lambda v, d=diagonal: v / d, dtype=np.float64)
        step, _ = cg(normal, right, rtol=1e-4, maxiter=500, M=scaled)
        nodes = nodes + np.clip(step, -LARGEST_STEP, LARGEST_STEP)
        if np.abs(step).max() < CONVERGED:
            break
    return nodes


def _placed(small: Any, used: NDArray[np.intp], count: int) -> Any:
    """A matrix over the nodes in use as one over all nodes."""
    from scipy.sparse import csr_array

    entries = small.tocoo()
    return csr_array((entries.data, (used[entries.row], used[entries.col])), shape=(count, count))


def _huber(residual: Array) -> Array:
    """The factors that turn squares into Huber's loss."""
    size = np.abs(residual)
    scale = HUBER * 1.4826 * float(np.median(size))
    return np.minimum(1.0, scale / np.maximum(size, max(scale, 1e-300)))
