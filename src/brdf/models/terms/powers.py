"""Powers of cosines near 1, where sharp lobes live."""

from __future__ import annotations

from ...formula import Scalar, Vec, dot, exp, log, maximum, minimum, where


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


def positive_power_of_one_minus(d: Scalar, n: Scalar) -> Scalar:
    """max(0, 1 - d)^n for d >= 0; zero beyond d = 1, for n = 0, too."""
    lobe = power_of_one_minus(minimum(d, 1.0), n)
    return where(d < 1.0, lobe, 0.0 * lobe)


def mirror_lobe(wi: Vec, wo: Vec, n: Scalar) -> Scalar:
    """max(0, r . wo)^n with r, the mirror direction of wi."""
    # 1 - r . wo, from the chord between the two unit vectors: keeps its digits inside a sharp lobe
    x, y, z = wo.x + wi.x, wo.y + wi.y, wo.z - wi.z
    return positive_power_of_one_minus(0.5 * (x * x + y * y + z * z), n)


def half_lobe(wi: Vec, wo: Vec, n: Scalar) -> Scalar:
    """cos^n of the angle between normal and half vector."""
    h = wi + wo
    sin2_h = (h.x * h.x + h.y * h.y) / dot(h, h)
    return power_of_one_minus(sin2_h, 0.5 * n)
