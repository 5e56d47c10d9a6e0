"""The phenomenological lobes: normalisation, limits and the energy they reflect."""

from __future__ import annotations

import numpy as np
import pytest

from brdf.models import GGX, BlinnPhong, Lambertian, Microfacet, ModifiedPhong, OrenNayar
from brdf.reflectance import Reflectance
from lobes import direction, lobe_albedo


@pytest.mark.parametrize("n", [0.0, 1.0, 10.0, 1e3, 1e5])
@pytest.mark.parametrize("model", [BlinnPhong, ModifiedPhong])
def test_albedo_at_normal_incidence_is_ks(model: type[Reflectance], n: float) -> None:
    lobe = model(ks=(0.2, 0.5, 1.0), n=n)
    # n = 0 does not vanish at the horizon: the rule over half vectors cuts it off within one node
    tolerance = {0.0: 2e-2, 1.0: 2e-3, 10.0: 2e-5}.get(n, 1e-6)
    np.testing.assert_allclose(lobe_albedo(lobe, direction(0.0), 300), [0.2, 0.5, 1.0], rtol=tolerance)


@pytest.mark.parametrize(
    "model",
    [
        BlinnPhong(ks=1.0, n=20.0),
        ModifiedPhong(ks=1.0, n=20.0),
        GGX(alpha=0.3, F0=1.0),
        GGX(alpha_x=0.1, alpha_y=0.6, F0=1.0),
        Microfacet(ndf="beckmann", alpha=0.3, fresnel="conductor"),
        Microfacet(ndf="beckmann", alpha=0.3, masking="smith-separable", fresnel="dielectric"),
    ],
    ids=repr,
)
@pytest.mark.parametrize("theta", [0, 30, 60, 80])
def test_lobe_reflects_no_more_than_it_receives(model: Reflectance, theta: float) -> None:
    albedo = lobe_albedo(model, direction(theta, 25.0), 200, 90)
    assert (albedo > 0).all()
    assert (albedo <= 1.002).all()  # 0.2 %: the error of the rule at the horizon


def test_smooth_microfacet_reflects_fresnel() -> None:
    lobe = Microfacet(alpha=1e-3, fresnel="dielectric", eta=1.5)
    # 50 degrees: r_s = -0.334736, r_p = 0.057250 by Fresnel's equations with sin t = sin 50 / 1.5
    assert lobe_albedo(lobe, direction(50.0), 200)[0] == pytest.approx((0.334736**2 + 0.057250**2) / 2, rel=2e-3)


def test_oren_nayar_without_roughness_is_lambertian() -> None:
    wi, wo = direction(30, 10), direction(70, 40)
    np.testing.assert_allclose(OrenNayar(sigma=0.0)(wi, wo), Lambertian()(wi, wo), rtol=1e-15)


@pytest.mark.parametrize("theta_i", [10.0, 45.0, 80.0])
@pytest.mark.parametrize("theta_o", [20.0, 70.0])
@pytest.mark.parametrize("phi", [0.0, 50.0, 130.0])
def test_oren_nayar_against_its_angles(theta_i: float, theta_o: float, phi: float) -> None:
    sigma2, (i, o, azimuth) = 0.4**2, np.radians([theta_i, theta_o, phi])
    A, B = 1 - 0.5 * sigma2 / (sigma2 + 0.33), 0.45 * sigma2 / (sigma2 + 0.09)
    expected = 0.5 / np.pi * (A + B * max(0.0, np.cos(azimuth)) * np.sin(max(i, o)) * np.tan(min(i, o)))
    value = OrenNayar(albedo=0.5, sigma=0.4)(direction(theta_i), direction(theta_o, phi))
    np.testing.assert_allclose(value, expected, rtol=1e-12)


def test_oren_nayar_stays_bounded_at_grazing_angles() -> None:
    grazing = direction(89.9999)
    A, B = 1 - 0.5 * 0.25 / (0.25 + 0.33), 0.45 * 0.25 / (0.25 + 0.09)
    # sin(theta_max) tan(theta_min) is tan(10) here; with the angles the other way round it would be 1e5
    value = OrenNayar(albedo=1.0, sigma=0.5)(grazing, direction(10))
    np.testing.assert_allclose(value, (A + B * np.tan(np.radians(10))) / np.pi, rtol=1e-6)
