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
    Chord,
    Circle,
    FarPower,
    Power,
    Spline,
    SquaredSine,
    TwoSided,
    Warp,
    identity,
    listed,
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
    SquaredSine(),
    *(Bezier(alpha=a) for a in (0.0, 0.25, 0.5, 0.5841, 0.75, 1.0)),
    *(Bezier(math.pi, a) for a in (0.2, 1.0)),
    Chord(),
    Chord(math.pi, 1.5),
    Spline(weights=(1.0, 1.0)),
    Spline(weights=(30.0, 4.0, 1.0, 2.0, 0.2, 5.0)),
    Spline(HALF_PI, square_root(), tuple(np.geomspace(1, 1e-3, 16))),
    TwoSided(),
    TwoSided(half=Bezier(math.pi, 0.2)),
    listed(np.radians([0, 5, 10, 15, 20, 30, 40, 50, 60, 70, 80, 90])),
    listed(np.radians([0, 1, 5, 90, 200, 360])),
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


@pytest.mark.parametrize("warp", [*WARPS, Circle(), Circle(math.pi)], ids=str)
def test_density_is_the_derivative_of_the_coordinate(warp):
    angles = np.linspace(0.02, 0.98, 200) * warp.extent  # off the middle, where a two-sided warp has a corner
    step = 1e-5
    slope = (coordinate(warp, angles + step) - coordinate(warp, angles - step)) / (2 * step)
    np.testing.assert_allclose(warp.density(angles), slope, rtol=2e-5, atol=2e-5)


def test_density_at_the_ends_of_the_curve():
    """sqrt(2) (1 - alpha) at the pole, alpha at 90 degrees; an identity is a sine, even angles are even."""
    for alpha in (0.0, 0.25, 0.5, 0.5841, 1.0):
        np.testing.assert_allclose(
            Bezier(alpha=alpha).density([0, HALF_PI]), [math.sqrt(2) * (1 - alpha), alpha], atol=1e-15
        )
    angles = np.linspace(0, HALF_PI, 20)
    np.testing.assert_allclose(identity().density(angles), np.sin(angles), atol=1e-15)
    np.testing.assert_allclose(uniform().density(angles), 2 / math.pi, atol=1e-15)


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


# its inverse, evaluated by hand
INVERSE = {
    0.0: (0, 0.532455532, 0.75, 0.914213562, 0.982050808, 0.997366596, 1),
    0.25: (0, 0.312461180, 0.598076211, 0.854101966, 0.968626967, 0.995346319, 1),
    0.5: (0, 0.19, 0.4375, 0.75, 0.9375, 0.99, 1),
    0.5841: (0, 0.165853284, 0.393220040, 0.706499654, 0.919219949, 0.986209580, 1),
}


@pytest.mark.parametrize(("alpha", "expected"), INVERSE.items())
def test_bezier_inverse(alpha, expected):
    s = np.array([0, 0.1, 0.25, 0.5, 0.75, 0.9, 1])
    np.testing.assert_allclose(np.cos(Bezier(alpha=alpha).angle(1 - s)), expected, atol=6e-10)


@pytest.mark.parametrize("alpha", [0.0, 0.25, 0.5, 0.5841, 0.75, 1.0])
def test_bezier_comes_back_to_the_last_digits(alpha):
    s = np.linspace(0, 1, 20001)
    warp = Bezier(alpha=alpha)
    np.testing.assert_allclose(coordinate(warp, warp.angle(s)), s, atol=3e-12)
    x = np.linspace(0, 1, 20001)
    np.testing.assert_allclose(np.cos(warp.angle(coordinate(warp, np.arccos(x)))), x, atol=1e-12)


def test_limits_of_the_curve_are_exact():
    x = np.linspace(0, 1, 101)
    angles = Angle(np.sqrt(1 - x * x), x)
    np.testing.assert_array_equal(1 - Bezier(alpha=1.0).coordinate(angles), 1 - (1 - x))
    np.testing.assert_allclose(1 - Bezier(alpha=0.5).coordinate(angles), 1 - np.sqrt(1 - x), atol=2e-16)
    np.testing.assert_allclose(1 - Bezier(alpha=0.0).coordinate(angles), 2 - 2 * np.sqrt(1 - x) - x, atol=4e-16)


def test_bezier_is_nearly_uniform():
    """The published 0.5841: within 0.0078 of even angles, next to the best there is (0.0077 at 0.58388)."""
    angles = np.linspace(0, HALF_PI, 4001)
    apart = {a: np.abs(coordinate(Bezier(alpha=a), angles) - angles / HALF_PI).max() for a in (0.5841, 0.58388)}
    assert apart == pytest.approx({0.5841: 0.007809, 0.58388: 0.007727}, abs=2e-6)


def test_bezier_parametric_form():
    t = np.linspace(0, 1, 101)
    x, y = 1 - (1 - t) ** 2, 2 * 0.3 * t + 0.4 * t**2
    np.testing.assert_allclose(1 - coordinate(Bezier(alpha=0.3), np.arccos(x)), y, atol=1e-7)


def test_bezier_over_half_a_turn_is_odd_about_the_middle():
    warp, angles = Bezier(math.pi, 0.2), np.linspace(0, HALF_PI, 50)
    np.testing.assert_allclose(coordinate(warp, math.pi - angles), 1 - coordinate(warp, angles), atol=1e-12)


@pytest.mark.parametrize(
    ("alpha", "degrees"),
    [
        (1.0, (10.2222, 60.5237, 89.0905)),
        (0.0, (0.6457, 24.3726, 76.3433)),
        (0.25, (0.8605, 31.9391, 86.5231)),
        (0.5841, (1.5404, 45.7357, 88.4504)),
        (0.65, (1.8199, 48.5112, 88.6053)),
    ],
)
def test_bezier_node_angles(alpha, degrees):
    nodes = np.degrees(Bezier(alpha=alpha).nodes(64))
    np.testing.assert_allclose(nodes[[1, 32, 62]], degrees, atol=6e-5)


@pytest.mark.parametrize(
    ("warp", "first", "gap"),
    [
        (identity(math.pi), 10.1817, 0.9023),
        (uniform(math.pi), 1.4173, 1.4173),
        (Bezier(math.pi, 0.0), 0.6406, 19.5288),
        (Bezier(math.pi, 0.2), 0.8005, 4.3447),
    ],
    ids=str,
)
def test_node_angles_of_an_azimuth(warp, first, gap):
    nodes = np.degrees(warp.nodes(128))
    np.testing.assert_allclose([nodes[1], nodes[64] - nodes[63]], [first, gap], atol=6e-5)


def test_chord_is_the_fourth_root():
    angles = np.radians([1, 2, 5, 10, 20, 45])
    expected = [0.111091, 0.157103, 0.248369, 0.351080, 0.495556, 0.735660]
    np.testing.assert_allclose(coordinate(Chord(), angles), expected, atol=6e-7)
    np.testing.assert_allclose(coordinate(Chord(), angles), (1 - np.cos(angles)) ** 0.25, rtol=1e-10)


def test_spline_through_even_weights_is_its_base():
    u = np.linspace(0, 1, 50)
    for base in (uniform(), square_root(), Bezier(alpha=0.3)):
        np.testing.assert_allclose(Spline(HALF_PI, base, (2.0, 2.0, 2.0)).angle(u), base.angle(u), atol=1e-12)


def test_spline_density_follows_its_weights():
    warp = Spline(weights=(1.0, 3.0, 1.0))
    np.testing.assert_allclose(warp.density(np.array([0, 0.5, 1]) * HALF_PI) * HALF_PI, [0.5, 1.5, 0.5], atol=1e-12)
    nodes = Spline(weights=(1.0, 1e-3, 1.0)).nodes(101) / HALF_PI
    assert np.sum(np.abs(nodes - 0.5) < 0.1) < 0.05 * 101


def test_circle_meets_itself():
    phi = np.linspace(-7, 7, 300)
    for period in (math.pi, 2 * math.pi):
        u = Circle(period).coordinate(Angle(np.sin(phi), np.cos(phi)))
        apart = np.abs(u - np.mod(phi / period, 1))
        np.testing.assert_allclose(np.minimum(apart, 1 - apart), 0, atol=1e-12)
        np.testing.assert_allclose(Circle(period).nodes(4), np.arange(4) * period / 4)


def test_far_power_puts_the_slices_of_the_stack():
    light_angles = np.degrees(2 * FarPower(math.radians(86), 1.3).nodes(8))
    np.testing.assert_allclose(light_angles, [0, 31.2, 60.9, 88.9, 114.8, 138.3, 158.3, 172], atol=0.06)


def test_square_root_is_merls_axis():
    nodes = square_root((89 / 90) ** 2 * HALF_PI).nodes(90)
    np.testing.assert_allclose(np.degrees(nodes), (np.arange(90) / 90) ** 2 * 90, atol=1e-12)


def test_float32_resolves_the_pole():
    for warp in (square_root(), Bezier(alpha=0.65), Chord(), Spline(HALF_PI, square_root(), (9.0, 2.0, 1.0))):
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
        lambda: Bezier(alpha=-0.01),
        lambda: Bezier(alpha=math.nan),
        lambda: Chord(2 * math.pi),
        lambda: Spline(weights=(1.0, -1.0, 1.0)),
        lambda: Spline(weights=(1.0, 0.0)),
        lambda: Spline(weights=(1.0, math.nan)),
        lambda: Spline(weights=(1.0,)),
        lambda: Spline(weights=(1.0,) * 65),
        lambda: Spline(math.pi, uniform()),
        lambda: Spline(2 * math.pi, Circle()),
    ],
)
def test_refuses_what_is_not_monotone(make):
    with pytest.raises(ParameterError):
        make()


def test_unknown_kind_names_the_known_ones():
    with pytest.raises(UnknownNameError, match="Bezier"):
        warp_from({"kind": "Bezeir"})
