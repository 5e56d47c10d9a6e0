"""The float32 functions against the C library in float64, densely over the ranges formulas use."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.special
from numba import njit

from brdf.formula import math32

COUNT = 400_000
BOUND = 4e-7
rng = np.random.default_rng(7)


def apply(function, *arguments):
    """The function element by element, in a compiled loop."""

    @njit
    def unary(x, out):
        for i in range(out.size):
            out[i] = function(x[i])

    @njit
    def binary(x, y, out):
        for i in range(out.size):
            out[i] = function(x[i], y[i])

    out = np.empty_like(arguments[0])
    (unary if len(arguments) == 1 else binary)(*arguments, out)
    return out


def log_uniform(low, high):
    return np.exp(rng.uniform(low, high, COUNT))


CASES = [
    ("exp", np.exp, (rng.uniform(-87, 88.7, COUNT),), 0),
    ("exp", np.exp, (rng.uniform(-1, 1, COUNT),), 0),
    ("log", np.log, (log_uniform(-87, 88),), 0),
    ("log", np.log, (rng.uniform(0.5, 2, COUNT),), 0),
    ("pow", np.power, (log_uniform(-10, 10), rng.uniform(-8, 8, COUNT)), 0),
    ("pow", np.power, (rng.uniform(0.9, 1, COUNT), rng.uniform(1, 800, COUNT)), 0),
    ("atan2", np.arctan2, (rng.normal(size=COUNT), rng.normal(size=COUNT)), 0),
    ("atan2", np.arctan2, (log_uniform(-30, 10), log_uniform(-30, 10)), 0),
    ("atan", np.arctan, (rng.normal(scale=10, size=COUNT),), 0),
    ("asin", np.arcsin, (rng.uniform(-1, 1, COUNT),), 0),
    ("acos", np.arccos, (rng.uniform(-1, 1, COUNT),), 0),
    ("acos", np.arccos, (1 - log_uniform(-16, 0),), 0),
    ("sin", np.sin, (rng.uniform(-1, 1, COUNT),), 0),
    ("sin", np.sin, (rng.uniform(-1e4, 1e4, COUNT),), 1),
    ("cos", np.cos, (rng.uniform(-1e4, 1e4, COUNT),), 1),
    ("tan", np.tan, (rng.uniform(-1.5, 1.5, COUNT),), 0),
    ("erf", scipy.special.erf, (rng.uniform(-5, 5, COUNT),), 0),
    ("sqrt", np.sqrt, (log_uniform(-80, 80),), 0),
]


@pytest.mark.parametrize(("name", "reference", "arguments", "floor"), CASES, ids=[c[0] for c in CASES])
def test_accuracy(name, reference, arguments, floor):
    arguments = [a.astype(np.float32) for a in arguments]
    value = apply(getattr(math32, name), *arguments).astype(np.float64)
    exact = reference(*(a.astype(np.float64) for a in arguments))
    normal = (np.abs(exact) > 1.2e-38) & (np.abs(exact) < 3.4e38)
    error = np.abs(value - exact)[normal] / np.maximum(np.abs(exact[normal]), floor or 1e-300)
    assert error.max() <= BOUND


@pytest.mark.parametrize(
    ("name", "arguments", "value"),
    [
        ("exp", (1000.0,), np.inf),
        ("exp", (-1000.0,), 0.0),
        ("log", (0.0,), -np.inf),
        ("log", (np.inf,), np.inf),
        ("log", (-1.0,), np.nan),
        ("pow", (0.0, 2.5), 0.0),
        ("pow", (0.0, 0.0), 1.0),
        ("pow", (0.0, -1.0), np.inf),
        ("atan2", (0.0, 0.0), 0.0),
        ("atan2", (0.0, -1.0), np.pi),
        ("acos", (1.0000001,), 0.0),
        ("asin", (-1.0000001,), -np.pi / 2),
        ("sign", (-3.0,), -1.0),
        ("floor", (-1.5,), -2.0),
    ],
)
def test_special_values(name, arguments, value):
    result = apply(getattr(math32, name), *(np.array([a], np.float32) for a in arguments))[0]
    np.testing.assert_allclose(result, np.float32(value), rtol=BOUND)
