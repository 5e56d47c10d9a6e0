"""Which pairs of directions a capture has seen."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...geometry.directions import to_half_difference
from ...representations.tables.bases import HalfBasis

Array = NDArray[np.floating[Any]]

BINS = (18, 18, 18)
"""Of 5 degrees each over theta_h, theta_d and phi_d, all from 0 to 90 degrees."""


@dataclass(frozen=True)
class Coverage:
    """Bins over (theta_h, theta_d, phi_d), phi_d folded to a quarter turn by reciprocity and mirror symmetry."""

    seen: NDArray[np.bool_]
    """`BINS`: whether a sample fell there"""
    possible: NDArray[np.bool_]
    """`BINS`: whether directions above the horizon exist there"""

    @property
    def share(self) -> float:
        """The share of the possible bins that was seen."""
        return float(self.seen.sum() / self.possible.sum())

    @property
    def map(self) -> Array:
        """(theta_h, theta_d): the share of possible phi_d that was seen; NaN where there are none."""
        possible = self.possible.sum(2)
        return np.where(possible > 0, self.seen.sum(2) / np.maximum(possible, 1), np.nan)

    @property
    def largest_theta_d(self) -> float:
        """The upper end of the last bin over theta_d that was seen [degrees]."""
        return float((np.flatnonzero(self.seen.any((0, 2))).max(initial=-1) + 1) * 90 / BINS[1])


def coverage_of(wi: Array, wo: Array) -> Coverage:
    """The coverage of pairs of directions (N, 3) above the horizon."""
    angles = to_half_difference(wi, wo)
    phi_d = np.abs(angles.phi_d)
    folded = np.minimum(phi_d, math.pi - phi_d)
    share = [angle / (math.pi / 2) for angle in (angles.theta_h, angles.theta_d, folded)]
    index = tuple(np.clip((s * n).astype(np.intp), 0, n - 1) for s, n in zip(share, BINS, strict=True))
    seen = np.zeros(BINS, np.bool_)
    seen[index] = True
    # a bin is possible when any point of a finer grid in it is above the horizon
    fine = 4
    grid = [(np.arange(n * fine) + 0.5) / (n * fine) * math.pi / 2 for n in BINS]
    i, o = HalfBasis("quarter-turn").directions(grid[0][:, None, None], grid[1][None, :, None], grid[2][None, None, :])
    above = (i[..., 2] > 0) & (o[..., 2] > 0)
    possible = above.reshape(BINS[0], fine, BINS[1], fine, BINS[2], fine).any((1, 3, 5)) | seen
    return Coverage(seen, possible)
