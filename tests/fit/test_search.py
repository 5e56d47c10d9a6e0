"""Searches: truths are found again, minima are those of SciPy and of a global optimiser, results do not vary."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import differential_evolution, least_squares, nnls

import brdf
from brdf.fit.equations import Equations, Normal
from brdf.fit.levenberg import Problem, advance, begin
from brdf.fit.losses import LOSSES
from brdf.fit.multistart import energy_of, run_rounds, same, start_points, stratified
from brdf.fit.parameters import components, grouped, with_values
from brdf.fit.samples import Samples, samples_of
from brdf.models import GGX, BlinnPhong, Lambertian, Ward

TRUTH = Lambertian(albedo=(0.2, 0.3, 0.1)) + Ward(ks=(0.3, 0.2, 0.1), alpha=0.15)
MODEL = Lambertian() + Ward()


def noisy(m: object, count: int = 3000, noise: float = 0.05, seed: int = 0) -> Samples:
    few = stratified(samples_of(m), LOSSES["l2"], count, 1)
    factor = 1 + noise * np.random.default_rng(seed).standard_normal(few.values.shape)
    return Samples.of(few.wi, few.wo, few.values * factor, few.weight, name="noisy")


def problem_of(m: object, linear: bool = True) -> Problem:
    found = components(m)
    return Problem(found, np.ones(len(found), bool), np.array([c.is_linear and linear for c in found]))


def solved(
    m: object, samples: Samples, loss: str = "l2", linear: bool = True, starts: int = 8
) -> tuple[np.ndarray, float]:
    problem, equations = problem_of(m, linear), Equations(m, samples, LOSSES[loss], "float64")
    searches = run_rounds(problem, equations, start_points(problem.components, problem.free, starts, 0))
    best = advance(problem, equations, searches[0], 100, 1e-12)
    return best.numbers, best.cost


def residuals(samples: Samples, m: object, numbers: np.ndarray, loss: str) -> np.ndarray:
    f = with_values(m, grouped(numbers, components(m)))(samples.wi.astype(float), samples.wo.astype(float))
    cosine, scale = samples.wi[:, 2:].astype(float), LOSSES[loss].scale
    return (np.sqrt(samples.weight) * (scale(f * cosine) - scale(samples.values * cosine))).ravel()


@pytest.mark.parametrize("loss", LOSSES)
def test_the_minimum_is_that_of_scipy(loss: str) -> None:
    samples = noisy(TRUTH)
    numbers, cost = solved(MODEL, samples, loss, linear=loss == "l2")
    low, high = (np.array([getattr(c, side) for c in components(MODEL)]) for side in ("low", "high"))
    start = np.array([0.2, 0.2, 0.2, 0.2, 0.2, 0.2, 0.2])
    expected = least_squares(
        lambda x: residuals(samples, MODEL, x, loss), start, bounds=(low, high), xtol=1e-12, ftol=1e-12, gtol=1e-12
    )
    assert cost == pytest.approx(expected.cost, rel=1e-6)
    np.testing.assert_allclose(numbers, expected.x, rtol=2e-3, atol=1e-4)


def test_a_search_does_not_go_where_derivatives_overflow() -> None:
    """Their equations there are those of a steeper and steeper wall; the search turns back before it."""
    problem = replace(problem_of(BlinnPhong(), linear=False), free=np.array([False, False, False, True]))
    start = np.array([c.default for c in problem.components])
    wall = 2 * start[3]

    def evaluate(numbers: np.ndarray) -> Normal:
        x, steep = numbers[3], np.inf if numbers[3] > wall else 1e-6
        return Normal(1 / x, np.array([0, 0, 0, -1 / x**2]), np.diag([0, 0, 0, steep]))

    search = advance(problem, evaluate, begin(problem, evaluate, start), 50)
    assert start[3] < search.numbers[3] <= wall


def test_the_minimum_is_that_of_a_global_optimiser() -> None:
    """Differential evolution over both widths, colours by SciPy's non-negative least squares."""
    truth = Lambertian(albedo=0.2) + Ward(ks=0.3, alpha=0.1) + Ward(ks=0.4, alpha=0.4)
    model = Lambertian() + Ward() + Ward()
    samples = noisy(truth, 600)
    root = np.sqrt(samples.weight[:, 0]) * samples.wi[:, 2]

    def cost(widths: np.ndarray) -> float:
        lobes = [Ward(ks=1.0, alpha=math.exp(w))(samples.wi, samples.wo)[:, 0] for w in widths]
        A = np.stack([np.full(len(root), 1 / math.pi), *lobes], -1) * root[:, None]
        return sum(0.5 * nnls(A, root * samples.values[:, c])[1] ** 2 for c in range(3))

    bounds = [(math.log(0.01), 0.0)] * 2
    expected = differential_evolution(cost, bounds, rng=0, maxiter=40, popsize=8, tol=1e-10)
    _, found = solved(model, samples)
    assert found == pytest.approx(expected.fun, rel=1e-5)


def test_linear_numbers_end_where_all_are_searched_for() -> None:
    samples = noisy(TRUTH)
    (projected, cost), (joint, other) = (solved(MODEL, samples, "l2", linear) for linear in (True, False))
    assert cost == pytest.approx(other, rel=1e-8)
    np.testing.assert_allclose(projected, joint, rtol=1e-4)


def test_projection_takes_fewer_steps() -> None:
    samples = noisy(TRUTH)
    steps = []
    for linear in (True, False):
        problem, equations = problem_of(MODEL, linear), Equations(MODEL, samples, LOSSES["l2"], "float64")
        start = start_points(problem.components, problem.free, 8, 0)[3]
        steps.append(advance(problem, equations, begin(problem, equations, start), 100).steps)
    assert steps[0] < steps[1]


def test_exact_data_are_fitted_exactly() -> None:
    for truth, model in ((TRUTH, MODEL), (0.3 * Lambertian(albedo=0.5) + BlinnPhong(ks=0.2, n=80.0), None)):
        m = truth if model is None else model
        numbers, cost = solved(m, noisy(truth, noise=0.0))
        assert cost < 1e-9 * energy_of(noisy(truth, noise=0.0))
        made = with_values(m, grouped(numbers, components(m)))
        samples = noisy(truth, 200, 0.0)
        np.testing.assert_allclose(made(samples.wi, samples.wo), samples.values, rtol=1e-3)


def test_sums_over_stratified_samples_estimate_those_over_all() -> None:
    everything = samples_of(TRUTH)
    few = stratified(everything, LOSSES["l2"], 10_000, 0)
    assert 7000 < len(few) <= 10_000
    model = Lambertian(albedo=0.4) + Ward(alpha=0.2)
    costs = [
        np.sum(residuals(s, model, np.array([c.default for c in components(model)]), "l2") ** 2)
        for s in (everything, few)
    ]
    assert costs[1] == pytest.approx(costs[0], rel=0.02)
    assert stratified(few, LOSSES["l2"], 10_000, 0) is few


def test_starts_are_a_sequence_of_the_seed() -> None:
    problem = problem_of(brdf.models.SGD())
    one, two, other = (start_points(problem.components, problem.free, 16, seed) for seed in (1, 1, 2))
    assert len(one) == 16
    np.testing.assert_array_equal(one, two)
    assert not np.array_equal(one, other)
    low, high = (np.array([getattr(c, side) for c in problem.components]) for side in ("low", "high"))
    assert all(((low <= point) & (point <= high)).all() for point in one)


def test_costs_are_told_apart_above_rounding() -> None:
    assert same(1.0005, 1.0, 1.0)
    assert not same(1.1, 1.0, 1.0)
    assert same(1e-12, 1e-13, 1.0)


def test_a_start_that_is_no_number_is_given_up() -> None:
    problem, samples = problem_of(MODEL), noisy(TRUTH, 300)
    equations = Equations(MODEL, samples, LOSSES["l2"], "float64")
    numbers = np.array([c.default for c in problem.components])
    numbers[-1] = np.nan
    assert begin(problem, equations, numbers).done
    assert len(run_rounds(problem, equations, [numbers])) == 0
    assert GGX().values  # the model of the other tests stays as it was
