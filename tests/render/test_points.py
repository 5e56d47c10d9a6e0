"""Sample points: well spread within a pixel, and different between pixels."""

from __future__ import annotations

import numpy as np

from brdf.render import points


def drawn(pixels, per_pixel, seed=7, width=800):
    pixels = np.asarray(pixels, np.int32)
    positions = np.empty(len(pixels), np.uint32)
    points.along_curve(0, len(pixels), pixels, width, seed, positions)
    u = np.empty((per_pixel, len(pixels), 2), np.float32)
    for number in range(per_pixel):
        points.fill(
            0, len(pixels), positions, np.zeros(len(pixels), np.int32), per_pixel, number, per_pixel, seed, u[number]
        )
    return u


def test_each_pixel_gets_a_stratified_set():
    """16 points of a (0, 2) net: one in every box of 1/16 area, whatever its shape."""
    for pixel in np.moveaxis(drawn([0, 5, 801, 479_999], 16), 1, 0):
        for columns in (1, 2, 4, 8, 16):
            cells = np.floor(pixel * (columns, 16 // columns)).astype(int)
            assert len({tuple(cell) for cell in cells}) == 16


def test_pixels_differ_and_points_are_uniform():
    u = drawn(np.arange(20_000), 1)[0]
    assert ((u >= 0) & (u < 1)).all()
    assert len(np.unique(u[:, 0])) > 19_000
    counts = np.histogram2d(u[:, 0], u[:, 1], 8, ((0, 1), (0, 1)))[0]
    assert counts.min() > 0.85 * 20_000 / 64


def test_blocks_of_pixels_share_one_stratified_set():
    """An aligned block of 4 x 4 pixels with one point each: again one in every box."""
    block = [(row, column) for row in range(8, 12) for column in range(16, 20)]
    u = drawn([row * 800 + column for row, column in block], 1)[0]
    assert len({tuple(cell) for cell in np.floor(u * 4).astype(int)}) == 16
