"""Point sets are well spread; rules integrate what has a closed form; albedos and their errors are honest."""

from __future__ import annotations

import numpy as np
import pytest

from brdf import models
from brdf.geometry.directions import from_spherical
from brdf.geometry.quadrature import gauss_legendre, half_vector_rule, hemisphere_rule, replicated_points


@pytest.mark.parametrize(("samples", "each"), [(1, 1), (256, 16), (4096, 256), (5000, 256), (6000, 512)])
def test_replicates_are_nets(samples: int, each: int) -> None:
    points = replicated_points(samples)
    assert points.shape == (16, each, 2)
    assert points.min() >= 0
    assert points.max() < 1
    for columns in 2 ** np.arange(int(np.log2(each)) + 1):
        boxes = np.array([columns, each // columns])
        cells = (points * boxes).astype(int)
        for replicate in cells[..., 0] * boxes[1] + cells[..., 1]:
            assert len(np.unique(replicate)) == each  # one point in every dyadic box


def test_replicates_are_fixed_and_different() -> None:
    first = replicated_points(1024)
    replicated_points.cache_clear()
    np.testing.assert_array_equal(replicated_points(1024), first)
    assert len(np.unique(first[:, 0, 0])) == 16
    assert not first.flags.writeable


def test_gauss_legendre_is_exact_for_polynomials() -> None:
    x, weight = gauss_legendre(5, -1.0, 3.0)
    assert (weight * x**9).sum() == pytest.approx((3**10 - 1) / 10, rel=1e-13)


@pytest.mark.parametrize("power", [0, 1, 2, 7])
def test_hemisphere_rule_integrates_cosine_powers(power: int) -> None:
    w, weight = hemisphere_rule(8, 8)
    assert (weight * w[:, 2] ** power).sum() == pytest.approx(2 * np.pi / (power + 1), rel=1e-13)


@pytest.mark.parametrize("theta", [0.0, 30.0, 75.0])
def test_half_vector_rule_integrates_the_cosine(theta: float) -> None:
    wi, weight = half_vector_rule(from_spherical(np.radians(theta), 1.0))
    assert (weight * wi[:, 2]).sum() == pytest.approx(np.pi, rel=5e-3)


CASES = {
    "lambertian": models.Lambertian(albedo=0.7),
    "ggx": models.GGX(alpha=0.15, F0=0.9),
    "rough": models.GGX(alpha=0.8, F0=0.9),
    "tabulated": models.Microfacet(ndf="beckmann", alpha=0.2, F0=0.5),
    "sum": 0.5 * models.Lambertian() + models.GGX(alpha=0.1),
}


@pytest.mark.parametrize("case", CASES)
def test_albedo_is_accurate_and_its_error_honest(case: str) -> None:
    m = CASES[case]
    wo = from_spherical(np.radians(np.linspace(0, 80, 12)), np.linspace(0, 5, 12))
    reference = []
    for view in wo:
        wi, weight = half_vector_rule(view, 400, 256)
        reference.append(m.f_cos(wi, view).T @ weight)
    off = np.abs(m.albedo(wo) - reference)
    error = m.albedo_error(wo)
    assert off.max() < 3e-3
    # the rule's own error, at the horizon's edge, is below 3e-4
    assert np.all(off < 4 * error + 3e-4)
    assert np.sqrt(np.mean(off**2)) < 1e-3


def test_albedo_keeps_shape_and_type_and_takes_no_directions() -> None:
    wo = np.broadcast_to(np.float32([0, 0.6, 0.8]), (2, 3, 3))
    m = models.GGX()
    assert m.albedo(wo).shape == (2, 3, 3)
    assert m.albedo(wo).dtype == m.albedo_error(wo).dtype == np.float32
    assert m.albedo([0, 0, 1]).shape == (3,)
    assert m.albedo(np.zeros((0, 3))).shape == (0, 3)
    np.testing.assert_allclose(m.albedo(wo)[1, 2], m.albedo(wo[0, 0]), rtol=1e-6)
