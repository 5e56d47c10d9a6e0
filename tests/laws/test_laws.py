"""Each law fails what breaks it, passes what does not, and reports both."""

from __future__ import annotations

import json
from typing import Any, ClassVar

import numpy as np
import pytest

import brdf
from brdf import Reflectance, laws, models
from brdf.formula import Vec, floor
from brdf.geometry.sampling import CosineSampler, GGXSampler
from brdf.laws.cells import counted
from brdf.laws.sampling import chi_squared_p

LAWS = {law.name: law for law in laws.ALL}
GGX = models.GGX(alpha=0.2, F0=0.8)


class Given(Reflectance):
    """A reflectance from a function of two arrays of directions, with the sampler of the test's choice."""

    has_formula = False
    isotropic = True
    structure = ()

    def __init__(self, function: Any, sampler: Any = None) -> None:
        self._function, self._chosen = function, sampler

    def _evaluate_arrays(self, wi: Any, wo: Any, clamp: bool) -> Any:
        with np.errstate(all="ignore"):
            value = np.broadcast_to(np.asarray(self._function(wi, wo)), len(wi)).astype(wi.dtype)
        value = np.where((wi[:, 2] > 0) & (wo[:, 2] > 0), value, 0)
        return np.repeat((np.maximum(value, 0) if clamp else value)[:, None], 3, axis=1)

    def _make_sampler(self) -> Any:
        return self._chosen or super()._make_sampler()

    def _state(self) -> Any:
        raise NotImplementedError

    @classmethod
    def _restore(cls, header: Any, arrays: Any, children: Any) -> Any:
        raise NotImplementedError


class Scaled(GGXSampler):
    """The density is 5 % too large."""

    def pdf(self, wi: Any, wo: Any) -> Any:
        return 1.05 * super().pdf(wi, wo)


class Biased(GGXSampler):
    """One in twenty samples is drawn from another distribution."""

    def sample(self, wo: Any, u: Any) -> Any:
        wi, is_delta = super().sample(wo, u)
        other, _ = CosineSampler().sample(wo, u)
        return np.where(np.arange(len(wo))[:, None] % 20 == 0, other, wi), is_delta


class Turned(GGXSampler):
    """Samples are turned a little about the normal."""

    def sample(self, wo: Any, u: Any) -> Any:
        wi, is_delta = super().sample(wo, u)
        c, s = np.cos(0.02), np.sin(0.02)
        return np.stack([c * wi[:, 0] - s * wi[:, 1], s * wi[:, 0] + c * wi[:, 1], wi[:, 2]], -1), is_delta


class WrongWeight(type(GGX)):  # type: ignore[misc]
    """The cosine is missing from the weight."""

    def sample(self, wo: Any, u: Any) -> Any:
        drawn = super().sample(wo, u)
        cosine = np.where(drawn.pdf > 0, drawn.wi[..., 2], 1)
        return drawn._replace(weight=drawn.weight / cosine[..., None])


def ggx(wi: Any, wo: Any) -> Any:
    return GGX(wi, wo)[:, 0]


class FormulaBelowZero(models.Lambertian):
    """A formula that goes below zero; the call clamps it."""

    def f(self, wi: Any, wo: Any) -> Any:
        return self.albedo * (wi.z * wo.z - 1e-3)


class FormulaNotReciprocal(models.Lambertian):
    """Off by 1e-4 or less."""

    def f(self, wi: Any, wo: Any) -> Any:
        return self.albedo * (1 - 1e-4 * wi.z)


class Leaking(models.Lambertian):
    """Promises to lose nothing and loses a hundredth."""

    def f(self, wi: Any, wo: Any) -> Any:
        return self.albedo * (0.99 / np.pi)


class WrongSlope(models.Lambertian):
    """Its lookup jumps with the parameter: no slope of a linear interpolation says so."""

    def f(self, wi: Any, wo: Any) -> Any:
        return Vec(*(floor(c * 1e7) * 1e-7 for c in self.albedo)) * (wi.z + 1.0)


for _helper in (Leaking, WrongSlope, WrongWeight, FormulaBelowZero, FormulaNotReciprocal):
    models.model.REGISTRY.pop(_helper.__name__)

BROKEN: dict[str, tuple[str, Reflectance]] = {
    "a formula below zero": ("positivity", FormulaBelowZero()),
    "infinite at grazing": ("positivity", Given(lambda wi, wo: 1 / np.maximum(wi[:, 2] - 1e-5, 0))),
    "no number at the normal": ("positivity", Given(lambda wi, wo: np.log(1 - wi[:, 2]) * 0 + 1)),
    "not a number in float32": ("positivity", Given(lambda wi, wo: 1 / (wi[:, 2] * 1e-34) * 1e-34)),
    "a formula that tells wi from wo": ("reciprocity", FormulaNotReciprocal()),
    "data that tell wi from wo": ("reciprocity", Given(lambda wi, wo: 0.3 * wi[:, 2] ** 3)),
    "a leak in the furnace": ("furnace", Leaking()),
    "steps where a slope should be": ("gradients", WrongSlope(albedo=0.123)),
    "an azimuth at the normal": ("pole", Given(lambda wi, wo: 1 + 0.5 * np.cos(np.arctan2(wo[:, 1], wo[:, 0])))),
    "another value at the normal": ("pole", Given(lambda wi, wo: np.where(wo[:, 0] == 0, 0.5, 0.4) + 0 * wi[:, 0])),
    "more radiosity than irradiance": ("hemispherical", Given(lambda wi, wo: 1.02 / np.pi)),
    "albedo 1.02": ("energy", Given(lambda wi, wo: 1.02 / np.pi)),
    "gains at grazing": ("energy", Given(lambda wi, wo: 0.1 / np.maximum(wo[:, 2], 1e-9))),
    "density 5 % too large": ("sampling", Given(ggx, Scaled(0.2, 0.2))),
    "density over 1": ("density", Given(ggx, Scaled(0.2, 0.2))),
    "one sample in 20 from elsewhere": ("sampling", Given(ggx, Biased(0.2, 0.2))),
    "samples turned by a degree": ("sampling", Given(ggx, Turned(0.2, 0.2))),
    "no cosine in the weight": ("weight", WrongWeight(alpha=0.2)),
    "a groove declared isotropic": ("isotropy", Given(lambda wi, wo: 0.2 * (1 + 0.01 * wi[:, 0] * wo[:, 0]))),
}


@pytest.mark.parametrize("case", BROKEN)
def test_a_breach_is_found(case: str) -> None:
    name, reflectance = BROKEN[case]
    result = LAWS[name](reflectance)
    assert result.status == "breaks", result
    assert name == "sampling" or result.value > result.limit


def test_the_darkest_texels_of_a_stack_lie_at_a_kink() -> None:
    stack = brdf.SliceStack.bake(brdf.load("steel"))
    assert LAWS["gradients"](stack).value < 1e-5


def test_every_law_has_a_reflectance_that_breaks_it() -> None:
    assert {name for name, _ in BROKEN.values()} == set(LAWS)


@pytest.mark.parametrize("law", laws.ALL, ids=lambda law: law.name)
def test_the_unbroken_twin_obeys(law: laws.Law) -> None:
    result = law(Given(ggx, GGXSampler(0.2, 0.2)))
    assert result.status == "holds", result


def test_measured_values_below_zero_are_counted_not_held_against_it() -> None:
    result = LAWS["positivity"](Given(lambda wi, wo: wi[:, 2] * wo[:, 2] - 0.01))
    assert result.passed
    assert "raw values below zero, the lowest -0.01" in result.note


def test_data_may_be_a_fifth_from_reciprocal() -> None:
    result = LAWS["reciprocity"](Given(lambda wi, wo: 0.3 + 0.02 * wi[:, 0]))
    assert result.passed
    assert 1e-3 < result.value < 0.2 == result.limit


def test_anisotropy_is_measured_without_a_limit_where_it_is_declared() -> None:
    result = LAWS["isotropy"](models.GGX(alpha_x=0.1, alpha_y=0.3))
    assert result.passed
    assert result.value > 0.1
    assert result.note == "declared anisotropic"


class Confessing(Given):
    breaks: ClassVar = {"energy": "made to [Nobody1900]"}


def test_a_declared_breach_is_marked_and_passes_also_within_a_sum() -> None:
    honest = Confessing(lambda wi, wo: 1.2 / np.pi)
    for reflectance in (honest, honest + models.Lambertian()):
        report = laws.check(reflectance, [LAWS["energy"], LAWS["positivity"]])
        assert report["energy"].status == "declared"
        assert report.passed
        assert "made to [Nobody1900]" in str(report)


def test_report_prints_and_serialises() -> None:
    report = laws.check(Given(lambda wi, wo: 1.2 / np.pi).named("[bright] paint"), [LAWS["energy"]])
    assert not report.passed
    text = str(report)
    assert "[bright] paint" in text
    assert "breaks" in text
    again = json.loads(report.to_json())
    assert again["name"] == "[bright] paint"
    assert again["passed"] is False
    (result,) = again["results"]
    assert (result["law"], result["status"]) == ("energy", "breaks")
    assert result["value"] == pytest.approx(1.2, abs=1e-3)


def test_names_of_declared_breaches_are_laws() -> None:
    for name in models.names():
        assert set(models.get(name).breaks) <= set(LAWS), name


@pytest.mark.parametrize("alpha", [0.002, 0.05, 0.8])
def test_cells_integrate_densities_of_any_width(alpha: float) -> None:
    sampler, wo = GGXSampler(alpha, alpha), np.array([0.0, 0.0, 1.0])
    u = np.random.default_rng(1).random((20_000, 2))
    view = np.broadcast_to(wo, (len(u), 3))
    wi, _ = sampler.sample(view, u)
    cells = counted(lambda w: sampler.pdf(w, np.broadcast_to(wo, w.shape)), wi, 0.0)
    # seen from the normal, half vectors within 45 degrees mirror above the horizon: their share of D cos is closed
    exact = 1 / (1 + alpha**2)
    assert cells.probability.sum() == pytest.approx(exact, abs=5 * cells.error + 1e-4)
    assert cells.error < 3e-3
    assert cells.counts.sum() == np.sum(wi[:, 2] > 0)
    assert len(cells.counts) > 200


def test_p_values_of_a_true_hypothesis_are_uniform() -> None:
    rng = np.random.default_rng(5)
    probability = rng.dirichlet(np.full(50, 0.5))
    p = np.sort([chi_squared_p(2000 * probability, rng.multinomial(2000, probability)) for _ in range(400)])
    assert np.abs(p - (np.arange(400) + 0.5) / 400).max() < 1.63 / 20  # Kolmogorov-Smirnov at 1 %


def test_p_value_is_zero_where_the_impossible_happened() -> None:
    assert chi_squared_p(np.array([0.0, 0.0]), np.array([1.0, 0.0])) == 0
