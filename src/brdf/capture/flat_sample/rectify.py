"""The sample cut out of a photograph: perspective undone by four marks, cropped, averaged down."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError

Array = NDArray[np.floating[Any]]


class Cutter:
    """Cuts the same square out of every photograph of a fixed camera.

    With `corners` (4, 2), the marks' pixels (x, y) in order top left, top right, bottom right, bottom left, the
    quadrilateral becomes a square of `crop` pixels at most; else the middle is cropped to `crop` at most. Then it is
    averaged down by area to `size` at most. Pixel centres have whole numbers; (0, 0) is the one at the top left.
    """

    def __init__(self, shape: tuple[int, int], corners: Array | None, crop: int, size: int) -> None:
        for name, pixels in (("crop", crop), ("size", size)):
            if pixels < 1:
                raise ParameterError(f"{name} must be at least 1 pixel, got {pixels}")
        self._places: Array | None = None
        if corners is None:
            rows, columns = (min(crop, extent) for extent in shape)
            top, left = (shape[0] - rows) // 2, (shape[1] - columns) // 2
            self._box = np.s_[top : top + rows, left : left + columns]
        else:
            side = _longest_side(_checked(corners, shape))
            rows = columns = max(1, min(crop, round(side)))
            # where the photograph is finer than the square, its pixels are averaged rather than skipped
            self._places = _places(corners, rows * max(1, round(side / rows)))
        scale = min(1.0, size / max(rows, columns))
        self.out = (max(1, round(rows * scale)), max(1, round(columns * scale)))

    def cut(self, picture: Array) -> Array:
        """(H, W, 3) -> (*out, 3)."""
        part = picture[self._box] if self._places is None else _sampled(picture, self._places)
        return area_averaged(part, self.out)


def homography(source: Array, target: Array) -> Array:
    """(3, 3) that takes four points (4, 2) to four others. Raises ParameterError when three lie on a line."""
    rows = []
    for (x, y), (u, v) in zip(source, target, strict=True):
        rows += [[x, y, 1, 0, 0, 0, -u * x, -u * y], [0, 0, 0, x, y, 1, -v * x, -v * y]]
    try:
        h = np.linalg.solve(np.array(rows, np.float64), np.asarray(target, np.float64).reshape(8))
    except np.linalg.LinAlgError:
        raise ParameterError("three of the four corner marks lie on one line") from None
    return np.append(h, 1.0).reshape(3, 3)


def area_averaged(picture: Array, shape: tuple[int, int]) -> Array:
    """(H, W, C) -> (*shape, C): each pixel the mean over its area, fractions of pixels included."""
    if picture.shape[:2] == shape:
        return picture
    rows, columns = (_overlaps(old, new) for old, new in zip(picture.shape[:2], shape, strict=True))
    narrow = np.tensordot(rows, picture, (1, 0))
    return np.ascontiguousarray(np.einsum("nw,hwc->hnc", columns, narrow, optimize=True))


def _overlaps(old: int, new: int) -> NDArray[np.float32]:
    """(new, old) shares of the old pixels in each new one."""
    edges = np.arange(new + 1) * (old / new)
    low, high = edges[:-1, None], edges[1:, None]
    cells = np.arange(old)
    shared = np.clip(np.minimum(high, cells + 1) - np.maximum(low, cells), 0, None)
    return np.asarray(shared / (old / new), np.float32)


def _longest_side(corners: Array) -> float:
    sides = np.asarray(corners, np.float64) - np.roll(corners, -1, 0)
    return float(np.linalg.norm(sides, axis=1).max())


def _checked(corners: Array, shape: tuple[int, int]) -> Array:
    """The corners as floats. Raises ParameterError."""
    corners = np.asarray(corners, np.float64)
    if corners.shape != (4, 2) or not np.isfinite(corners).all():
        raise ParameterError("corners must be four pixels x,y")
    outside = (corners < -0.5).any() or (corners > np.array([shape[1], shape[0]]) - 0.5).any()
    if outside:
        raise ParameterError(f"the corner marks must lie within the photographs of {shape[1]} x {shape[0]} pixels")
    following, last = np.roll(corners, -1, 0) - corners, corners - np.roll(corners, 1, 0)
    turns = last[:, 0] * following[:, 1] - last[:, 1] * following[:, 0]
    if not (turns > 0).all():
        raise ParameterError(
            "corners must go around the sample: top left, top right, bottom right, bottom left, no three on one line"
        )
    return corners


def _places(corners: Array, size: int) -> Array:
    """(2, size, size) rows and columns in the photograph of the square's texel centres."""
    square = np.array([[0, 0], [size, 0], [size, size], [0, size]], np.float64)
    h = homography(square, corners)
    centre = np.arange(size) + 0.5
    x, y = np.meshgrid(centre, centre)
    w = h[2, 0] * x + h[2, 1] * y + h[2, 2]
    across = (h[0, 0] * x + h[0, 1] * y + h[0, 2]) / w
    down = (h[1, 0] * x + h[1, 1] * y + h[1, 2]) / w
    return np.stack([down, across]).astype(np.float32)


def _sampled(picture: Array, places: Array) -> Array:
    from scipy.ndimage import map_coordinates

    channels = [map_coordinates(picture[..., c], places, order=1, mode="nearest") for c in range(picture.shape[2])]
    return np.stack(channels, -1)
