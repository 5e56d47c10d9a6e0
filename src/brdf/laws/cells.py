"""A partition of the directions in which both a density and its samples can be counted.

The directions are laid out as a rectangle, sqrt(1 - cosine) by azimuth. Cells that hold much probability or many
samples, or whose integral is not known well enough, are quartered, so that a lobe of any width is resolved into
hundreds of cells.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.floating[Any]]

BASE = (16, 32)
"""Cells along the polar and the azimuthal side to start from."""

LARGEST = 1 / 256
"""Probability above which a cell is quartered."""

DEPTH = 12
"""Quarterings at most: to cells of 1e-5 rad, far below the width of any lobe."""

FINE = 10
"""Strata along each side of a cell, one point in each, for the integral of the density."""

COARSE = 5
"""The same for the integral that the fine one is compared with."""

FEW = 50
"""Samples, found or expected, below which a cell is not quartered for accuracy."""

ACCURACY = 0.2
"""Difference between fine and coarse integral that is let pass, in standard deviations of the number of samples."""


class Cells(NamedTuple):
    """Integrals of the density and counts of the samples, cell by cell."""

    probability: Floats
    """(C,) integral of the density over each cell"""
    counts: NDArray[np.int64]
    """(C,) samples in each cell"""
    error: float
    """Estimated error of the sum of the probabilities"""


def counted(density: Callable[[Floats], Floats], samples: Floats, lowest: float) -> Cells:
    """Integrate `density` ((N, 3) -> (N,), 1/sr) and count `samples` (M, 3) where the cosine exceeds `lowest`.

    `lowest` is 0 for the upper hemisphere, -1 for the sphere.
    """
    depth = (1 - samples[:, 2]) / (1 - lowest)
    across = np.sqrt(depth.clip(0))
    around = np.arctan2(samples[:, 1], samples[:, 0]) / (2 * np.pi) % 1.0
    inside = depth < 1
    points = np.stack([across[inside], around[inside]], axis=-1)

    rows, columns = np.divmod(np.arange(BASE[0] * BASE[1]), BASE[1])
    probability, counts, differences = [], [], []
    rng = np.random.default_rng(0)
    for level in range(DEPTH + 1):
        size = np.array(BASE) << level
        held = _held(points, rows, columns, size)
        coarse, fine = (_integrals(density, rows, columns, size, lowest, n, rng) for n in (COARSE, FINE))
        split = _unresolved(coarse * len(samples), fine * len(samples), held, len(samples))
        split &= level < DEPTH
        probability.append(fine[~split])
        counts.append(held[~split])
        differences.append((fine - coarse)[~split])
        rows = (2 * rows[split, None] + np.array([0, 0, 1, 1])).ravel()
        columns = (2 * columns[split, None] + np.array([0, 1, 0, 1])).ravel()
        if not len(rows):
            break
    error = float(np.linalg.norm(np.concatenate(differences)))
    return Cells(np.concatenate(probability), np.concatenate(counts), error)


def _unresolved(coarse: Floats, fine: Floats, held: NDArray[np.int64], samples: int) -> NDArray[np.bool_]:
    """Which cells to quarter, from expected (by two rules) and found numbers of samples."""
    most = np.maximum(np.maximum(coarse, fine), held)
    rough = np.abs(fine - coarse) > ACCURACY * np.sqrt(np.maximum(fine, FEW))
    unresolved: NDArray[np.bool_] = (most > LARGEST * samples) | ((most > FEW) & rough)
    return unresolved


def _directions(points: Floats, lowest: float) -> Floats:
    """Directions (..., 3) of points (..., 2) of the rectangle."""
    depth, phi = (1 - lowest) * points[..., 0] ** 2, 2 * np.pi * points[..., 1]
    radius = np.sqrt(depth * (2 - depth))
    return np.stack([radius * np.cos(phi), radius * np.sin(phi), 1 - depth], axis=-1)


def _held(points: Floats, rows: Any, columns: Any, size: Any) -> NDArray[np.int64]:
    """How many points lie in each of the cells of one level."""
    index = np.minimum((points * size).astype(np.int64), size - 1)
    codes, found = np.unique(index[:, 0] * size[1] + index[:, 1], return_counts=True)
    held = np.zeros(len(rows), np.int64)
    if len(codes):
        wanted = rows * size[1] + columns
        at = np.minimum(np.searchsorted(codes, wanted), len(codes) - 1)
        held = np.where(codes[at] == wanted, found[at], 0)
    return held


def _integrals(
    density: Callable[[Floats], Floats],
    rows: Any,
    columns: Any,
    size: Any,
    lowest: float,
    strata: int,
    rng: np.random.Generator,
) -> Floats:
    """Integrals of the density over cells of one level.

    One random point a stratum: at the jumps of a tabulated density the cells' errors are then independent, where those
    of a regular grid would add up along the jump.
    """
    if not len(rows):
        return np.zeros(0)
    corner = np.stack(np.divmod(np.arange(strata**2), strata), axis=-1)
    inside = (corner + rng.random((len(rows), strata**2, 2))) / strata
    points = (np.stack([rows, columns], axis=-1)[:, None] + inside) / size
    solid_angle = 2 * points[..., 0] * (2 * np.pi * (1 - lowest) / (size[0] * size[1]))
    values = density(_directions(points, lowest).reshape(-1, 3)).reshape(len(rows), -1)
    integrals: Floats = (values * solid_angle).mean(1)
    return integrals
