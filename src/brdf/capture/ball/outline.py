"""Where the ball is in the pictures, and the normals on it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError

Array = NDArray[np.floating[Any]]

LEAST_RADIUS = 8.0
"""Pixels: a smaller ball shows too few normals."""
ROUNDNESS = 0.9
"""Least overlap (intersection over union) of a mask with the circle fitted to it."""
LEAST_EDGE = 0.6
"""Least share of the circle along which its edge is seen."""
THRESHOLDS = (0.02, 0.05, 0.1, 0.2, 0.4)
"""Shares of the pictures' 98th percentile above which a pixel of their maximum may belong to the ball."""
REACHES = (0.3, 0.15, 0.08)
"""How far from a first circle its edge is searched, as shares of the radius, one after the other."""


@dataclass(frozen=True)
class Ball:
    """A circle in a picture: centre from the top left corner of the top left pixel, and radius [pixels]."""

    x: float
    y: float
    radius: float

    def normals(self, height: int, width: int) -> tuple[Array, Array]:
        """(H, W, 3) unit normals, x right, y up, z to the camera, seen from afar; and (H, W) distances from the centre
        in radii, above 1 outside, where the normals lie in the picture's plane."""
        x = (np.arange(width) + 0.5 - self.x) / self.radius
        y = (self.y - np.arange(height) - 0.5) / self.radius
        grid_x, grid_y = np.meshgrid(x, y)
        distance = np.hypot(grid_x, grid_y)
        inside = np.maximum(distance, 1.0)
        grid_x, grid_y = grid_x / inside, grid_y / inside
        z = np.sqrt(np.maximum(1 - grid_x**2 - grid_y**2, 0))
        return np.stack([grid_x, grid_y, z], -1), distance


def ball_of_mask(mask: NDArray[np.bool_]) -> Ball:
    """The circle of the same area and centre as the mask. Raises ParameterError when the mask is no disc."""
    count = int(mask.sum())
    radius = math.sqrt(count / math.pi)
    if radius < LEAST_RADIUS:
        raise ParameterError(
            f"the mask has {count} pixels, too few for a ball; it must be white where the ball is and black elsewhere"
        )
    rows, columns = np.nonzero(mask)
    ball = Ball(float(columns.mean()) + 0.5, float(rows.mean()) + 0.5, radius)
    disc = ball.normals(*mask.shape)[1] <= 1
    overlap = float((disc & mask).sum() / (disc | mask).sum())
    if overlap < ROUNDNESS:
        raise ParameterError(
            f"the mask is no disc (it shares {overlap:.0%} with the best circle); it must show one whole ball, white "
            "on black"
        )
    return ball


def ball_of_pictures(brightest: Array) -> Ball:
    """The ball on dark ground, from the largest value (H, W) that any photograph has at each pixel.

    For several thresholds the largest disc within the bright region is a first circle: a stand or a fold of cloth that
    touches the ball does not enlarge it. Then the edge is where brightness falls most along rays from the centre, and
    a circle is fitted to these points, outliers left out. The circle whose edge is seen best wins. Raises
    ParameterError.
    """
    from scipy.ndimage import binary_fill_holes, distance_transform_edt

    brightest = np.asarray(brightest, np.float64)
    top = float(np.quantile(brightest, 0.98))
    if not top > 0:
        raise ParameterError("no ball found: the photographs are black; expose longer")
    best, best_seen = Ball(0, 0, 1), 0.0
    for threshold in THRESHOLDS:
        region = np.pad(binary_fill_holes(brightest > threshold * top), 1)
        depth = distance_transform_edt(region)[1:-1, 1:-1]
        row, column = np.unravel_index(int(depth.argmax()), depth.shape)
        ball, seen = Ball(float(column) + 0.5, float(row) + 0.5, float(depth.max())), 0.0
        if ball.radius < LEAST_RADIUS:
            continue
        for reach in REACHES:
            ball, seen = _refined(brightest, ball, reach)
        outside = not (0 < ball.x < brightest.shape[1] and 0 < ball.y < brightest.shape[0])
        if seen > best_seen and not outside and LEAST_RADIUS <= ball.radius < 0.75 * max(brightest.shape):
            best, best_seen = ball, seen
    if best_seen < LEAST_EDGE:
        raise ParameterError("no round ball found on dark ground; give --mask, white where the ball is")
    return best


def _circle(x: Array, y: Array) -> Ball:
    """The circle through most of the points: algebraic fit, repeated without those off by over 2 scales."""
    keep = np.ones(len(x), np.bool_)
    ball = Ball(0, 0, 1)
    for _ in range(12):
        system = np.stack([x[keep], y[keep], np.ones(keep.sum())], -1)
        a, b, c = np.linalg.lstsq(system, x[keep] ** 2 + y[keep] ** 2, rcond=None)[0]
        ball = Ball(a / 2, b / 2, math.sqrt(max(c + a * a / 4 + b * b / 4, 1e-12)))
        off = np.abs(np.hypot(x - ball.x, y - ball.y) - ball.radius)
        keep = off <= max(2 * 1.4826 * float(np.median(off)), 0.5)
    return ball


def _refined(brightest: Array, ball: Ball, reach: float) -> tuple[Ball, float]:
    """The circle through the steepest fall of the logarithm along rays, within a share `reach` of the radius of a first
    circle; and the share of the rays whose fall lies within 2 % of it."""
    from scipy.ndimage import map_coordinates

    azimuth = np.linspace(0, 2 * math.pi, 360, endpoint=False)
    radius = np.arange((1 - reach) * ball.radius, (1 + reach) * ball.radius, 0.25)
    x = ball.x + radius * np.cos(azimuth)[:, None] - 0.5
    y = ball.y - radius * np.sin(azimuth)[:, None] - 0.5
    ground = 0.02 * float(np.quantile(brightest, 0.98))
    along = map_coordinates(np.log(brightest + ground), [y, x], order=1, mode="nearest")
    fall = -np.gradient(along, axis=1)
    smooth = np.stack([np.convolve(row, np.ones(5) / 5, "valid") for row in fall])
    at = radius[2 + smooth.argmax(1)]
    points_x, points_y = ball.x + at * np.cos(azimuth), ball.y - at * np.sin(azimuth)
    found = _circle(points_x, points_y)
    off = np.abs(np.hypot(points_x - found.x, points_y - found.y) - found.radius)
    return found, float(np.mean(off < max(0.02 * found.radius, 1.0)))
