"""Sums, scaled reflectances and mixtures."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import brdf
from brdf.combinators import Scaled, Sum
from brdf.errors import ParameterError
from brdf.models import GGX, Lambertian, OrenNayar
from brdf.reflectance import Reflectance
from lobes import direction, random_pairs

DIFFUSE, GLOSSY, ROUGH = Lambertian(albedo=(0.2, 0.5, 0.7)), GGX(alpha=0.3, F0=0.8), OrenNayar(sigma=0.6)
PAIRS = random_pairs(500)


def test_sum_adds_values() -> None:
    np.testing.assert_allclose((DIFFUSE + GLOSSY)(*PAIRS), DIFFUSE(*PAIRS) + GLOSSY(*PAIRS), rtol=1e-14)


def test_sums_are_flat_and_keep_equal_lobes_apart() -> None:
    total = DIFFUSE + GLOSSY + (ROUGH + DIFFUSE)
    assert isinstance(total, Sum)
    assert list(total.children) == ["lobe1", "lobe2", "lobe3", "lobe4"]
    np.testing.assert_allclose(total(*PAIRS), 2 * DIFFUSE(*PAIRS) + GLOSSY(*PAIRS) + ROUGH(*PAIRS), rtol=1e-13)
    assert total.name == "Lambertian + GGX + OrenNayar + Lambertian"
    assert {"lobe1_albedo", "lobe2_alpha", "lobe3_sigma", "lobe4_albedo"} <= set(total.values)


def test_scale_by_number_and_colour() -> None:
    np.testing.assert_allclose((0.5 * GLOSSY)(*PAIRS), 0.5 * GLOSSY(*PAIRS), rtol=1e-14)
    np.testing.assert_allclose((GLOSSY * (0.1, 0.2, 3.0))(*PAIRS), GLOSSY(*PAIRS) * [0.1, 0.2, 3.0], rtol=1e-14)
    tint = np.array([0.1, 0.2, 0.3])
    assert isinstance(GLOSSY * tint, Scaled)


def test_scales_multiply() -> None:
    twice = (0.5, 1.0, 2.0) * (0.5 * GLOSSY)
    assert isinstance(twice, Scaled)
    assert twice.children["base"] is GLOSSY
    np.testing.assert_allclose(twice.scale, [0.25, 0.5, 1.0])


def test_scaled_sum_and_sum_of_scaled() -> None:
    a, b = 0.5 * (DIFFUSE + GLOSSY), 0.5 * DIFFUSE + 0.5 * GLOSSY
    np.testing.assert_allclose(a(*PAIRS), b(*PAIRS), rtol=1e-13)


@pytest.mark.parametrize("t", [0.0, 0.25, 1.0])
def test_mix(t: float) -> None:
    mixed = brdf.mix(DIFFUSE, GLOSSY, t)
    np.testing.assert_allclose(mixed(*PAIRS), (1 - t) * DIFFUSE(*PAIRS) + t * GLOSSY(*PAIRS), rtol=1e-13)


@pytest.mark.parametrize("t", [-0.1, 1.1, float("nan")])
def test_mix_refuses_shares_outside_0_to_1(t: float) -> None:
    with pytest.raises(ParameterError):
        brdf.mix(DIFFUSE, GLOSSY, t)


def test_negative_scale_is_refused() -> None:
    with pytest.raises(ParameterError, match=r"^scale must lie in \[0, inf\), got -1$"):
        _ = -1 * DIFFUSE


def test_adding_something_else_is_a_type_error() -> None:
    with pytest.raises(TypeError, match="unsupported operand"):
        _ = DIFFUSE + 1


def test_single_precision_stays() -> None:
    wi, wo = (w.astype(np.float32) for w in PAIRS)
    total = 0.3 * DIFFUSE + GLOSSY
    assert total(wi, wo).dtype == np.float32
    np.testing.assert_allclose(total(wi, wo), total(wi.astype(float), wo.astype(float)), rtol=1e-5)


def test_below_the_horizon_is_dark() -> None:
    down = direction(100)
    assert ((0.5 * DIFFUSE + GLOSSY)(down, direction(0)) == 0).all()
    assert ((0.5 * DIFFUSE + GLOSSY)(direction(0), down) == 0).all()


def test_isotropy() -> None:
    assert (DIFFUSE + GLOSSY).isotropic
    assert not (DIFFUSE + 0.5 * GGX(alpha_x=0.1, alpha_y=0.2)).isotropic


def test_saved_and_restored(tmp_path: Path) -> None:
    m = (0.3 * (DIFFUSE + GGX(alpha_x=0.1, alpha_y=0.4)) + ROUGH).named("test", "made here")
    m.save(tmp_path / "m.safetensors")
    back = Reflectance.restore(tmp_path / "m.safetensors")
    assert (back.name, back.source) == ("test", "made here")
    np.testing.assert_array_equal(back(*PAIRS), m(*PAIRS))


def test_albedo_of_a_sum_is_the_sum_of_albedos() -> None:
    wo = direction(40)
    np.testing.assert_allclose((DIFFUSE + GLOSSY).albedo(wo), DIFFUSE.albedo(wo) + GLOSSY.albedo(wo), rtol=0.01)


def test_an_array_scales_a_reflectance_and_not_each_of_its_channels() -> None:
    total = np.array([0.2, 0.5, 1.0]) * GLOSSY
    assert isinstance(total, Scaled)
    np.testing.assert_allclose(total(*PAIRS), GLOSSY(*PAIRS) * [0.2, 0.5, 1.0], rtol=1e-13)


def test_a_mixture_takes_a_share_per_channel_and_names_a_wrong_one() -> None:
    mixed = brdf.mix(DIFFUSE, GLOSSY, (0.0, 0.25, 1.0))
    expected = DIFFUSE(*PAIRS) * [1, 0.75, 0] + GLOSSY(*PAIRS) * [0, 0.25, 1]
    np.testing.assert_allclose(mixed(*PAIRS), expected, rtol=1e-13, atol=1e-300)
    with pytest.raises(ParameterError, match=r"t must lie in \[0, 1\], got 1.5"):
        brdf.mix(DIFFUSE, GLOSSY, 1.5)


def test_a_factor_is_finite() -> None:
    with pytest.raises(ParameterError, match=r"scale must lie in \[0, inf\), got inf"):
        np.inf * GLOSSY


def test_a_sum_shows_its_lobes() -> None:
    assert repr(0.5 * GLOSSY + ROUGH) == f"(0.5, 0.5, 0.5) * {GLOSSY!r} + {ROUGH!r}"
