"""The slice stack against the accuracy published for it and against every shipped material.

The published PSNR figures count the unlit pixels of the sphere's disc as right; ours leave them out. Over light angles
0, 5, …, 180 degrees exactly half of the disc is lit, so that the published figures are 10 log10 2 = 3.01 dB higher.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.helpers import random_directions

from brdf import materials, metrics
from brdf.errors import ReflectanceError, UnknownNameError
from brdf.models import GGX, Lambertian
from brdf.reflectance import Reflectance
from brdf.representations.slice_stack import BUDGETS, SliceStack

UNLIT = 10 * math.log10(2)
WI, WO = random_directions(300, 1), random_directions(300, 2)


def plastic(alpha):
    return Lambertian(albedo=0.5) + GGX(alpha=alpha, F0=0.04)


def gold(alpha):
    return GGX(alpha=alpha, F0=(1.0, 0.78, 0.34))


@pytest.mark.parametrize("method", ["least-squares", "points"])
@pytest.mark.parametrize("albedo", [0.0, 0.05, (0.8, 0.5, 0.2)])
def test_lambertian_is_exact(method, albedo):
    m = Lambertian(albedo=albedo)
    np.testing.assert_allclose(SliceStack.bake(m, method=method)(WI, WO), m(WI, WO), atol=1e-6, rtol=1e-6)


@pytest.mark.parametrize(
    ("material", "fitted", "points"),
    [("plastic 0.2", 62, 56), ("gold 0.3", 54, 52), ("alum-bronze", 61, 56)],
)
def test_reaches_the_published_accuracy(material, fitted, points):
    name, _, alpha = material.partition(" ")
    m = {"plastic": plastic, "gold": gold}[name](float(alpha)) if alpha else materials.get(material)
    assert metrics.psnr(m, SliceStack.bake(m)) + UNLIT > fitted
    assert metrics.psnr(m, SliceStack.bake(m, method="points")) + UNLIT > points


def test_every_shipped_sgd_fit_survives():
    """All 100 fits of Bagher2012 in 16 KB."""
    names = [name for name in materials.names() if "bagher_sgd" in materials.fits(name)]
    assert len(names) == 100
    found = {}
    for name in names:
        m = materials.get(name, "bagher_sgd")
        found[name] = metrics.psnr(m, SliceStack.bake(m), size=96)
    values = np.minimum(list(found.values()), 100.0)  # a few are diffuse, and exact
    worst = min(found, key=lambda name: found[name])
    assert found[worst] >= 54, f"{worst}: {found[worst]:.1f} dB"
    assert np.mean(values) >= 66
    assert np.median(values) >= 63


def test_least_squares_beats_points():
    gains = [
        metrics.psnr(m, SliceStack.bake(m), 36) - metrics.psnr(m, SliceStack.bake(m, method="points"), 36)
        for m in (plastic(0.1), plastic(0.4), gold(0.1), gold(0.3))
    ]
    assert np.mean(gains) > 2


def test_bigger_budgets_are_better():
    m = gold(0.3)
    psnr = [metrics.psnr(m, SliceStack.bake(m, budget), 36) for budget in BUDGETS]
    assert psnr[0] + 4 < psnr[1] < psnr[2]


@pytest.mark.parametrize(("budget", "kibibytes"), [("16K", 16), ("64K", 63), ("256K", 256)])
def test_costs_what_it_says(budget, kibibytes):
    stack = SliceStack.bake(plastic(0.2), budget)
    assert stack.codes.nbytes == kibibytes * 1024
    assert stack.nbytes == stack.codes.nbytes + 4 * 9  # floor, low and span of three channels


def test_file_is_as_small_and_restores_to_the_bit(tmp_path):
    stack = SliceStack.bake(plastic(0.2))
    path = tmp_path / "stack.safetensors"
    stack.save(path)
    assert path.stat().st_size < 17.5 * 1024
    back = Reflectance.restore(path)
    for dtype in (np.float32, np.float64):
        np.testing.assert_array_equal(
            back(WI.astype(dtype), WO.astype(dtype)), stack(WI.astype(dtype), WO.astype(dtype))
        )


def test_is_reciprocal_and_never_negative():
    stack = SliceStack.bake(gold(0.1))
    np.testing.assert_allclose(stack(WI, WO), stack(WO, WI), rtol=1e-9)
    assert stack.raw(WI, WO).min() >= 0


def test_stays_finite_and_bounded_at_grazing():
    """Columns of nodes below the horizon hold what their neighbours hold, not what a singular fit leaves."""
    m, stack = gold(0.3), SliceStack.bake(gold(0.3))
    angles = np.radians([85.0, 88.0, 89.5, 89.99])
    wi = np.stack([np.sin(angles), 0 * angles, np.cos(angles)], -1)
    for wo in (wi, wi * [-1, 1, 1], np.broadcast_to([0.0, 0.0, 1.0], wi.shape)):
        value, exact = stack.f_cos(wi, wo), m.f_cos(wi, wo)
        assert np.isfinite(value).all()
        assert np.all(value <= 10 * exact + 0.5)


def test_provenance_names_the_operator():
    assert "least squares" in SliceStack.bake(plastic(0.2).named("p", "made up")).source


def test_refuses():
    with pytest.raises(ReflectanceError, match="anisotropic"):
        SliceStack.bake(GGX(alpha_x=0.1, alpha_y=0.3))
    with pytest.raises(UnknownNameError, match="16K"):
        SliceStack.bake(Lambertian(), budget="17K")
    with pytest.raises(UnknownNameError, match="points"):
        SliceStack.bake(Lambertian(), method="guess")
