"""Textures that tile, or are larger than their sample: which texel of the sample to show at each place.

Texels are compared by features (rows, columns, C); the result is an array of flat indices, so that everything else that
belongs to a texel follows it. Pieces of the sample meet along the cheapest seam through the region where they overlap.
Reference: Efros2001.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError

Features = NDArray[np.float32]
Texels = NDArray[np.intp]

SMALLEST = 16
"""Rows and columns a sample needs to be taken apart."""
LARGEST = 16384
"""Rows and columns of the largest result."""
LEAST_KEPT = 0.75
"""Share of the sample's side that a tile keeps at least."""
OVERLAP = 1 / 8
"""Width of the overlap in which a tile's opposite edges are joined, as a share of the side."""
BLOCKS = 3
"""Blocks that fit along the shorter side of the sample; an overlap is a third of a block. Smaller ones repeat less, but
break threads and grains that are longer than the overlap."""
TOLERANCE = 0.1
"""Candidates whose error is at most this share above the least one are equally good."""


def tile(features: Features) -> Texels:
    """The part of the sample, cut out where it fits its own opposite edges best, that can be repeated.

    Both sides keep at least three quarters of the sample. Raises ParameterError for a sample below 16 x 16.
    """
    rows, columns, _ = _checked(features)
    across = _joined(features)
    texels = np.arange(rows)[:, None] * columns + across
    flat = features.reshape(-1, features.shape[-1])
    down = _joined(np.ascontiguousarray(flat[texels].transpose(1, 0, 2)), closed=True)
    return np.ascontiguousarray(np.take_along_axis(texels, down.T, 0))


def _joined(features: Features, closed: bool = False) -> Texels:
    """(rows, period) columns to show so that the last meets the first; `closed`: so that rows repeat, too.

    The right part of the sample, beyond the period, takes the place of its left edge up to a seam.
    """
    from .quilting_kernels import seam

    columns = features.shape[1]
    overlap = max(4, round(OVERLAP * columns))
    left = features[:, :overlap]
    periods = np.arange(int(np.ceil(LEAST_KEPT * columns)), columns - overlap + 1)
    errors = [float(np.mean((left - features[:, p : p + overlap]) ** 2)) for p in periods]
    period = int(periods[int(np.argmin(errors))])
    cost = ((left - features[:, period : period + overlap]) ** 2).sum(-1).astype(np.float64)
    path = seam(cost, -1)
    if closed:  # the seam in the middle of three copies hardly knows the ends: it starts where a closed one should
        path = seam(cost, int(seam(np.concatenate([cost] * 3), -1)[len(cost)]))
    column = np.arange(period)
    return np.where(column[None, :] < path[:, None], column + period, column)


def quilt(features: Features, size: int | tuple[int, int], seed: int = 0) -> Texels:
    """Blocks of the sample, each chosen to fit those already laid, that fill `size` (rows, columns) and tile.

    Candidates are compared everywhere at a quarter of the resolution, then moved to fit at full resolution.
    Raises ParameterError for a sample below 16 x 16, or a size below half of it.
    """
    sample_rows, sample_columns, _ = _checked(features)
    rows, columns = _size(size, min(sample_rows, sample_columns))
    work = _Quilt(features, rows, columns, seed)
    work.lay()
    return work.texels


class _Quilt:
    """The work in progress: texels laid so far, on a surface whose opposite edges meet."""

    def __init__(self, features: Features, rows: int, columns: int, seed: int) -> None:
        self.features, self.random = features, np.random.default_rng(seed)
        short = min(features.shape[:2])
        self.step = 4 if short >= 128 else 1
        self.block = max(8, short // BLOCKS) // self.step * self.step
        self.overlap = max(2, self.block // 3) // self.step * self.step
        self.texels = np.zeros((rows, columns), np.intp)
        self.filled = np.zeros((rows, columns), np.bool_)
        self.search = _Search(features, self.step, self.block)

    def lay(self) -> None:
        stride = self.block - self.overlap
        starts = [np.arange(n := max(2, -(-side // stride))) * side // n for side in self.texels.shape]
        for row in starts[0]:
            for column in starts[1]:
                self._lay_block(int(row), int(column))

    def _lay_block(self, row: int, column: int) -> None:
        side, columns = np.arange(self.block), self.features.shape[1]
        at = np.ix_((row + side) % self.texels.shape[0], (column + side) % self.texels.shape[1])
        filled, laid = self.filled[at], self.texels[at]
        target = self.features.reshape(-1, self.features.shape[-1])[laid] * filled[..., None]
        corner = self.search.corner(target, filled, self.random)
        here = (corner[0] + side)[:, None] * columns + corner[1] + side
        block = self.features[corner[0] : corner[0] + self.block, corner[1] : corner[1] + self.block]
        cost = ((block - target) ** 2).sum(-1).astype(np.float64)
        new = ~filled | _inside(cost, filled)
        self.texels[at] = np.where(new, here, laid)
        self.filled[at] = True


def _inside(cost: NDArray[np.float64], filled: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Where a block covers what was laid: within the seams through its overlaps at left, top, right and bottom."""
    from .quilting_kernels import seam

    inside = np.ones_like(filled)
    for turn in range(4):  # turned so that each side in its turn is the left one
        turned, laid = np.rot90(cost, turn), np.rot90(filled, turn)
        width = int(np.argmin(laid[len(laid) // 2])) if not laid[len(laid) // 2].all() else 0
        if width > 0:
            path = seam(np.ascontiguousarray(turned[:, :width]), -1)
            beyond = np.arange(len(laid))[None, :] >= path[:, None]
            inside &= np.rot90(beyond, -turn)
    return inside


class _Search:
    """Where in the sample a block fits best."""

    def __init__(self, features: Features, step: int, block: int) -> None:
        from scipy.fft import rfft2

        self.features, self.step, self.block = features, step, block
        rows, columns = (n // step for n in features.shape[:2])
        self.coarse = _reduced(features[: rows * step, : columns * step], step)
        self.size = (rows, columns)
        self.valid = (rows - block // step + 1, columns - block // step + 1)
        self.spectra = rfft2(self.coarse, axes=(0, 1))
        self.squares = rfft2((self.coarse**2).sum(-1))
        self.of_masks: dict[bytes, NDArray[Any]] = {}

    def corner(self, target: Features, filled: NDArray[np.bool_], random: np.random.Generator) -> tuple[int, int]:
        """The sample's row and column of the block to lay on `target`, of which `filled` is known."""
        if not filled.any():
            return tuple(int(random.integers(n - self.block + 1)) for n in self.features.shape[:2])  # type: ignore[return-value]
        errors = self._errors(target, filled)
        good = np.flatnonzero(errors <= errors.min() * (1 + TOLERANCE))
        row, column = np.unravel_index(int(random.choice(good)), errors.shape)
        if self.step == 1:
            return int(row), int(column)
        from .quilting_kernels import best_nearby

        at = int(row) * self.step, int(column) * self.step
        found = best_nearby(self.features, target, filled, *at, self.step)
        return int(found[0]), int(found[1])

    def _errors(self, target: Features, filled: NDArray[np.bool_]) -> NDArray[np.float64]:
        """Squared differences over the filled part, for every position in the sample (by fast Fourier transform)."""
        from scipy.fft import irfft2, rfft2

        known = _reduced(filled[..., None].astype(np.float32), self.step)[..., 0]
        weighted = _reduced(target, self.step)  # what is not filled is 0: this is mask times target
        key = known.tobytes()
        if key not in self.of_masks:
            self.of_masks[key] = irfft2(np.conj(rfft2(known, self.size)) * self.squares, self.size)
        product = (np.conj(rfft2(weighted, self.size, axes=(0, 1))) * self.spectra).sum(-1)
        own = float((weighted**2 / np.maximum(known, 1e-6)[..., None]).sum())
        errors = self.of_masks[key] - 2 * irfft2(product, self.size) + own
        return np.asarray(np.maximum(errors[: self.valid[0], : self.valid[1]], 0))


def _reduced(a: Features, step: int) -> Features:
    """Means over step x step texels."""
    rows, columns, channels = a.shape
    return np.asarray(a.reshape(rows // step, step, columns // step, step, channels).mean((1, 3)))


def _checked(features: Features) -> tuple[int, int, int]:
    if min(features.shape[:2]) < SMALLEST:
        raise ParameterError(f"a sample must be at least {SMALLEST} x {SMALLEST} to be continued, "
                             f"got {features.shape[0]} x {features.shape[1]}")  # fmt: skip
    rows, columns, channels = features.shape
    return rows, columns, channels


def _size(size: int | tuple[int, int], short: int) -> tuple[int, int]:
    sides: tuple[Any, ...] = tuple(size) if isinstance(size, (tuple, list)) else (size, size)
    least = -(-short // 2)
    if len(sides) != 2 or not all(isinstance(n, (int, np.integer)) and least <= n <= LARGEST for n in sides):
        raise ParameterError(f"size must be one or two whole numbers in [{least}, {LARGEST}], got {size!r}")
    return int(sides[0]), int(sides[1])
