"""Samplers: densities against closed forms and Mitsuba, mixtures, the tabulated sampler's quality."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from brdf import Reflectance, models
from brdf.errors import ParameterError
from brdf.geometry.directions import cosine_weighted, from_spherical, half_vector, uniform_hemisphere
from brdf.geometry.quadrature import half_vector_rule
from brdf.geometry.sampling import CosineSampler, GGXSampler, MixtureSampler, TabulatedSampler

RNG = np.random.default_rng(9)
U = RNG.random((100_000, 2))
SAMPLERS = {
    "cosine": CosineSampler(),
    "ggx": GGXSampler(0.1, 0.4),
    "mixture": MixtureSampler([GGXSampler(0.2, 0.2), CosineSampler()], [3.0, 1.0]),
    "tabulated": TabulatedSampler(models.GGX(alpha=0.1), True),
    "tabulated, anisotropic": TabulatedSampler(models.GGX(alpha_x=0.1, alpha_y=0.4), False),
    "tabulated, black": TabulatedSampler(lambda wi, wo: np.zeros_like(wi), True),
}


def views(theta_degrees: float, count: int = len(U), phi: float = 0.3) -> Any:
    return np.broadcast_to(from_spherical(np.radians(theta_degrees), phi), (count, 3))


def test_ggx_density_is_that_of_visible_normals() -> None:
    ax, ay = 0.15, 0.5
    wi, wo = cosine_weighted(RNG.random((1000, 2))), cosine_weighted(RNG.random((1000, 2)))
    h = half_vector(wi, wo)
    theta, phi = np.arccos(h[:, 2]), np.arctan2(h[:, 1], h[:, 0])
    stretch = np.cos(phi) ** 2 / ax**2 + np.sin(phi) ** 2 / ay**2
    D = 1 / (np.pi * ax * ay * np.cos(theta) ** 4 * (1 + np.tan(theta) ** 2 * stretch) ** 2)
    projected = ((ax * wo[:, 0]) ** 2 + (ay * wo[:, 1]) ** 2) / wo[:, 2] ** 2
    G1 = 2 / (1 + np.sqrt(1 + projected))
    visible = D * G1 * np.sum(wo * h, -1) / wo[:, 2]
    np.testing.assert_allclose(GGXSampler(ax, ay).pdf(wi, wo), visible / (4 * np.sum(wo * h, -1)), rtol=1e-9)


def test_ggx_samples_have_weight_shadowing_alone() -> None:
    """f cos / pdf of a perfectly reflecting surface is G2 / G1, which lies in (0, 1]."""
    m = models.GGX(alpha=0.3, F0=1.0)
    drawn = m.sample(views(60), U)
    used = drawn.pdf > 0
    a_o, a_i = (0.3**2 * (1 / c**2 - 1) for c in (np.cos(np.radians(60)), drawn.wi[used, 2]))
    lambda_o, lambda_i = ((np.sqrt(1 + a) - 1) / 2 for a in (a_o, a_i))
    expected = (1 + lambda_o) / (1 + lambda_o + lambda_i)
    np.testing.assert_allclose(drawn.weight[used, 0], expected, rtol=1e-8)


@pytest.mark.parametrize(("alpha_x", "alpha_y"), [(0.05, 0.05), (0.1, 0.4), (0.6, 0.3)])
def test_ggx_density_equals_that_of_mitsuba(alpha_x: float, alpha_y: float) -> None:
    mi = pytest.importorskip("mitsuba")
    mi.set_variant("scalar_rgb")
    bsdf = mi.load_dict({"type": "roughconductor", "distribution": "ggx", "alpha_u": alpha_x, "alpha_v": alpha_y})
    wi, wo = cosine_weighted(RNG.random((300, 2))), cosine_weighted(RNG.random((300, 2)))
    theirs = []
    for light, viewer in zip(wi, wo, strict=True):
        interaction = mi.SurfaceInteraction3f()
        interaction.wi = mi.Vector3f(viewer.tolist())
        theirs.append(bsdf.pdf(mi.BSDFContext(), interaction, mi.Vector3f(light.tolist())))
    ours = GGXSampler(alpha_x, alpha_y).pdf(wi, wo)
    np.testing.assert_allclose(ours, theirs, rtol=2e-3, atol=1e-6)  # Mitsuba computes in float32


@pytest.mark.parametrize("name", SAMPLERS)
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_samplers_keep_dtype_and_give_unit_vectors(name: str, dtype: Any) -> None:
    sampler, wo = SAMPLERS[name], cosine_weighted(RNG.random((5000, 2))).astype(dtype)
    wi, is_delta = sampler.sample(wo, U[:5000].astype(dtype))
    pdf = sampler.pdf(wi, wo)
    assert wi.dtype == pdf.dtype == dtype
    assert not is_delta.any()
    np.testing.assert_allclose(np.linalg.norm(wi, axis=-1), 1, atol=2e-6)
    assert np.all(np.isfinite(pdf) & (pdf >= 0))
    assert np.all(pdf[wi[:, 2] <= 0] == 0)
    assert np.mean(pdf > 0) > 0.9


@pytest.mark.parametrize("name", SAMPLERS)
@pytest.mark.parametrize("theta", [0.0, 35.0, 80.0])
def test_share_of_useful_samples_is_the_integral_of_the_density(name: str, theta: float) -> None:
    sampler, wo = SAMPLERS[name], views(theta)
    wi, _ = sampler.sample(wo, U)
    rule, weight = half_vector_rule(wo[0], 400, 256)
    integral = (sampler.pdf(rule, np.broadcast_to(wo[0], rule.shape)) * weight).sum()
    assert integral <= 1.005
    assert np.mean(sampler.pdf(wi, wo) > 0) == pytest.approx(integral, abs=6e-3)


@pytest.mark.parametrize("name", SAMPLERS)
def test_the_ends_of_the_unit_square_and_of_the_hemisphere(name: str) -> None:
    sampler, last = SAMPLERS[name], np.nextafter(np.float32(1), np.float32(0))
    corners = np.array([[a, b] for a in (0, 0.5, last) for b in (0, 0.5, last)], np.float32)
    for theta in (0.0, 45.0, 89.99):
        for dtype in (np.float32, np.float64):
            wo = views(theta, len(corners)).astype(dtype)
            wi, _ = sampler.sample(wo, corners.astype(dtype))
            assert np.isfinite(wi).all()
            assert np.isfinite(sampler.pdf(wi, wo)).all()
    below = views(120, 10)
    assert np.all(sampler.pdf(views(30, 10), below) == 0)


def test_a_mixture_draws_by_weight_and_adds_densities() -> None:
    class North:
        def sample(self, wo: Any, u: Any) -> Any:
            self.seen = u
            return np.broadcast_to([0.0, 0.0, 1.0], wo.shape), np.zeros(len(wo), bool)

        def pdf(self, wi: Any, wo: Any) -> Any:
            return np.full(len(wi), 7.0)

    north = North()
    mixture = MixtureSampler([CosineSampler(), north, GGXSampler(0.3, 0.3)], [1, 3, 0])
    wi, _ = mixture.sample(views(20), U)
    assert np.mean(wi[:, 2] == 1) == pytest.approx(0.75, abs=0.006)
    np.testing.assert_allclose(north.seen.mean(0), 0.5, atol=0.005)  # what is left of the numbers is uniform again
    assert north.seen.max() < 1
    np.testing.assert_allclose(mixture.pdf(wi, views(20)), 0.25 * wi[:, 2] / np.pi + 0.75 * 7)


def test_a_mixture_without_weight_chooses_evenly() -> None:
    mixture = MixtureSampler([CosineSampler(), GGXSampler(0.3, 0.3)], [0, 0])
    wi, wo = uniform_hemisphere(U[:9]), views(20, 9)
    expected = (CosineSampler().pdf(wi, wo) + GGXSampler(0.3, 0.3).pdf(wi, wo)) / 2
    np.testing.assert_allclose(mixture.pdf(wi, wo), expected)


@pytest.mark.parametrize("weights", [[1.0], [1.0, -1.0], [1.0, np.nan], [1.0, np.inf]])
def test_a_mixture_refuses_wrong_weights(weights: list[float]) -> None:
    with pytest.raises(ParameterError, match="a mixture of 2 samplers needs as many weights >= 0"):
        MixtureSampler([CosineSampler(), CosineSampler()], weights)


def test_ggx_refuses_a_width_of_zero() -> None:
    with pytest.raises(ParameterError, match=r"widths above 0, got 0 and 0\.1"):
        GGXSampler(0.0, 0.1)


# model, largest standard deviation of a sample's weight relative to its mean, over the viewing angles
QUALITY: dict[str, tuple[Reflectance, float]] = {
    "lambertian": (models.Lambertian(), 0.05),
    "ggx 0.02": (models.GGX(alpha=0.02), 0.5),
    "ggx 0.1": (models.GGX(alpha=0.1), 0.4),
    "ggx 0.5": (models.GGX(alpha=0.5), 0.4),
    "plastic": (0.5 * models.Lambertian() + models.GGX(alpha=0.1), 0.4),
    "anisotropic": (models.GGX(alpha_x=0.05, alpha_y=0.3), 0.7),
}


@pytest.mark.parametrize("name", QUALITY)
def test_the_tabulated_sampler_follows_the_values(name: str) -> None:
    m, limit = QUALITY[name]
    sampler = TabulatedSampler(m, m.isotropic)
    for theta in (0.0, 20.0, 50.0, 80.0):
        wo = views(theta)
        wi, _ = sampler.sample(wo, U)
        pdf = sampler.pdf(wi, wo)
        weight = m.f_cos(wi, wo)[:, 1] / np.where(pdf > 0, pdf, np.inf)
        assert weight.std() < limit * weight.mean()
        rule, solid_angle = half_vector_rule(wo[0], 400, 256)
        albedo = m.f_cos(rule, wo[0])[:, 1] @ solid_angle
        assert weight.mean() == pytest.approx(albedo, rel=5 * limit / np.sqrt(len(U)) + 2e-3)


def test_the_tabulated_sampler_finds_a_lobe_that_is_not_a_mirror() -> None:
    def retroreflecting(wi: Any, wo: Any) -> Any:
        return np.repeat(np.exp(-np.sum((wi - wo) ** 2, -1) / 0.1)[:, None], 3, axis=1)

    sampler, wo = TabulatedSampler(retroreflecting, True), views(40)
    deviations = []
    for each in (sampler, CosineSampler()):
        wi, _ = each.sample(wo, U)
        pdf = each.pdf(wi, wo)
        weight = retroreflecting(wi, wo)[:, 0] * wi[:, 2] / np.where(pdf > 0, pdf, np.inf)
        deviations.append(weight.std() / weight.mean())
    assert deviations[0] < 0.4 * deviations[1]
