"""Exponentials near the points where their plain forms lose all digits."""

from __future__ import annotations

from ...formula import Scalar, abs, exp, where


def mean_exponential(x: Scalar) -> Scalar:
    """(exp(x) - 1) / x, the mean of exp over [0, x]; 1 at 0."""
    series = 1.0 + x / 14.0
    for denominator in range(13, 1, -1):
        series = 1.0 + x * series / float(denominator)
    small = abs(x) < 0.5
    return where(small, series, (exp(x) - 1.0) / where(small, 1.0 + 0.0 * x, x))
