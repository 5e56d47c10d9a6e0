"""Axis warps: published values of the Bezier curve, exact inverses, node positions."""

from __future__ import annotations

import math

import numpy as np
import pytest

from brdf.errors import ParameterError, UnknownNameError
from brdf.geometry.warps import (
    HALF_PI,
    Angle,
    Bezier,
    FarPower,
    Power,
    Warp,
    square_root,
    uniform,
    warp_from,
)

WARPS = [
    uniform(),
    uniform(math.pi),
    square_root(),
    square_root((89 / 90) ** 2 * HALF_PI),
    Power(HALF_PI, 3.0),
    FarPower(math.radians(86), 1.3),
    *(Bezier(alpha=a) for a in (0.0, 0.25, 0.5, 0.5841, 0.75, 1.0)),
    *(Bezier(math.pi, a) for a in (0.2, 1.0)),
]


def coordinate(warp: Warp, angle: np.ndarray) -> np.ndarray:
    return np.asarray(warp.coordinate(Angle(np.sin(angle), np.cos(angle))))


@pytest.mark.parametrize("warp", WARPS, ids=str)
def test_angle_inverts_coordinate(warp):
    u = np.linspace(0, 1, 2001)
    np.testing.assert_allclose(coordinate(warp, warp.angle(u)), u, atol=3e-12)


@pytest.mark.parametrize("warp", WARPS, ids=str)
def test_maps_its_extent_to_the_unit_interval_increasingly(warp):
    angles = np.linspace(0, warp.extent, 1001)
    u = coordinate(warp, angles)
    assert u[0] == pytest.approx(0, abs=1e-12)
    assert u[-1] == pytest.approx(1, abs=1e-12)
    assert np.all(np.diff(u) > 0)


@pytest.mark.parametrize("warp", [w for w in WARPS if w.extent < HALF_PI], ids=str)
def test_angles_beyond_the_last_node_have_its_coordinate(warp):
    np.testing.assert_allclose(coordinate(warp, np.linspace(warp.extent, HALF_PI, 5)), 1, atol=1e-12)


@pytest.mark.parametrize("warp", WARPS, ids=str)
def test_comes_back_from_its_state(warp):
    assert warp_from(warp.state) == warp


# F(x) of the quadratic Bezier curve B(t) = ((1 - (1-t)^2), 2 a t + (1 - 2a) t^2), evaluated by hand
BEZIER = {
    0.0: (0, 0.002633404, 0.017949192, 0.085786438, 0.25, 0.467544468, 0.81, 1),
    0.25: (0, 0.026975053, 0.075961894, 0.189339828, 0.375, 0.575658351, 0.855, 1),
    0.5: (0, 0.051316702, 0.133974596, 0.292893219, 0.5, 0.683772234, 0.9, 1),
    0.5841: (0, 0.059505233, 0.153490069, 0.327728579, 0.54205, 0.720141744, 0.915138, 1),
    1.0: (0, 0.1, 0.25, 0.5, 0.75, 0.9, 0.99, 1),
}


@pytest.mark.parametrize(("alpha", "expected"), BEZIER.items())
def test_bezier_is_the_curve_over_the_cosine(alpha, expected):
    cosines = np.array([0, 0.1, 0.25, 0.5, 0.75, 0.9, 0.99, 1])
    np.testing.assert_allclose(1 - coordinate(Bezier(alpha=alpha), np.arccos(cosines)), expected, atol=6e-10)


def test_bezier_parametric_form():
    t = np.linspace(0, 1, 101)
    x, y = 1 - (1 - t) ** 2, 2 * 0.3 * t + 0.4 * t**2
    np.testing.assert_allclose(1 - coordinate(Bezier(alpha=0.3), np.arccos(x)), y, atol=1e-7)


def test_bezier_over_half_a_turn_is_odd_about_the_middle():
    warp, angles = Bezier(math.pi, 0.2), np.linspace(0, HALF_PI, 50)
    np.testing.assert_allclose(coordinate(warp, math.pi - angles), 1 - coordinate(warp, angles), atol=1e-12)


@pytest.mark.parametrize(
    ("alpha", "degrees"),
    [(1.0, (10.2222, 60.5237, 89.0905)), (0.0, (0.6457, 24.3726, 76.3433)), (0.65, (1.8199, 48.5112, 88.6053))],
)
def test_bezier_node_angles(alpha, degrees):
    nodes = np.degrees(Bezier(alpha=alpha).nodes(64))
    np.testing.assert_allclose(nodes[[1, 32, 62]], degrees, atol=6e-5)


def test_far_power_puts_the_slices_of_the_stack():
    light_angles = np.degrees(2 * FarPower(math.radians(86), 1.3).nodes(8))
    np.testing.assert_allclose(light_angles, [0, 31.2, 60.9, 88.9, 114.8, 138.3, 158.3, 172], atol=0.06)


def test_square_root_is_merls_axis():
    nodes = square_root((89 / 90) ** 2 * HALF_PI).nodes(90)
    np.testing.assert_allclose(np.degrees(nodes), (np.arange(90) / 90) ** 2 * 90, atol=1e-12)


def test_float32_resolves_the_pole():
    for warp in (square_root(), Bezier(alpha=0.65)):
        angle = np.geomspace(1e-5, 1e-2, 20)
        single = warp.coordinate(Angle(np.sin(angle).astype(np.float32), np.cos(angle).astype(np.float32)))
        assert single.dtype == np.float32
        np.testing.assert_allclose(single, coordinate(warp, angle), atol=2e-7)


@pytest.mark.parametrize(
    "make",
    [
        lambda: Bezier(alpha=1.1),
        lambda: Bezier(extent=1.0),
        lambda: Power(exponent=0.0),
        lambda: FarPower(exponent=-1.0),
        lambda: uniform(0.0),
    ],
)
def test_refuses_what_is_not_monotone(make):
    with pytest.raises(ParameterError):
        make()


def test_unknown_kind_names_the_known_ones():
    with pytest.raises(UnknownNameError, match="Bezier"):
        warp_from({"kind": "Bezeir"})
