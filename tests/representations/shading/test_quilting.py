"""Tiles and larger pieces: made of the sample's texels, continuous where they meet, the same in all pictures."""

from __future__ import annotations

import time
from itertools import pairwise

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter

from brdf import ShadingMap
from brdf.color import luminance
from brdf.errors import ParameterError
from brdf.representations.shading import quilting
from brdf.representations.shading.quilting_kernels import best_nearby, seam
from mesostructures import ACQUIRED, noise, photographs, weave

RNG = np.random.default_rng(2)


def steps(features: np.ndarray, axis: int, at: int) -> float:
    """Mean absolute difference of neighbours across the line before `at`; 0 is where opposite edges meet."""
    return float(np.abs(np.diff(np.take(features, [at - 1, at], axis), axis=axis)).mean())


def rough(rows: int, columns: int) -> np.ndarray:
    """A random sample that does not tile."""
    return gaussian_filter(RNG.standard_normal((rows, columns, 2)), (2, 2, 0)).astype("f4")


def test_the_cheapest_path_is_found() -> None:
    for _ in range(20):
        cost = RNG.random((6, 5))
        best = min(
            (sum(cost[i, j] for i, j in enumerate(path)), path)
            for path in np.ndindex(*(5,) * 6)
            if all(abs(a - b) <= 1 for a, b in pairwise(path))
        )
        assert tuple(seam(cost, -1)) == best[1]
    closed = seam(RNG.random((40, 7)), 3)
    assert closed[0] == 3
    assert abs(closed[-1] - 3) <= 1


def test_the_nearby_position_that_fits_is_found() -> None:
    source = rough(60, 60)
    filled = np.zeros((12, 12), bool)
    filled[:, :4] = filled[:3] = True
    target = source[31:43, 20:32] * filled[..., None]
    assert best_nearby(source, target, filled, 29, 23, 4) == (31, 20)


@pytest.mark.parametrize("shape", [(96, 96), (64, 130)])
def test_a_tile_meets_itself_as_smoothly_as_the_sample_is(shape: tuple[int, int]) -> None:
    sample = rough(*shape)
    texels = quilting.tile(sample)
    assert texels.shape[0] >= 0.74 * shape[0]
    assert texels.shape[1] >= 0.74 * shape[1]
    tiled = sample.reshape(-1, 2)[texels]
    for axis in (0, 1):
        inside = np.mean([steps(sample, axis, at) for at in range(1, shape[axis])])
        assert steps(tiled, axis, 0) < 1.6 * inside
        assert steps(sample, axis, 0) > 3 * inside  # the sample itself does not tile


def test_a_tile_of_a_regular_pattern_holds_whole_periods() -> None:
    pattern = weave(110, 12).astype("f4")[..., None]
    rows, columns = quilting.tile(pattern).shape
    assert rows % 24 == 0  # threads alternate: the pattern repeats after two periods of the weave's half wave
    assert columns % 24 == 0


@pytest.mark.parametrize("size", [150, (100, 170)])
def test_a_quilt_fills_its_size_and_tiles(size: int | tuple[int, int]) -> None:
    sample = rough(96, 80)
    texels = quilting.quilt(sample, size)
    assert texels.shape == ((size, size) if isinstance(size, int) else size)
    assert len(np.unique(texels)) > 0.4 * 96 * 80
    grown = sample.reshape(-1, 2)[texels]
    for axis in (0, 1):
        inside = np.mean([steps(sample, axis, at) for at in range(1, sample.shape[axis])])
        everywhere = [steps(grown, axis, at) for at in range(grown.shape[axis])]
        assert max(everywhere) < 2.2 * inside
        assert np.mean(everywhere) < 1.25 * inside
    np.testing.assert_array_equal(quilting.quilt(sample, size), texels)
    assert (quilting.quilt(sample, size, seed=1) != texels).any()


def test_all_pictures_get_the_same_texels() -> None:
    h = ShadingMap.from_images(photographs("cloth", 64), ACQUIRED)
    for grown in (h.tileable(), h.synthesise((80, 100))):
        where = {vector.tobytes() for vector in h.stack.vectors()}
        assert all(vector.tobytes() in where for vector in grown.stack.vectors())
        assert luminance(grown.picture(0.05)).mean() == pytest.approx(0.05, rel=1e-12)
        assert luminance(grown.picture(0.05)).std() == pytest.approx(luminance(h.picture(0.05)).std(), rel=0.15)


def test_what_tiles_continues_beyond_its_edges() -> None:
    h = ShadingMap.from_images(photographs("stone", 64), ACQUIRED).tileable()
    uv = RNG.random((200, 2))
    np.testing.assert_allclose(h.lookup(0.05, uv + np.array([1, -3])), h.lookup(0.05, uv), rtol=1e-9)
    edge = np.array([[1 - 1e-9, 0.4], [1e-9, 0.4], [0.7, 1 - 1e-9], [0.7, 1e-9]])
    left, right, top, bottom = h.lookup(0.05, edge)
    np.testing.assert_allclose(left, right, rtol=1e-6)
    np.testing.assert_allclose(top, bottom, rtol=1e-6)
    np.testing.assert_allclose(h.replaced(tiles=3).lookup(0.05, uv / 3), h.lookup(0.05, uv), rtol=1e-9)


def test_a_compressed_map_grows_too() -> None:
    h = ShadingMap.from_images(photographs("suede", 64), ACQUIRED)
    grown = h.compress().synthesise(96)
    assert grown.stack.bytes_per_texel == 6
    assert luminance(grown.picture(0.05)).mean() == pytest.approx(0.05, rel=1e-4)


def test_growing_sixteenfold_takes_seconds() -> None:
    sample = np.stack([noise(256, 4, 40, seed) for seed in range(3)], -1).astype("f4")
    quilting.quilt(sample, 256)
    start = time.process_time()
    quilting.quilt(sample, 1024)
    assert time.process_time() - start < 30


def test_bad_sizes() -> None:
    sample = rough(40, 40)
    with pytest.raises(ParameterError, match="a sample must be at least 16 x 16 to be continued, got 10 x 40"):
        quilting.tile(sample[:10])
    for size in (19, 20000, (30, 30, 30), 40.5, "large"):
        with pytest.raises(ParameterError, match=r"size must be one or two whole numbers in \[20, 16384\]"):
            quilting.quilt(sample, size)
