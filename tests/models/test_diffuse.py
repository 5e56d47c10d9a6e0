"""Diffuse models: energy against closed forms, limits, what couples to what."""

from __future__ import annotations

import numpy as np
import pytest

from brdf import Reflectance
from brdf.errors import ParameterError, ReflectanceError
from brdf.geometry.directions import from_spherical
from brdf.geometry.quadrature import gauss_legendre, hemisphere_rule
from brdf.models import EON, GGX, CoupledDiffuse, DisneyDiffuse, KelemenDiffuse, Mirror, OrenNayar, OrenNayarFull
from lobes import direction, lobe_albedo, random_pairs

RULE = hemisphere_rule(200, 128)


def albedo(m: Reflectance, wo: np.ndarray) -> np.ndarray:
    """Directional albedo by quadrature, (3,)."""
    return np.einsum("nc,n->c", m(RULE.directions, wo), RULE.directions[:, 2] * RULE.weights)


THETAS = [0.0, 30.0, 60.0, 80.0, 88.0]


@pytest.mark.parametrize("roughness", [0.0, 0.3, 1.0])
@pytest.mark.parametrize(("kind", "tolerance"), [("exact", 5e-5), ("approximate", 1e-3)])
def test_eon_white_furnace(roughness: float, kind: str, tolerance: float) -> None:
    """With rho = 1 nothing is lost; the polynomial is good to 0.1 %, the exact form to the rule's own error."""
    m = EON(rho=1.0, roughness=roughness, directional_albedo=kind)
    for theta in THETAS:
        np.testing.assert_allclose(albedo(m, direction(theta, 20)), 1, atol=tolerance)


@pytest.mark.parametrize("rho", [0.2, 0.8])
def test_eon_mean_albedo_in_closed_form(rho: float) -> None:
    """Over all directions, single scattering keeps rho E, all further scattering its geometric series."""
    m = EON(rho=rho, roughness=0.7)
    A = 1 / (1 + (0.5 - 2 / (3 * np.pi)) * 0.7)
    E = A * (1 + (2 / 3 - 28 / (15 * np.pi)) * 0.7)
    cosine, weight = gauss_legendre(12)
    directions = from_spherical(np.arccos(cosine), 0.3)
    mean = sum(2 * w * c * albedo(m, wo)[0] for c, w, wo in zip(cosine, weight, directions, strict=True))
    assert mean == pytest.approx(rho * E + rho**2 * E * (1 - E) / (1 - rho * (1 - E)), rel=1e-4)


def test_smooth_limits_are_lambertian() -> None:
    wi, wo = random_pairs(500)
    for m in (EON(rho=0.6, roughness=0.0), OrenNayarFull(albedo=0.6, sigma=0.0)):
        np.testing.assert_allclose(m(wi, wo), 0.6 / np.pi, rtol=1e-12)


def as_printed(theta_i: float, theta_o: float, dphi: float, rho: float, sigma: float) -> float:
    """Oren and Nayar's equations, angle by angle as they stand in the paper."""
    alpha, beta, s2 = max(theta_i, theta_o), min(theta_i, theta_o), sigma**2
    C1 = 1 - 0.5 * s2 / (s2 + 0.33)
    C2 = 0.45 * s2 / (s2 + 0.09)
    C2 *= np.sin(alpha) if np.cos(dphi) >= 0 else np.sin(alpha) - (2 * beta / np.pi) ** 3
    C3 = 0.125 * s2 / (s2 + 0.09) * (4 * alpha * beta / np.pi**2) ** 2
    direct = C1 + np.cos(dphi) * C2 * np.tan(beta) + (1 - abs(np.cos(dphi))) * C3 * np.tan((alpha + beta) / 2)
    exchanged = 0.17 * s2 / (s2 + 0.13) * (1 - np.cos(dphi) * (2 * beta / np.pi) ** 2)
    return rho / np.pi * direct + rho**2 / np.pi * exchanged


def test_full_oren_nayar_as_printed() -> None:
    rng = np.random.default_rng(0)
    for _ in range(300):
        theta_i, theta_o = rng.uniform(0, 1.4, 2)
        dphi, rho, sigma = rng.uniform(-np.pi, np.pi), rng.uniform(0, 1), rng.uniform(0, 0.6)
        m = OrenNayarFull(albedo=rho, sigma=sigma)
        value = m(from_spherical(theta_i, 0.4), from_spherical(theta_o, 0.4 + dphi))[0]
        assert value == pytest.approx(as_printed(theta_i, theta_o, dphi, rho, sigma), rel=1e-9)


def test_simplified_oren_nayar_approximates_the_full_one() -> None:
    wo = direction(60)
    for theta, phi in ((0, 0), (30, 0), (60, 0), (45, 90)):
        full = OrenNayarFull(albedo=0.2, sigma=0.4)(direction(theta, phi), wo)[0]
        assert OrenNayar(albedo=0.2, sigma=0.4)(direction(theta, phi), wo)[0] == pytest.approx(full, rel=0.15)


def test_full_oren_nayar_is_not_negative_where_its_equations_are() -> None:
    wi, wo = direction(88, 0), direction(88, 180)
    assert as_printed(np.radians(88), np.radians(88), np.pi, 0.1, 1.2) < 0
    assert (OrenNayarFull(albedo=0.1, sigma=1.2).raw(wi, wo) > 0).all()


@pytest.mark.parametrize("F0", [0.0, 0.04, 0.6])
def test_coupled_diffuse_returns_what_schlick_lets_in(F0: float) -> None:
    for theta in THETAS:
        wo = direction(theta, 5)
        fresnel = F0 + (1 - F0) * (1 - wo[2]) ** 5
        np.testing.assert_allclose(albedo(CoupledDiffuse(albedo=1.0, F0=F0), wo), 1 - fresnel, atol=1e-12)


def test_kelemen_over_a_rough_surface_fills_the_furnace() -> None:
    specular = GGX(alpha=0.3, F0=(0.04, 0.5, 0.9))
    both = specular + KelemenDiffuse.beneath(specular, albedo=1.0)
    for theta in (0.0, 45.0, 75.0):
        wo = direction(theta, 5)
        total = lobe_albedo(specular, wo) + albedo(both.children["lobe2"], wo)
        np.testing.assert_allclose(total, 1, atol=2e-3)


def test_kelemen_over_a_smooth_surface_is_the_closed_form() -> None:
    cosine = np.linspace(0, 1, 1025)
    table = np.repeat((0.04 + 0.96 * (1 - cosine) ** 5)[:, None], 3, axis=1)
    wi, wo = random_pairs(400)
    tabulated, closed = KelemenDiffuse(albedo=0.7, specular_albedo=table), CoupledDiffuse(albedo=0.7, F0=0.04)
    np.testing.assert_allclose(tabulated(wi, wo), closed(wi, wo), rtol=1e-3, atol=1e-5)


def test_kelemen_refuses_what_no_table_over_one_cosine_holds() -> None:
    with pytest.raises(ReflectanceError, match="GGX is anisotropic or transmits"):
        KelemenDiffuse.beneath(GGX(alpha_x=0.1, alpha_y=0.3))
    with pytest.raises(ParameterError, match=r"albedo must lie in \[0, 1\], got 1.2"):
        KelemenDiffuse.beneath(GGX(), albedo=1.2, samples=64)


def test_kelemen_saves_its_table(tmp_path: object) -> None:
    m = KelemenDiffuse.beneath(Mirror(reflectance=0.5), albedo=0.8, nodes=5, samples=64)
    m.save(f"{tmp_path}/m.safetensors")
    back = Reflectance.restore(f"{tmp_path}/m.safetensors")
    np.testing.assert_array_equal(back(direction(20), direction(40)), m(direction(20), direction(40)))


@pytest.mark.parametrize("roughness", [0.0, 1.0])
def test_disney_retroreflection_at_grazing_angles(roughness: float) -> None:
    """Smooth surfaces lose half of each factor at grazing angles, rough ones gain 3/2."""
    w = direction(90 - 1e-9)
    ratio = DisneyDiffuse(albedo=1.0, roughness=roughness)(w, w)[0] * np.pi
    assert ratio == pytest.approx((0.5 + 2 * roughness) ** 2, rel=1e-6)
