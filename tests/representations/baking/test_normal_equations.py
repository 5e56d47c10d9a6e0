"""Normal equations on grids, against dense matrices."""

from __future__ import annotations

import functools
import math

import numpy as np
import pytest

from brdf.representations.baking import normal_equations as ne

CASES = [((4, 3, 2), (False, False, False)), ((3, 2, 4, 3), (True, False, False, False))]


@pytest.fixture(params=CASES, ids=["three axes", "a circle and three axes"])
def problem(request):
    shape, periodic = request.param
    rng = np.random.default_rng(5)
    axes = [
        ne.hats(rng.random(3 * n) * (n if around else n - 1), n, around)
        for n, around in zip(shape, periodic, strict=True)
    ]
    weights = rng.random((2, *(len(axis) for axis in axes)))
    dense = functools.reduce(np.kron, axes)
    return shape, periodic, axes, weights, dense


def test_hats_interpolate_linearly():
    nodes = np.array([1.0, 5.0, 2.0])
    np.testing.assert_allclose(ne.hats(np.array([0.0, 0.25, 1.5, 2.0]), 3, False) @ nodes, [1, 2, 3.5, 2])
    np.testing.assert_allclose(ne.hats(np.array([2.0, 2.5, 3.0]), 3, True) @ nodes, [2, 1.5, 1])


def test_interpolation_and_its_transpose(problem):
    shape, _, axes, weights, dense = problem
    nodes = np.random.default_rng(6).random((2, *shape))
    np.testing.assert_allclose(ne.interpolate(nodes, axes).reshape(2, -1), nodes.reshape(2, -1) @ dense.T, rtol=1e-6)
    np.testing.assert_allclose(ne.gather(weights, axes).reshape(2, -1), weights.reshape(2, -1) @ dense, rtol=1e-5)


def test_normal_matrix(problem):
    shape, periodic, axes, weights, dense = problem
    stencil = ne.normal_matrix(weights, axes, periodic)
    x = np.random.default_rng(7).random((2, *shape))
    for channel in range(2):
        matrix = dense.T @ (weights[channel].reshape(-1, 1) * dense)
        np.testing.assert_allclose(ne.multiply(stencil, x)[channel].ravel(), matrix @ x[channel].ravel(), rtol=1e-5)


def test_solution_with_a_penalty(problem):
    shape, periodic, axes, weights, dense = problem
    smooth = ne.difference_penalty(shape, periodic)
    stencil = ne.add(ne.normal_matrix(weights, axes, periodic), smooth, np.array([0.1, 0.2]))
    right = np.random.default_rng(8).random((2, *shape))
    solution = ne.solve(stencil, right, 300)
    assert np.abs(ne.multiply(stencil, solution) - right).max() < 1e-4 * np.abs(right).max()
    for channel, scale in enumerate((0.1, 0.2)):
        size = math.prod(shape)
        identity = np.eye(size).reshape(size, *shape)
        penalty = np.stack([ne.multiply(smooth, unit[None])[0].ravel() for unit in identity])
        matrix = dense.T @ (weights[channel].reshape(-1, 1) * dense) + scale * penalty
        exact = np.linalg.solve(matrix, right[channel].ravel())
        np.testing.assert_allclose(solution[channel].ravel(), exact, atol=1e-3 * np.abs(exact).max())


def test_penalty_is_the_sum_of_squared_differences(problem):
    shape, periodic, *_ = problem
    x = np.random.default_rng(9).random((1, *shape))
    expected = sum(
        float(np.sum(np.diff(x, axis=k, **({"append": x.take([0], k)} if around else {})) ** 2))
        for k, around in enumerate(periodic, start=1)
    )
    assert np.sum(x * ne.multiply(ne.difference_penalty(shape, periodic), x)) == pytest.approx(expected)
