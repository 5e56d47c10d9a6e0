"""Powers of cosines near 1, where sharp lobes live."""

from __future__ import annotations

from ...formula import Scalar, exp, log, maximum, where


def power_of_one_minus(d: Scalar, n: Scalar) -> Scalar:
    """(1 - d)^n for 0 <= d <= 1 and n >= 0, accurate for small d and large n in single precision.

    A cosine close to 1 has lost its distance d from 1 to rounding, and n multiplies the loss; d itself, computed from
    sines, has not. log(1 - d) = -2 artanh(y), y = d / (2 - d): five terms of its series are exact to double
    precision for d < 0.05.
    """
    y = d / (2.0 - d)
    y2 = y * y
    series = -2.0 * y * (1.0 + y2 * (1 / 3 + y2 * (1 / 5 + y2 * (1 / 7 + y2 * (1 / 9 + y2 * (1 / 11))))))
    return exp(n * where(d < 0.05, series, log(maximum(1.0 - d, 1e-30))))
