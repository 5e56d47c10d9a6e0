"""`brdf.fit`: what it recovers, chooses, reports and refuses."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import brdf
from brdf import io
from brdf.errors import BrdfError, ParameterError, ReflectanceError, UnknownNameError
from brdf.fit import LOSSES, Samples, data_of, samples_of
from brdf.fit.losses import LOSSES as SCALES
from brdf.fit.multistart import stratified
from brdf.fit.pictures import pixels
from brdf.fit.robust import rho
from brdf.fit.samples import from_rows
from brdf.fit.template import template_of
from brdf.metrics import METRICS, direction_pairs
from brdf.models import GGX, BlinnPhong, Lambertian, OpenPBR, SmoothDielectric, Ward
from helpers import random_directions

TRUTH = (Lambertian(albedo=(0.2, 0.3, 0.1)) + Ward(ks=(0.3, 0.2, 0.1), alpha=0.15)).named("truth")
VALUES = np.array([0.2, 0.3, 0.1, 0.3, 0.2, 0.1, 0.15])
FEW = stratified(samples_of(TRUTH), SCALES["l2"], 2000, 1)


def noisy(seed: int, noise: float = 0.05) -> Samples:
    factor = 1 + noise * np.random.default_rng(seed).standard_normal(FEW.values.shape)
    return Samples.of(FEW.wi, FEW.wo, FEW.values * factor, FEW.weight, name="noisy")


def test_known_parameters_lie_within_two_standard_errors() -> None:
    """95 % of normal errors do; the draws are few, so that one parameter may have less."""
    z = []
    for seed in range(40):
        r = brdf.fit(noisy(seed), Ward, budget="quick")
        z.append([(e.value - v) / e.error for e, v in zip(r.parameters, VALUES, strict=True)])
    inside = (np.abs(z) < 2).mean(0)
    assert inside.min() >= 0.85
    assert inside.mean() >= 0.92
    assert np.std(z) == pytest.approx(1, abs=0.15)


@pytest.mark.parametrize("metric", [*LOSSES, "image"])
def test_every_metric_finds_an_exact_model(metric: str) -> None:
    r = brdf.fit(TRUTH, Ward, metric=metric, budget="quick")
    np.testing.assert_allclose([e.value for e in r.parameters], VALUES, rtol=1e-3)
    assert set(r.errors) == {*METRICS, "image"}
    assert max(r.errors.values()) < 1e-3
    assert r.metric == metric


def test_each_loss_wins_in_its_own_metric() -> None:
    truth = GGX(alpha=0.3, F0=0.6) + Lambertian(albedo=0.1)
    results = {loss: brdf.fit(truth, Ward, metric=loss, budget="quick", grazing=60) for loss in LOSSES}
    for name in ("l2", "log", "cube-root"):
        own = results[name].errors[SCALES[name].metric]
        assert all(own <= r.errors[SCALES[name].metric] * (1 + 1e-4) for r in results.values()), name


def test_reported_metrics_are_those_of_the_samples() -> None:
    r = brdf.fit(noisy(0), Ward, budget="quick")
    samples = noisy(0)
    cosine = samples.wi[:, 2:]
    weight = samples.weight[:, 0] / samples.weight[:, 0].sum()
    fitted = r.reflectance(samples.wi, samples.wo)
    for name, metric in METRICS.items():
        assert r.errors[name] == pytest.approx(metric(samples.values * cosine, fitted * cosine, weight), rel=1e-6)
    assert "image" not in r.errors


def test_bic_chooses_the_number_of_lobes() -> None:
    truth = Lambertian(albedo=0.2) + Ward(ks=0.2, alpha=0.08) + Ward(ks=0.3, alpha=0.4)
    few = stratified(samples_of(truth), SCALES["l2"], 2000, 1)
    factor = 1 + 0.05 * np.random.default_rng(0).standard_normal(few.values.shape)
    r = brdf.fit(Samples.of(few.wi, few.wo, few.values * factor, few.weight), Ward, lobes="auto", budget="quick")
    assert r.lobes == 2
    assert sorted(e.value for e in r.parameters if e.name.endswith("alpha")) == pytest.approx([0.08, 0.4], rel=0.1)
    assert brdf.fit(noisy(1), Ward, lobes="auto", budget="quick").lobes == 1
    assert brdf.fit(noisy(1), "OrenNayar", lobes="auto", budget="quick").lobes == 1


def test_the_same_seed_gives_the_same_numbers() -> None:
    one, two = (brdf.fit(noisy(3), Ward, seed=5, budget=8) for _ in range(2))
    assert [e.value for e in one.parameters] == [e.value for e in two.parameters]
    assert one.seed == 5


def test_robust_losses_withstand_outliers() -> None:
    clean = noisy(0, 0.01)
    values = clean.values.copy()
    values[::20] *= 5
    spoiled = Samples.of(clean.wi, clean.wo, values, clean.weight)
    plain, robust = (brdf.fit(spoiled, Ward, robust=r, budget="quick") for r in (None, "cauchy"))
    errors = [np.abs(np.array([e.value for e in r.parameters]) / VALUES - 1).max() for r in (plain, robust)]
    assert errors[1] < 0.03 < errors[0]


def deviations(make: Callable[[int], Samples], draws: int, **options: Any) -> np.ndarray:
    """(draws, P) how far the numbers are from the truth, in their standard errors."""
    fits = [brdf.fit(make(seed), TRUTH, budget=1, **options) for seed in range(draws)]
    return np.array([[(e.value - v) / e.error for e, v in zip(r.parameters, VALUES, strict=True)] for r in fits])


@pytest.mark.parametrize("robust", ["cauchy", "huber", "soft_l1"])
def test_standard_errors_of_robust_fits_are_theirs(robust: str) -> None:
    """Outliers that hardly move the numbers do not widen their errors."""

    def spoiled(seed: int) -> Samples:
        some = noisy(seed)
        outliers = np.random.default_rng(seed).random(some.values.shape) < 0.03
        return Samples.of(some.wi, some.wo, some.values * np.where(outliers, 3, 1), some.weight)

    z = deviations(spoiled, 30, robust=robust)
    assert np.std(z, axis=0) == pytest.approx(1, abs=0.4)


def test_copies_of_a_channel_are_one_measurement() -> None:
    def monochrome(seed: int) -> Samples:
        factor = 1 + 0.05 * np.random.default_rng(seed).standard_normal(len(FEW))
        return Samples.of(FEW.wi, FEW.wo, FEW.values[:, 0] * factor, FEW.weight[:, 0])

    z = deviations(monochrome, 40)
    assert np.std(z[:, [0, 3, 6]], axis=0) == pytest.approx(1, abs=0.25)  # albedo_r, ks_r and the shared alpha


@pytest.mark.parametrize("count", [1, 2, 4])
def test_too_few_samples_determine_nothing(count: int) -> None:
    r = brdf.fit(Samples.of(*(a[:count] for a in (FEW.wi, FEW.wo, FEW.values))), GGX, budget=1)
    assert all(np.isinf(e.error) for e in r.parameters if e.state == "free")
    assert any("not determined" in w for w in r.warnings)
    assert "held" not in {e.state for e in r.parameters if "albedo" in e.name}


@pytest.mark.parametrize(
    ("values", "weight", "message"),
    [
        (FEW.values, np.ones(49), "do not fit"),
        (np.full(FEW.values.shape, "x"), 1.0, "samples are numbers"),
    ],
)
def test_samples_that_are_none(values: np.ndarray, weight: Any, message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        Samples.of(FEW.wi, FEW.wo, values, weight)


def test_holes_among_measured_rows_are_left_out() -> None:
    angles = np.random.default_rng(0).uniform(0, 1, (30, 4))
    spectra = np.ones((30, 5))
    spectra[3, 2], spectra[7] = -1, np.nan
    some = from_rows(angles, spectra, np.linspace(400, 700, 5), 80.0, "x", "y")
    assert (len(some), some.left_out) == (28, 2)


def test_what_is_held_keeps_its_value() -> None:
    start = Lambertian(albedo=(0.2, 0.3, 0.1)) + Ward()
    r = brdf.fit(noisy(0), start, fixed=["lobe1_albedo"], budget="quick")
    held = [e for e in r.parameters if e.name.startswith("lobe1_albedo")]
    assert [e.value for e in held] == [0.2, 0.3, 0.1]
    assert all(e.state == "held" and math.isnan(e.error) for e in held)


def test_a_normalisation_beside_a_scale_is_held() -> None:
    r = brdf.fit(brdf.load("gold-metallic-paint"), brdf.models.SGD, budget="quick")
    assert {e.name for e in r.parameters if e.state == "held"} == {"K_r", "K_g", "K_b"}
    assert r.errors["cosine-weighted L2"] < 0.01


def test_no_number_is_said_to_be_exact() -> None:
    """Of SGD's masking the data say next to nothing: rounding must not make that an error of zero."""
    truth = brdf.load("alum-bronze@bagher_sgd")
    few = stratified(samples_of(truth), SCALES["l2"], 4000, 1)
    factor = 1 + 0.05 * np.random.default_rng(8).standard_normal(few.values.shape)
    r = brdf.fit(Samples.of(few.wi, few.wo, few.values * factor, few.weight), truth, fixed=["K"], budget=1)
    errors = np.array([e.error for e in r.parameters if e.state == "free"])
    assert (errors > 1e-9).all()
    assert np.isinf(errors).any()


def test_a_weight_beside_a_colour_is_held() -> None:
    """Unless the colour is held already: then nothing stands for the weight."""
    truth = OpenPBR(base_color=(0.6, 0.3, 0.1), specular_roughness=0.4)
    fixed = ("coat_", "fuzz_", "specular_", "base_metalness", "base_diffuse")
    names = [name for name in truth.values if name.startswith(fixed)]
    r = brdf.fit(truth, truth.replaced(base_color=0.8), fixed=names, budget=1)
    values = {e.name: e for e in r.parameters}
    assert values["base_weight"].state == "held"
    np.testing.assert_allclose([values[f"base_color_{c}"].value for c in "rgb"], truth.base_color, atol=1e-3)
    r = brdf.fit(truth, truth.replaced(base_weight=0.5), fixed=[*names, "base_color"], budget=1)
    weight = next(e for e in r.parameters if e.name == "base_weight")
    assert weight.state != "held"
    assert abs(weight.value - 1) < 1e-3


def test_where_a_search_starts_does_not_decide_what_is_fitted() -> None:
    """A metal has no diffuse part, the model has."""
    assert template_of(OpenPBR(base_metalness=1.0)).values.keys() == OpenPBR().values.keys()


def test_what_the_data_do_not_show_is_said() -> None:
    """The highlight of a dull surface has no colour and no width."""
    r = brdf.fit(_dull(), Lambertian() + GGX(F0=0.0) * 0.0, fixed=["lobe2_base_F0"], budget="quick")
    alpha = next(e for e in r.parameters if e.name.endswith("alpha"))
    assert not alpha.error < 0.5 * alpha.value
    assert any("alpha" in w and "determined" in w for w in r.warnings)
    assert any("scale" in w for w in r.warnings)


def _dull() -> Samples:
    values = 0.1 * (1 + 0.02 * np.random.default_rng(0).standard_normal(FEW.values.shape))
    return Samples.of(FEW.wi, FEW.wo, values)


def test_anisotropic_data_get_two_widths() -> None:
    truth = Lambertian(albedo=0.1) + Ward(ks=0.4, alpha_x=0.1, alpha_y=0.3)
    r = brdf.fit(truth, Ward, budget="quick")
    found = {e.name: e.value for e in r.parameters}
    assert found["lobe2_alpha_x"] == pytest.approx(0.1, rel=1e-3)
    assert found["lobe2_alpha_y"] == pytest.approx(0.3, rel=1e-3)


def test_residuals_show_where_a_fit_is_off() -> None:
    r = brdf.fit(Lambertian(albedo=0.3) + BlinnPhong(ks=0.1, n=60.0), Lambertian, budget=1)
    assert r.residual_map.shape == (45, 45)
    highlight, elsewhere = r.residual_map[:20, :4], r.residual_map[:10, 25:30]
    assert np.nanmean(highlight) < -0.2 < np.nanmean(elsewhere)
    assert np.isnan(r.residual_map[44, 44])


def test_invalid_bins_are_masked(tmp_path: Path) -> None:
    values = brdf.representations.tables.merl.to_merl(TRUTH)
    holes = np.random.default_rng(0).random(values.shape[:3]) < 0.3
    values[holes] = -1
    table = brdf.representations.tables.merl.from_merl(values, "holes")
    samples = samples_of(table, 75)
    # bins on the very edge count either way, as single precision has it
    assert abs(len(samples) - np.count_nonzero((values >= 0).all(-1)) + _grazing(values)) < 500
    assert len(samples) + samples.left_out == values[..., 0].size
    r = brdf.fit(table, Ward, budget=2)
    np.testing.assert_allclose([e.value for e in r.parameters], VALUES, rtol=1e-3)


def _grazing(values: np.ndarray) -> int:
    """Measured bins of which a direction is beyond 75 degrees, by the table's own directions."""
    from brdf.representations.tables.merl import LAYOUT

    theta_h, theta_d, phi_d = LAYOUT.nodes()
    wi, wo = LAYOUT.basis.directions(theta_h, theta_d, phi_d[..., :-1])
    low = np.minimum(wi[..., 2], wo[..., 2]) < math.cos(math.radians(75))
    return int(np.count_nonzero(low & (values >= 0).all(-1)))


def test_rows_of_a_goniometer_are_fitted_as_measured(data: Path) -> None:
    path = data / "gonio" / "cornell" / "garnet_red.brdf"
    samples, m = data_of(path)
    assert len(samples) == 1439
    assert m is not None
    r = brdf.fit(path, Ward, budget="quick")
    assert r.samples == 1439
    assert r.data == "garnet_red"
    red, green, _ = (e.value for e in r.parameters[:3])
    assert red > 2 * green


@pytest.mark.parametrize("extension", [".alta", ".astm"])
def test_so_are_rows_of_astm_and_alta_text(extension: str, tmp_path: Path) -> None:
    path, model = tmp_path / f"m{extension}", Ward(ks=0.3, alpha=0.25)
    io.write(model, path)
    samples, m = data_of(path)
    assert m is not None
    assert len(samples) < 4000
    np.testing.assert_allclose(samples.values, model(samples.wi, samples.wo), rtol=1e-4, atol=1e-6)


def test_values_below_zero_in_rows_of_alta_text_are_left_out(tmp_path: Path) -> None:
    path = tmp_path / "m.alta"
    path.write_text("#DIM 2 1\n#PARAM_IN RUSIN_TH_TD\n0.1 0.2 0.5\n0.2 0.2 -1\n0.3 0.2 0.25\n")
    samples, _ = data_of(path)
    assert (len(samples), samples.left_out) == (2, 1)
    np.testing.assert_array_equal(samples.values[:, 0], [0.5, 0.25])


def test_the_image_metric_is_what_an_image_fit_is_judged_by() -> None:
    r = brdf.fit(brdf.load("chrome"), "Ward", metric="image", budget="quick")
    l2 = brdf.fit(brdf.load("chrome"), "Ward", budget="quick")
    assert r.errors["image"] < l2.errors["image"]
    assert r.cost == pytest.approx(1.5 * r.errors["image"] ** 2 * len(pixels().weight), rel=1e-3)
    count = 3 * len(pixels().weight)
    free = sum(e.state != "held" for e in r.parameters)
    assert r.bic == pytest.approx(count * math.log(r.errors["image"] ** 2) + free * math.log(count), rel=1e-3)


def test_errors_of_an_image_fit_are_those_of_its_pixels() -> None:
    truth = Lambertian(albedo=(0.2, 0.3, 0.1)) + Ward(ks=0.3, alpha=0.2)
    r = brdf.fit(truth, "Lambertian + Ward", metric="image", budget="quick")
    assert max(e.error / e.value for e in r.parameters) < 1e-4  # nothing is left over


@pytest.mark.parametrize("robust", ["soft_l1", "huber", "cauchy"])
def test_a_robust_loss_pulls_as_its_derivatives_say(robust: str) -> None:
    z = np.array([0.0, 0.3, 0.9, 1.2, 5.0, 40.0])
    at, first, second = rho(robust, z)
    step = 1e-6
    np.testing.assert_allclose((rho(robust, z + step)[0] - at) / step, first, rtol=1e-4)
    np.testing.assert_allclose((rho(robust, z + step)[1] - first) / step, second, rtol=1e-3, atol=1e-6)


def test_a_robust_fit_of_some_samples_is_that_of_all(monkeypatch: pytest.MonkeyPatch) -> None:
    wi, wo, weight = direction_pairs(24, 16, 20)
    rng = np.random.default_rng(0)
    values = (Lambertian(albedo=(0.2, 0.1, 0.3)) + Ward(ks=0.3, alpha=0.2))(wi, wo)
    values = values * (1 + 0.05 * rng.standard_normal(values.shape)) * np.where(rng.random((len(wi), 1)) < 0.1, 2, 1)
    some = Samples.of(wi, wo, values, weight)
    whole = brdf.fit(some, Ward, robust="huber", budget="quick")
    monkeypatch.setattr("brdf.fit.fitting.MOST", len(some) // 2)
    part = brdf.fit(some, Ward, robust="huber", budget="quick")
    for a, b in zip(whole.parameters, part.parameters, strict=True):
        assert abs(a.value - b.value) < 4 * a.error, a.name


def test_a_bound_below_zero_is_one() -> None:
    r = brdf.fit(brdf.models.LommelSeeliger(g=-0.95), brdf.models.LommelSeeliger, budget="quick")
    assert {e.name: e.state for e in r.parameters}["g"] == "at bound"


def test_a_single_wavelength_is_one_measurement() -> None:
    angles = np.random.default_rng(0).uniform(0, 1, (30, 4))
    assert from_rows(angles, np.linspace(0.1, 1, 30)[:, None], np.array([550.0]), 80.0, "x", "y").is_monochrome


def test_copied_channels_err_alike_and_are_not_exchangeable() -> None:
    r = brdf.fit(Lambertian(albedo=0.2) + GGX(alpha=0.3, F0=0.5), GGX, budget="quick")
    named = [warning.split(" (")[0] for warning in r.warnings if "exchangeable" in warning]
    assert named == [f"lobe2_scale_{c} and lobe2_base_F0_{c} are exchangeable" for c in "rgb"]


def test_more_light_than_arrives_is_warned_of() -> None:
    def warned(data: Any, model: Any) -> list[str]:
        return [w for w in brdf.fit(data, model, budget="quick").warnings if "reflects more than it receives" in w]

    assert warned(Lambertian(albedo=0.9), Lambertian) == []
    (warning,) = warned(Lambertian(albedo=0.9) + GGX(alpha=0.1, F0=1.0), "Lambertian + GGX")
    assert float(warning.split(", ")[1].split()[0]) == pytest.approx(1.9, abs=0.03)


def test_the_result_is_saved_as_a_material(tmp_path: Path) -> None:
    r = brdf.fit(noisy(0), Ward, budget="quick")
    r.save(tmp_path / "x.safetensors")
    again = brdf.load(str(tmp_path / "x.safetensors"))
    wi, wo = random_directions(50, 1), random_directions(50, 2)
    np.testing.assert_array_equal(again(wi, wo), r.reflectance(wi, wo))
    assert again.name == "noisy by Ward"
    assert "alpha" in r.table()
    assert json.loads(json.dumps(r.numbers()))["samples"] == len(FEW)


MISTAKES = [
    (TRUTH, {"model": "Wardd"}, UnknownNameError, "unknown model 'Wardd': did you mean 'Ward'"),
    (TRUTH, {"model": Ward, "metric": "l1"}, UnknownNameError, "unknown metric 'l1'"),
    (TRUTH, {"model": Ward, "lobes": 4}, ParameterError, "1 to 3 lobes, got 4"),
    (TRUTH, {"model": Ward, "lobes": "two"}, ParameterError, 'lobes must be 1 to 3 or "auto"'),
    (TRUTH, {"model": Ward, "budget": "huge"}, UnknownNameError, "unknown budget"),
    (TRUTH, {"model": Ward, "budget": 0}, ParameterError, "1 to 4096 searches"),
    (TRUTH, {"model": Ward, "robust": "l1"}, UnknownNameError, "unknown robust loss"),
    (TRUTH, {"model": Ward, "fixed": ["alfa"]}, UnknownNameError, "unknown parameter 'alfa'"),
    (TRUTH, {"model": Ward, "grazing": 95}, ParameterError, "(0, 90] degrees, got 95"),
    (TRUTH, {"model": Ward, "metric": "image", "robust": "huber"}, ParameterError, "no robust form"),
    (TRUTH, {"model": 3}, ParameterError, "a model, its class or its name"),
    (TRUTH, {"model": "Mirror"}, ReflectanceError, "mirrors"),
    (TRUTH, {"model": Ward, "seed": -1}, ParameterError, "whole number from 0"),
    (TRUTH, {"model": Ward, "budget": 2.5}, ParameterError, "1 to 4096 searches"),
    (TRUTH, {"model": TRUTH, "lobes": 2}, ParameterError, "lobes are of one model"),
    (TRUTH, {"model": "Disney", "lobes": 2}, ParameterError, "Disney is no lobe but a whole or a diffuse material"),
    (SmoothDielectric(), {"model": Ward}, ReflectanceError, "transmits"),
    (TRUTH, {"model": SmoothDielectric}, ReflectanceError, "no formula of reflection"),
    (3, {"model": Ward}, ParameterError, "a reflectance or Samples, got int"),
]


@pytest.mark.parametrize(("given", "options", "error", "message"), MISTAKES)
def test_mistakes_are_explained(given: object, options: dict, error: type[BrdfError], message: str) -> None:
    with pytest.raises(error) as caught:
        brdf.fit(given, **options)
    assert message in str(caught.value)


def test_samples_are_checked() -> None:
    w = random_directions(4, 1, 0.5)
    with pytest.raises(ParameterError, match=r"shape \(N, 3\)"):
        Samples.of(w, w[:3], np.ones(4))
    with pytest.raises(ParameterError, match="no valid value"):
        Samples.of(w, w, -np.ones(4))
    with pytest.raises(ParameterError, match="image metric needs a reflectance"):
        brdf.fit(Samples.of(w, w, np.ones(4)), Ward, metric="image")
    some = Samples.of(w, w, [1.0, np.nan, -1.0, 2.0])
    assert len(some) == 2
    assert some.left_out == 2
