"""The compiled loop of tree.py: boxes around ever fewer triangles."""

from __future__ import annotations

from typing import Any

import numpy as np

from .compiled import helper, kernel

BINS = 16
"""Places tried along each axis to divide a box's triangles."""
LEAF = 4
"""Triangles that are not divided any further."""
DEEPEST = 48
"""Levels below which triangles are halved by number alone, so that no mesh makes the tree a list."""


@helper
def _half_area(least: Any, greatest: Any) -> Any:
    x, y, z = greatest[0] - least[0], greatest[1] - least[1], greatest[2] - least[2]
    return x * y + y * z + z * x


@helper
def _bin(middle: Any, low: Any, high: Any) -> Any:
    return min(int((middle - low) / (high - low) * BINS), BINS - 1)


@helper
def _best_division(least: Any, greatest: Any, order: Any, start: Any, stop: Any) -> Any:
    """Axis, last bin on the left, and the middles' interval along it: least surface times triangles [Wald2007].

    The axis is -1 where all the middles coincide.
    """
    best_cost, best_axis, best_bin, best_low, best_high = np.inf, -1, 0, 0.0, 0.0
    for axis in range(3):
        low, high = np.inf, -np.inf
        for n in range(start, stop):
            middle = least[order[n], axis] + greatest[order[n], axis]
            low, high = min(low, middle), max(high, middle)
        if not high > low:
            continue
        counts = np.zeros(BINS, np.int64)
        small, large = np.full((BINS, 3), np.inf), np.full((BINS, 3), -np.inf)
        for n in range(start, stop):
            f = order[n]
            b = _bin(least[f, axis] + greatest[f, axis], low, high)
            counts[b] += 1
            for c in range(3):
                small[b, c], large[b, c] = min(small[b, c], least[f, c]), max(large[b, c], greatest[f, c])
        costs = np.zeros(BINS)
        below, above, count = np.full(3, np.inf), np.full(3, -np.inf), 0
        for b in range(BINS - 1, 0, -1):
            count += counts[b]
            for c in range(3):
                below[c], above[c] = min(below[c], small[b, c]), max(above[c], large[b, c])
            costs[b - 1] = _half_area(below, above) * count if count else 0.0
        below[:], above[:], count = np.inf, -np.inf, 0
        for b in range(BINS - 1):
            count += counts[b]
            for c in range(3):
                below[c], above[c] = min(below[c], small[b, c]), max(above[c], large[b, c])
            if 0 < count < stop - start:
                cost = costs[b] + _half_area(below, above) * count
                if cost < best_cost:
                    best_cost, best_axis, best_bin, best_low, best_high = cost, axis, b, low, high
    return best_axis, best_bin, best_low, best_high


@kernel("i8(f8[:,::1], f8[:,::1], i8[::1], f8[:,::1])")
def build(least: Any, greatest: Any, order: Any, nodes: Any) -> int:
    """Fill `nodes` (at least 2 F, 8) and bring `order` (F,) into that of the leaves; returns the number of nodes.

    `least`, `greatest` (F, 3): corners of the box around each triangle. A node is (least corner, first triangle of a
    leaf or -1, greatest corner, triangles of a leaf or the node that follows its subtree), in depth-first order.
    """
    count = len(order)
    waiting = np.empty((count + 2, 4), np.int64)  # start, stop, parent, level
    waiting[0, 0], waiting[0, 1], waiting[0, 2], waiting[0, 3] = 0, count, -1, 0
    parents, sizes = np.empty(len(nodes), np.int64), np.ones(len(nodes), np.int64)
    depth, made = 1, 0
    while depth:
        depth -= 1
        start, stop, level = waiting[depth, 0], waiting[depth, 1], waiting[depth, 3]
        node, parents[made] = made, waiting[depth, 2]
        made += 1
        nodes[node, :3], nodes[node, 4:7] = np.inf, -np.inf
        for n in range(start, stop):
            for c in range(3):
                nodes[node, c] = min(nodes[node, c], least[order[n], c])
                nodes[node, 4 + c] = max(nodes[node, 4 + c], greatest[order[n], c])
        if stop - start <= LEAF:
            nodes[node, 3], nodes[node, 7] = start, stop - start
            continue
        nodes[node, 3] = -1
        axis, last, low, high = -1, 0, 0.0, 0.0
        if level < DEEPEST:
            axis, last, low, high = _best_division(least, greatest, order, start, stop)
        divide = (start + stop) // 2
        if axis >= 0:
            i, divide = start, stop
            while i < divide:
                f = order[i]
                if _bin(least[f, axis] + greatest[f, axis], low, high) <= last:
                    i += 1
                else:
                    divide -= 1
                    order[i], order[divide] = order[divide], f
        for first, end in ((divide, stop), (start, divide)):  # the left part is taken up first
            waiting[depth, 0], waiting[depth, 1], waiting[depth, 2], waiting[depth, 3] = first, end, node, level + 1
            depth += 1
    for node in range(made - 1, -1, -1):
        if nodes[node, 3] < 0:
            nodes[node, 7] = node + sizes[node]
        if parents[node] >= 0:
            sizes[parents[node]] += sizes[node]
    return made
