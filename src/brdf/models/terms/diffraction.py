"""The scatter integral of a rough surface in Kirchhoff theory, as He and Torrance's series, in single precision."""

from __future__ import annotations

import math

from ...formula import Scalar, exp, log, maximum, minimum, sqrt, where

TERMS = 36
"""Terms of the series where it is added up: enough for a largest term up to the 16th."""

SWITCH = 16.0
NODES = 6
"""Nodes either side of the largest term where the sum is an integral."""

STEP = 0.8
"""Their distance in standard deviations: the rule's error is exp(-2 pi^2 / STEP^2), 4e-14."""


def lambert_w(z: Scalar) -> Scalar:
    """The w >= 0 with w exp(w) = z, for 0 <= z <= 1e36. Reference: Corless1996."""
    z = minimum(z, 1e36)
    L = log(1.0 + z)
    w = maximum(L * (1.0 - log(1.0 + L) / (2.0 + L)), 1e-30)
    for _ in range(3):  # Newton's method on log w + w = log z, from within 2 %
        w = maximum(w / (1.0 + w) * (1.0 + log(maximum(z, 1e-30) / w)), 1e-30)
    return w


def poisson_sum(g: Scalar, e: Scalar) -> Scalar:
    """The sum over m >= 1 of exp(-g) g^m / (m! m) exp(-e / m), for g, e >= 0.

    The terms are largest where m^2 log(m / g) = e. Where that is below 16 the first 36 terms are added; beyond, they
    vary so slowly that the sum is the integral over m, which the trapezoidal rule takes in sqrt(m), where a Poisson
    distribution is nearly normal, and with m! by Stirling's series. Relative error below 1e-4.
    """
    g = maximum(g, 1e-15)
    y = 0.5 * lambert_w(minimum(2.0 * e / g / g, 1e36))
    largest = g * exp(minimum(y, 60.0))
    direct, integral = _added_up(g, e), _integrated(g, e, y, largest)
    return where(largest < SWITCH, direct, integral)


def _added_up(g: Scalar, e: Scalar) -> Scalar:
    log_g, total = log(g), 0.0
    for m in range(1, TERMS + 1):
        total = total + exp(m * log_g - g - e * (1.0 / m) - (math.lgamma(m + 1) + math.log(m)))
    return total


def _integrated(g: Scalar, e: Scalar, y: Scalar, largest: Scalar) -> Scalar:
    centre = sqrt(maximum(largest, SWITCH))
    step = 0.5 * STEP / sqrt(1.0 + 2.0 * y)  # the deviation of sqrt(m) is 1/2, less where e pulls the largest term up
    total = 0.0
    for k in range(-NODES, NODES + 1):
        root = centre + float(k) * step
        m = root * root
        stirling = (1.0 - 1.0 / (30.0 * m * m)) / (12.0 * m)
        # exp(-g) g^m / m! = exp(-m psi(g / m) - stirling) / sqrt(2 pi m);   dm = 2 root d(root)
        total = total + exp(-(m * _psi(g / m) + stirling + e / m)) / m
    return total * step * (2.0 / math.sqrt(2.0 * math.pi))


def _psi(r: Scalar) -> Scalar:
    """r - 1 - log r >= 0 without cancellation near 1."""
    t = r - 1.0
    y = t / (2.0 + t)
    y2 = y * y
    near = t * y - 2.0 * y * y2 * (1 / 3 + y2 * (1 / 5 + y2 * (1 / 7 + y2 * (1 / 9 + y2 * (1 / 11 + y2 / 13)))))
    return where(y2 < 0.04, near, t - log(maximum(r, 1e-30)))
