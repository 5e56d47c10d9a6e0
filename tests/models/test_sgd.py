"""SGD against the paper's equations, computed with 40 digits."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest

from brdf import materials
from brdf.formula.bound import Bound, bound_value
from brdf.formula.vec import Vec
from brdf.materials import catalogue
from brdf.models import SGD
from lobes import direction, half_vectors

MATERIALS = [
    "gold-metallic-paint",  # a broad lobe
    "steel",  # alpha = 6e-5, k = 603
    "chrome",  # k = 856
    "ss440",  # c = 1.6e109
    "tungsten-carbide",  # c beyond single precision, too
    "beige-fabric",  # p = 2e-12, F0 = 8.5 against F1 = 7.5
    "white-paint",  # F dips below zero
]


def exact(m: SGD, channel: int, wi: np.ndarray, wo: np.ndarray) -> float:
    """The paper's equations in angles, one channel, with the logarithm of c undone."""
    q = {name: mpmath.mpf(float(np.asarray(value)[channel])) for name, value in m.values.items()}
    a, b = ([mpmath.mpf(float(x)) for x in w] for w in (wi, wo))
    h = [x + y for x, y in zip(a, b, strict=True)]
    norm = mpmath.sqrt(sum(x * x for x in h))
    cos_h, cos_d = h[2] / norm, sum(x * y for x, y in zip(a, h, strict=True)) / norm
    theta_h = mpmath.acos(cos_h)

    x = q["alpha"] + mpmath.tan(theta_h) ** 2 / q["alpha"]
    P22 = q["K"] * mpmath.exp(-x) / x ** q["p"]
    D = P22 / (mpmath.pi * cos_h**4)
    F = q["F0"] + (1 - q["F0"]) * (1 - cos_d) ** 5 - q["F1"] * cos_d

    def G1(w: list[mpmath.mpf]) -> mpmath.mpf:
        t = mpmath.acos(w[2] / mpmath.sqrt(sum(x * x for x in w))) - q["theta0"]
        if t <= 0:
            return mpmath.mpf(1)
        exponent = mpmath.exp(q["log_c"]) * t ** q["k"]
        if exponent > 1000:
            return mpmath.mpf(0)
        return min(mpmath.mpf(1), max(mpmath.mpf(0), 1 + q["Lambda"] * (1 - mpmath.exp(exponent))))

    return float((q["kd"] + q["ks"] * D * max(F, 0) * G1(a) * G1(b) / (a[2] * b[2])) / mpmath.pi)


@pytest.mark.parametrize("name", MATERIALS)
def test_against_the_equations(name: str) -> None:
    m = materials.get(name)
    rng = np.random.default_rng(3)
    pairs = [(direction(0), direction(0)), (direction(80), direction(80, 180)), (direction(89), direction(20, 70))]
    for spread in (1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5):
        for theta in (5.0, 35.0, 60.0, 80.0):
            wi = direction(theta, rng.uniform(0, 360))
            wo = wi * [-1, -1, 1] + spread * rng.normal(size=3)
            wo[2] = abs(wo[2])
            pairs.append((wi, wo / np.linalg.norm(wo)))
    with mpmath.workdps(40):
        expected = np.array([[exact(m, channel, wi, wo) for channel in range(3)] for wi, wo in pairs])
    value = np.array([m(wi, wo) for wi, wo in pairs])
    assert expected.max() > 4 * np.max(m.kd / np.pi)
    np.testing.assert_allclose(value, expected, rtol=1e-9)


def test_published_distributions_are_normalised() -> None:
    """K = 1 / (alpha Gamma(1 - p, alpha)) in all rows: pins down x = alpha + tan^2 / alpha and the 1/pi in D."""
    for name in catalogue.names():
        m = materials.get(name, "bagher_sgd")
        for alpha, p, K in zip(m.alpha, m.p, m.K, strict=True):
            assert float(alpha * mpmath.gammainc(1 - p, alpha)) * K == pytest.approx(1, abs=1e-5), name


def test_distribution_integrates_to_one() -> None:
    m = SGD(kd=0.0, ks=1.0, Lambda=0.0)
    h, solid_angle = half_vectors(300, 4, 1e-6)
    wo = 2 * h[:, 2:] * h - [0, 0, 1]
    # f / (F G) with wi at the normal and the mirror direction of h, times the cosines and pi, is D
    use = wo[:, 2] > 1e-9
    D = m(np.broadcast_to([0.0, 0.0, 1.0], wo[use].shape), wo[use])[:, 0] * np.pi * wo[use, 2]
    # the half vectors beyond 45 degrees mirror the normal below the horizon; the closed form gives their share
    inner = np.sum(D * h[use, 2] * solid_angle[use])
    x45 = 0.1 + 1 / 0.1
    beyond = float(mpmath.gammainc(0.5, x45) / mpmath.gammainc(0.5, 0.1))
    assert inner == pytest.approx(1 - beyond, abs=2e-3)


def test_masking_reaches_zero_and_one() -> None:
    m = materials.get("ss440")
    part = Bound(m, lambda name: bound_value(m.values[name], np.float32))
    theta = np.radians(np.float32([0, 10, 89.9, 90]))
    w = Vec(np.sin(theta), 0 * theta, np.cos(theta).clip(0))
    for channel in part.G1(w):
        assert channel[0] == 1
        assert ((channel >= 0) & (channel <= 1)).all()


def test_single_precision_keeps_the_masking_of_a_huge_depth() -> None:
    """Lambda (exp(z) - 1) with Lambda = 1e7 and z = 5e-8: the difference from 1 must not round away."""
    m = SGD(Lambda=1e7, log_c=np.log(5e-8), k=0.0, theta0=-0.1)
    for number in (np.float32, np.float64):
        part = Bound(m, lambda name, number=number: bound_value(m.values[name], number))
        assert part.G1(Vec(number(0), number(0), number(1)))[0] == pytest.approx(0.5, rel=1e-5)
