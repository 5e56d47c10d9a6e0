"""Quadratic problems within bounds against SciPy's bounded least squares."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import lsq_linear

from brdf.fit.bounded import minimise_quadratic


@pytest.mark.parametrize("seed", range(20))
def test_the_minimum_is_that_of_scipy(seed: int) -> None:
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 9))
    J, r = rng.standard_normal((30, n)) * 10.0 ** rng.uniform(-3, 3, n), rng.standard_normal(30)
    low, high = -rng.uniform(0, 1, n), rng.uniform(0, 1, n)
    low[rng.random(n) < 0.3] = 0.0
    expected = lsq_linear(J, -r, (low, np.maximum(high, low + 1e-9)), method="bvls", tol=1e-14)
    step = minimise_quadratic(J.T @ J, J.T @ r, low, np.maximum(high, low + 1e-9))
    assert np.all((step >= low) & (step <= np.maximum(high, low + 1e-9)))
    assert 0.5 * np.sum((J @ step + r) ** 2) == pytest.approx(expected.cost, rel=1e-10)


def test_without_bounds_it_is_the_solution() -> None:
    H, g, free = np.array([[4.0, 1.0], [1.0, 3.0]]), np.array([1.0, 2.0]), np.full(2, np.inf)
    np.testing.assert_allclose(minimise_quadratic(H, g, -free, free), -np.linalg.solve(H, g), rtol=1e-14)


def test_nothing_moves_along_what_has_no_curvature() -> None:
    H = np.array([[1.0, 1.0], [1.0, 1.0]])
    step = minimise_quadratic(H, np.array([-2.0, -2.0]), np.full(2, -5.0), np.full(2, 10.0))
    np.testing.assert_allclose(step.sum(), 2.0)
    assert abs(step[0] - step[1]) < 1e-6


def test_what_is_silent_stays_and_overflows_nothing() -> None:
    """As a Schur complement leaves it: no curvature but for rounding, and a coupling."""
    H = np.array([[1e12, 1e-2], [1e-2, 1e-311]])
    with np.errstate(over="raise", invalid="raise", divide="raise"):
        step = minimise_quadratic(H, np.array([-1e12, 0.0]), np.full(2, -2.0), np.full(2, 2.0))
    np.testing.assert_allclose(step, [1.0, 0.0], atol=1e-9)
