"""Least squares on a grid: the normal equations of multilinear interpolation, and their solution.

Samples lie on a product of axes, so that the interpolation matrix is a Kronecker product of one small matrix an axis.
The weights are not a product; yet the normal matrix couples each node with its neighbours alone, and its entries are
the weights contracted, axis by axis, with products of hat functions: 2^d contractions give all 3^d diagonals.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.floating[Any]]
THREADED = 1 << 18
"""Multiplications from which OpenBLAS takes more than one thread for a product of matrices."""

Stencil = list[tuple[tuple[int, ...], Array]]
"""A sparse symmetric matrix over a grid: for each offset s to a neighbour the entries (channels, *shape) of the pairs
(node, node + s); 0 where there is no such neighbour."""


def hats(position: Array, count: int, periodic: bool) -> Array:
    """(samples, count): the weights of the nodes in linear interpolation at positions in units of nodes."""
    apart = np.abs(position[:, None] - np.arange(count))
    if periodic:
        apart = np.minimum(apart, count - apart)
    return np.asarray(np.maximum(1 - apart, 0), np.float32)


def interpolate(nodes: Array, axes: Sequence[Array]) -> Array:
    """(channels, *samples) values of nodes (channels, *shape)."""
    for k, axis in enumerate(axes):
        nodes = _along(axis, nodes, k + 1)
    return nodes


def gather(samples: Array, axes: Sequence[Array]) -> Array:
    """The transpose of `interpolate`: (channels, *shape) sums of samples (channels, *samples) by their weights."""
    for k, axis in reversed(list(enumerate(axes))):
        samples = _along(np.ascontiguousarray(axis.T), samples, k + 1)
    return samples


def _along(matrix: Array, x: Array, k: int) -> Array:
    """`matrix` times x along its axis k, without moving axes about in memory.

    In blocks that the linear algebra library leaves to one thread: its own threads cost more than such products.
    """
    before, after = x.shape[:k], x.shape[k + 1 :]
    rows = x.reshape(-1, x.shape[k], math.prod(after))
    block = max(1, THREADED // matrix.size)
    if after:
        starts = range(0, rows.shape[-1], block)
        product = np.concatenate([matrix @ rows[..., i : i + block] for i in starts], axis=-1)
    else:
        starts = range(0, len(rows), block)
        product = np.concatenate([rows[i : i + block, :, 0] @ matrix.T for i in starts])
    return product.reshape(*before, len(matrix), *after)


def normal_matrix(weights: Array, axes: Sequence[Array], periodic: Sequence[bool]) -> Stencil:
    """A^T diag(weights) A, A the interpolation; weights (channels, *samples)."""
    products = [_products(axis, around) for axis, around in zip(axes, periodic, strict=True)]
    shape = [size for axis in axes for size in (2, axis.shape[1])]
    blocks = gather(weights, products).astype(np.float64).reshape(len(weights), *shape)
    dims = range(1, len(axes) + 1)
    stencil: Stencil = []
    for s in itertools.product((-1, 0, 1), repeat=len(axes)):
        at = tuple(part for step in s for part in (abs(step), slice(None)))
        stencil.append((s, np.roll(blocks[(slice(None), *at)], [-min(step, 0) for step in s], dims)))
    return stencil


def _products(axis: Array, periodic: bool) -> Array:
    """(samples, 2 nodes): the hats of node i squared, and those of nodes i and i + 1 multiplied."""
    across = axis * np.roll(axis, -1, axis=1)
    if not periodic:
        across[:, -1] = 0
    return np.concatenate([axis * axis, across], axis=1)


def difference_penalty(shape: tuple[int, ...], periodic: Sequence[bool]) -> Stencil:
    """The matrix of the sum of squared differences between neighbours."""
    diagonal = np.zeros((1, *shape))
    stencil: Stencil = []
    for k, around in enumerate(periodic, start=1):
        joined = np.ones((1, *shape))
        if not around:
            joined[(slice(None),) * k + (-1,)] = 0
        before = np.roll(joined, 1, k)
        unit = tuple(int(j == k) for j in range(1, len(shape) + 1))
        stencil += [(unit, -joined), (tuple(-u for u in unit), -before)]
        diagonal += joined + before
    return [((0,) * len(shape), diagonal), *stencil]


def add(a: Stencil, b: Stencil, scale: Array) -> Stencil:
    """a + scale b, whose offsets are among those of a; scale (channels,)."""
    extra = dict(b)
    scale = scale.reshape(-1, *(1,) * len(a[0][0]))
    return [(s, entries + scale * extra[s] if s in extra else entries) for s, entries in a]


def multiply(stencil: Stencil, x: Array) -> Array:
    """The matrix times x (channels, *shape)."""
    shape = x.shape[1:]
    strides = [math.prod(shape[k + 1 :]) for k in range(len(shape))]
    reach = sum(strides)
    flat = x.reshape(len(x), -1)
    size = flat.shape[1]
    # a neighbour is a fixed distance away; only the first axis may be a circle, and its ends are those of the array
    around = np.concatenate([flat[:, -reach:], flat, flat[:, :reach]], axis=1)
    product, term = np.zeros_like(flat), np.empty_like(flat)
    for s, entries in stencil:
        start = reach + sum(step * stride for step, stride in zip(s, strides, strict=True))
        np.multiply(entries.reshape(len(entries), -1), around[:, start : start + size], out=term)
        product += term
    return product.reshape(x.shape)


def solve(stencil: Stencil, right: Array, iterations: int) -> Array:
    """x (channels, *shape) with stencil x = right, each channel by itself: conjugate gradients, the residual scaled by
    the diagonal, from x = 0."""
    dims = tuple(range(1, right.ndim))
    diagonal = dict(stencil)[(0,) * len(dims)]
    inverse = 1 / np.where(diagonal > 0, diagonal, 1)
    x = np.zeros_like(right)
    residual = right.copy()
    direction = scaled = inverse * residual
    progress = np.sum(residual * scaled, dims, keepdims=True)
    target = 1e-10 * progress
    for _ in range(iterations):
        if np.all(progress <= target):
            break
        image = multiply(stencil, direction)
        step = _ratio(progress, np.sum(direction * image, dims, keepdims=True))
        x += step * direction
        residual -= step * image
        scaled = inverse * residual
        before, progress = progress, np.sum(residual * scaled, dims, keepdims=True)
        direction = scaled + _ratio(progress, before) * direction
    return x


def _ratio(a: Array, b: Array) -> Array:
    return np.divide(a, b, out=np.zeros_like(a), where=b > 0)
