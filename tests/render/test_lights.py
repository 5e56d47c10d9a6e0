"""Lights, and how the command line writes them."""

from __future__ import annotations

import numpy as np
import pytest

from brdf.errors import ParameterError, UnknownNameError
from brdf.render.lights import Directional, Point, direction, parse


def test_directions():
    np.testing.assert_allclose(direction(0, 123), [0, 1, 0], atol=1e-15)
    np.testing.assert_allclose(direction(90, 0), [0, 0, 1], atol=1e-15)
    np.testing.assert_allclose(direction(90, 90), [1, 0, 0], atol=1e-15)


def test_parse():
    light = parse("directional:theta=30,phi=45,power=3")
    assert isinstance(light, Directional)
    np.testing.assert_allclose(light.toward, [np.sqrt(2) / 4, np.sqrt(3) / 2, np.sqrt(2) / 4])
    np.testing.assert_array_equal(light.power, [3, 3, 3])
    point = parse("point:1/2/-3,power=1/.9/.8")
    assert isinstance(point, Point)
    np.testing.assert_array_equal(point.position, [1, 2, -3])
    np.testing.assert_array_equal(point.power, [1, 0.9, 0.8])
    np.testing.assert_array_equal(parse("point:position=1/2/3").position, [1, 2, 3])


@pytest.mark.parametrize(
    ("text", "error", "words"),
    [
        ("directonal:theta=3", UnknownNameError, "did you mean 'directional'"),
        ("directional:teta=3", UnknownNameError, "did you mean 'theta'"),
        ("directional:30", ParameterError, "option=value"),
        ("directional:theta=x", ParameterError, "theta must be a number, got 'x'"),
        ("directional:theta=nan", ParameterError, "finite"),
        ("directional:theta=1,theta=2", ParameterError, "given twice"),
        ("directional:power=-1", ParameterError, ">= 0"),
        ("point:1/2", ParameterError, "three numbers x/y/z, got '1/2'"),
        ("point:power=2", ParameterError, "needs its position"),
    ],
)
def test_parse_says_what_is_wrong(text, error, words):
    with pytest.raises(error, match=words):
        parse(text)


def test_point_light_in_the_surface_lights_nothing_there():
    toward, distance, irradiance = Point((1, 2, 3)).seen_from(np.array([[1, 2, 3], [1, 2, 5]], np.float32))
    assert np.isfinite(toward).all()
    np.testing.assert_allclose(distance, [0, 2])
    np.testing.assert_allclose(irradiance, [[0] * 3, [np.pi / 4] * 3], rtol=1e-6)


@pytest.mark.parametrize("text", ["directional:theta=30,phi=-45,power=3/2/1", "point:1/2/-3,power=0.5/0.5/0.5"])
def test_lights_are_written_as_they_are_read(text):
    assert str(parse(text)) == text
