"""Normal equations: the generated kernel, the graph on NumPy, and differences of the public call agree."""

from __future__ import annotations

import numpy as np
import pytest

import brdf
from brdf.fit import equations
from brdf.fit.equations import Equations
from brdf.fit.losses import LOSSES
from brdf.fit.parameters import components, grouped, with_values
from brdf.fit.samples import Samples
from brdf.fit.template import template_of
from brdf.models import GGX, EnergyCompensated, Lambertian, Microfacet, Ward
from helpers import random_directions

COUNT = 1500  # two blocks and a part of one
RNG = np.random.default_rng(2)
SAMPLES = Samples.of(
    random_directions(COUNT, 1, 0.2),
    random_directions(COUNT, 2, 0.2),
    RNG.uniform(0.01, 2.0, (COUNT, 3)),
    RNG.uniform(0.1, 1.0, (COUNT, 3)),
)
MODEL = Lambertian(albedo=(0.2, 0.3, 0.4)) + 0.5 * GGX(alpha=0.3, F0=(0.1, 0.2, 0.3))
NUMBERS = np.array([c.default for c in components(MODEL)])


def residuals(numbers: np.ndarray, loss: str) -> np.ndarray:
    """Straight from the public call."""
    scale = LOSSES[loss].scale
    f = with_values(MODEL, grouped(numbers, components(MODEL)))(SAMPLES.wi.astype(float), SAMPLES.wo.astype(float))
    cosine = SAMPLES.wi[:, 2:].astype(float)
    return (np.sqrt(SAMPLES.weight) * (scale(f * cosine) - scale(SAMPLES.values * cosine))).ravel()


@pytest.mark.parametrize("loss", LOSSES)
def test_cost_and_derivatives_are_those_of_the_public_call(loss: str) -> None:
    equations = Equations(MODEL, SAMPLES, LOSSES[loss], "float64")
    normal = equations(NUMBERS)
    r = residuals(NUMBERS, loss)
    assert normal.cost == pytest.approx(0.5 * np.sum(r**2), rel=1e-6)
    J = []
    for k, x in enumerate(NUMBERS):
        step = 1e-6 * max(x, 0.1)
        ends = (residuals(NUMBERS + side * step * (np.arange(len(NUMBERS)) == k), loss) for side in (1, -1))
        J.append(np.subtract(*ends) / (2 * step))
    J = np.array(J)
    np.testing.assert_allclose(normal.gradient, J @ r, rtol=1e-4, atol=1e-6 * np.abs(J @ r).max())
    np.testing.assert_allclose(normal.hessian, J @ J.T, rtol=1e-4, atol=1e-6 * np.abs(J @ J.T).max())


COMPILED = {
    "a sum": MODEL,
    "a table that a colour scales": brdf.models.KelemenDiffuse(),
    "a table that follows from the numbers": EnergyCompensated(Microfacet(alpha=0.4)),
    "tables that the numbers look up": brdf.models.OpenPBR(coat_weight=0.6, coat_roughness=0.3, fuzz_weight=0.3),
}


@pytest.mark.parametrize("kind", COMPILED)
def test_kernel_and_numpy_agree(kind: str) -> None:
    m, loss = COMPILED[kind], LOSSES["l2"]
    numbers = np.array([c.default for c in components(m)])
    exact = Equations(m, SAMPLES, loss, "float64")
    for real, tolerance in (("float64", 1e-12), ("float32", 1e-5)):
        normal = Equations(m, SAMPLES, loss, real)(numbers)
        total = np.zeros_like(normal.hessian)
        for channel, rows in enumerate(exact.rows_at(numbers)):
            ids = list(exact.active(channel))
            total[np.ix_(ids, ids)] += rows[:-1] @ rows[:-1].T
        np.testing.assert_allclose(normal.hessian, total, rtol=tolerance, atol=tolerance * np.abs(total).max())


def test_what_is_too_large_is_evaluated_with_numpy(monkeypatch: pytest.MonkeyPatch) -> None:
    compiled = Equations(MODEL, SAMPLES, LOSSES["l2"], "float64")(NUMBERS)
    monkeypatch.setattr(equations, "LARGEST_COMPILED", 10)
    monkeypatch.setattr(equations, "_kernel", None)
    for found, expected in zip(Equations(MODEL, SAMPLES, LOSSES["l2"])(NUMBERS), compiled, strict=True):
        np.testing.assert_allclose(found, expected, rtol=1e-10, atol=1e-10 * np.abs(expected).max())


FITTABLE = [
    name for name in brdf.models.names() if brdf.models.get(name)().values and not brdf.models.get(name)().has_delta
]


@pytest.mark.parametrize("name", FITTABLE)
def test_every_parametric_model_has_derivatives_within_its_bounds(name: str) -> None:
    m = template_of(name)
    all_components = components(m)
    numbers = np.array([c.default for c in all_components])
    rows = Equations(m, SAMPLES[:64], LOSSES["l2"], "float64").rows_at(numbers)
    assert all(np.isfinite(r).all() for r in rows)
    same = with_values(m, grouped(numbers, all_components))
    np.testing.assert_array_equal(same(SAMPLES.wi, SAMPLES.wo), m(SAMPLES.wi, SAMPLES.wo))
    for c in all_components:
        low, high = c.start_range
        assert c.low <= c.to_value(low) < c.to_value(high) <= c.high, c
        assert c.to_value(c.to_coordinate(c.default)) == pytest.approx(c.default), c


def test_colours_that_f_is_linear_in_are_found() -> None:
    def linear(m: object) -> set[str]:
        return {c.parameter for c in components(m) if c.is_linear}

    assert linear(Lambertian() + 0.5 * GGX()) == {"lobe1_albedo", "lobe2_scale"}
    assert linear(GGX()) == {"F0"}
    assert linear(brdf.models.SGD()) == {"kd", "ks"}
    assert linear(Lambertian() + Ward() + Ward()) == {"lobe1_albedo", "lobe2_ks", "lobe3_ks"}


@pytest.mark.parametrize("loss", LOSSES)
def test_slopes_are_those_of_the_scales(loss: str) -> None:
    v = np.geomspace(1e-4, 1e3, 50)
    numeric = (LOSSES[loss].scale(v * (1 + 1e-6)) - LOSSES[loss].scale(v * (1 - 1e-6))) / (2e-6 * v)
    np.testing.assert_allclose(LOSSES[loss].slope(v), numeric, rtol=1e-6)
