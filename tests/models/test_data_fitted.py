"""The models of the published fits, against their papers' equations computed another way."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest

from brdf import models
from brdf.models.terms.diffraction import lambert_w, poisson_sum
from lobes import direction, lobe_albedo

HeTorrance = models.HeTorrance


def fresnel(cosine: float, eta: float) -> float:
    """Fresnel's equations by Snell's law."""
    sine_t = np.sqrt(1 - cosine**2) / eta
    cosine_t = np.sqrt(1 - sine_t**2)
    r_s = (cosine - eta * cosine_t) / (cosine + eta * cosine_t)
    r_p = (eta * cosine - cosine_t) / (eta * cosine + cosine_t)
    return float((r_s**2 + r_p**2) / 2)


def he_by_the_paper(wi: np.ndarray, wo: np.ndarray, sigma0: float, tau: float, eta: float) -> float:
    """Equations 24, 25 (with the errata's exponential) and 76 to 84 of the paper, at a wavelength of 1."""
    mp = mpmath
    n, k_i, k_r = np.array([0.0, 0.0, 1.0]), -wi, wo
    cos_i, cos_r = wi[2], wo[2]

    def cot(cosine: float) -> mpmath.mpf:
        return cosine / mp.sqrt(1 - mp.mpf(cosine) ** 2)

    def shadowing(cosine: float) -> mpmath.mpf:
        a = tau * cot(cosine) / (2 * sigma0)
        Lambda = (mp.exp(-a * a) / (mp.sqrt(mp.pi) * a) - mp.erfc(a)) / 2
        return (1 - mp.erfc(a) / 2) / (Lambda + 1)

    def K(cosine: float) -> mpmath.mpf:
        return mp.erfc(tau * cot(cosine) / (2 * sigma0)) / cot(cosine)

    right = (K(cos_i) + K(cos_r)) * mp.sqrt(2 / mp.pi) / 4
    root = mp.findroot(lambda x: x * mp.exp(x * x / 2) - right, min(right, mp.mpf(1))) if right > 1e-30 else mp.mpf(0)
    sigma = sigma0 / mp.sqrt(1 + root**2)
    g = (2 * mp.pi * sigma * (cos_i + cos_r)) ** 2

    v = 2 * mp.pi * (k_r - k_i)
    v_xy2 = v[0] ** 2 + v[1] ** 2
    terms = (g**m * mp.exp(-g - v_xy2 * tau**2 / (4 * m)) / (mp.factorial(m) * m) for m in range(1, 600))
    series = mp.fsum(terms)  # g is at most 158 here
    D = mp.pi**2 * tau**2 / 4 * series

    s_i, s_r = (np.cross(k, n) / np.linalg.norm(np.cross(k, n)) for k in (k_i, k_r))
    p_i, p_r = np.cross(s_i, k_i), np.cross(s_r, k_r)
    crossed = np.linalg.norm(np.cross(k_r, k_i)) ** 4
    polarised = ((s_r @ k_i) ** 2 + (p_r @ k_i) ** 2) * ((s_i @ k_r) ** 2 + (p_i @ k_r) ** 2) / crossed
    G = ((v @ v) / v[2]) ** 2 / (2 * mp.pi) ** 2 * polarised
    cos_d = float(np.sqrt((1 + wi @ wo) / 2))
    value = fresnel(cos_d, eta) * G * shadowing(cos_i) * shadowing(cos_r) * D / (mp.pi * cos_i * cos_r)
    return float(value)


@pytest.mark.parametrize(("sigma0", "tau"), [(0.05, 4.0), (0.18, 3.0), (0.6, 6.0), (1.0, 10.0)])
def test_he_torrance_against_the_paper(sigma0: float, tau: float) -> None:
    m = HeTorrance(sigma0=sigma0, tau=tau, eta=1.6)
    pairs = [
        (direction(20), direction(23, 175)), (direction(10, 40), direction(50, 100)),
        (direction(60), direction(62, 181)), (direction(80), direction(75, 178)), (direction(35), direction(30, 20)),
    ]  # fmt: skip
    for wi, wo in pairs:
        expected = he_by_the_paper(wi, wo, sigma0, tau, 1.6)
        assert m(wi, wo)[0] == pytest.approx(expected, rel=1e-4, abs=1e-12), (wi, wo)


def test_rough_limit_of_he_torrance_is_beckmann() -> None:
    """sigma0 >> 1: facets of RMS slope 2 sigma0 / tau (here 0.1, where masking does not matter)."""
    m = HeTorrance(sigma0=8.0, tau=160.0, eta=1.5)
    beckmann = models.Microfacet(ndf="beckmann", alpha=0.1, fresnel="dielectric", eta=1.5)
    for wi, wo in [
        (direction(5), direction(8, 170)),
        (direction(30), direction(40, 175)),
        (direction(0), direction(20)),
    ]:
        assert m(wi, wo)[0] == pytest.approx(float(beckmann(wi, wo)[0]), rel=1e-3)


@pytest.mark.parametrize("sigma0", [0.02, 0.05, 0.1, 0.2])
def test_what_he_torrance_scatters_is_what_its_mirror_part_lacks(sigma0: float) -> None:
    """Long correlation lengths: 1 - exp(-g) of the light leaves the coherent direction, g = (4 pi sigma0 cos)^2."""
    m = HeTorrance(sigma0=sigma0, tau=60.0, fresnel="schlick", F0=1.0)
    for theta in (0.0, 45.0):
        g = (4 * np.pi * sigma0 * np.cos(np.radians(theta))) ** 2
        assert lobe_albedo(m, direction(theta), 200, 128)[0] == pytest.approx(-np.expm1(-g), rel=5e-3)


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_scatter_series(dtype: type) -> None:
    rng = np.random.default_rng(2)
    g, e = 10 ** rng.uniform(-5, 2.3, 60), 10 ** rng.uniform(-3, 4, 60)
    found = poisson_sum(g.astype(dtype), e.astype(dtype))
    assert found.dtype == dtype
    m = np.arange(1, 3000)
    log_factorial = np.cumsum(np.log(m))
    terms = m * np.log(g)[:, None] - g[:, None] - log_factorial - np.log(m) - e[:, None] / m
    expected = np.exp(terms).sum(-1)
    use = expected > 1e-12
    assert use.sum() > 25
    np.testing.assert_allclose(found[use], expected[use], rtol=1e-4)


def test_scatter_series_at_its_extremes() -> None:
    g, e = np.float32([0.0, 1e-14, 1e-14, 1.6e4, 1.6e4]), np.float32([0.0, 0.0, 4e5, 0.0, 4e5])
    found = poisson_sum(g, e)
    assert np.isfinite(found).all()
    np.testing.assert_allclose(found[1:3], [1e-14, 0.0], rtol=1e-4, atol=1e-30)
    np.testing.assert_allclose(found[3:], [1 / 1.6e4, np.exp(-25) / 1.6e4], rtol=2e-2)


def test_lambert_w() -> None:
    z = 10 ** np.linspace(-8, 35, 200)
    w = lambert_w(z)
    np.testing.assert_allclose(np.log(w) + w, np.log(z), rtol=1e-12, atol=1e-12)


PAIRS = [(direction(0), direction(60)), (direction(25, 10), direction(40, 200)), (direction(80), direction(70, 175))]


@pytest.mark.parametrize(("wi", "wo"), PAIRS)
@pytest.mark.parametrize("eta", [1.05, 1.5, 30.0])
def test_low_models(wi: np.ndarray, wo: np.ndarray, eta: float) -> None:
    A, B, C = 20.0, 500.0, 1.3
    h = (wi + wo) / np.linalg.norm(wi + wo)
    F = fresnel(float(wi @ h), eta)
    smooth = A * F / (1 + B * np.sum((wi + wo)[:2] ** 2)) ** C
    in_plane = np.sqrt(1 - np.sum((wi - wo)[:2] ** 2) / 4)
    smooth *= fresnel(float(in_plane), eta) / F
    assert models.LowSmooth(A=A, B=B, C=C, eta=eta)(wi, wo)[0] == pytest.approx(smooth, rel=1e-8)
    G = min(1, 2 * h[2] * wi[2] / (wi @ h), 2 * h[2] * wo[2] / (wi @ h))
    facets = A * F * G / (1 + B * (1 - h[2])) ** C / (wi[2] * wo[2])
    assert models.LowMicrofacet(A=A, B=B, C=C, eta=eta)(wi, wo)[0] == pytest.approx(facets, rel=1e-8)


@pytest.mark.parametrize(("wi", "wo"), [*PAIRS, (direction(85), direction(85)), (direction(85), direction(20))])
def test_cook_torrance(wi: np.ndarray, wo: np.ndarray) -> None:
    m, F0 = 0.4, 0.3
    h = (wi + wo) / np.linalg.norm(wi + wo)
    cos_d, tan2 = wi @ h, 1 / h[2] ** 2 - 1
    D = np.exp(-tan2 / m**2) / (np.pi * m**2 * h[2] ** 4)
    G = min(1, 2 * h[2] * wi[2] / cos_d, 2 * h[2] * wo[2] / cos_d)
    F = F0 + (1 - F0) * (1 - cos_d) ** 5
    expected = D * G * F / (np.pi * wi[2] * wo[2])
    assert models.CookTorrance(m=m, F0=F0)(wi, wo)[0] == pytest.approx(expected, rel=1e-8)
