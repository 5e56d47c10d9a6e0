"""Powers of cosines about the mirror direction and of the half vector, the shape of the empirical highlights."""

from __future__ import annotations

from ...formula import Scalar, Vec, dot, minimum, where
from .powers import power_of_one_minus


def positive_power_of_one_minus(d: Scalar, n: Scalar) -> Scalar:
    """max(0, 1 - d)^n for d >= 0, and 0 where d >= 1 whatever n."""
    lobe = power_of_one_minus(minimum(d, 1.0), n)
    return where(d < 1.0, lobe, 0.0 * lobe)


def mirror_lobe(wi: Vec, wo: Vec, n: Scalar) -> Scalar:
    """max(0, r . wo)^n about the mirror direction r = (-wi.x, -wi.y, wi.z)."""
    # 1 - r . wo, from the chord between the two unit vectors: keeps its digits inside a sharp lobe
    x, y, z = wo.x + wi.x, wo.y + wi.y, wo.z - wi.z
    return positive_power_of_one_minus(0.5 * (x * x + y * y + z * z), n)


def half_lobe(wi: Vec, wo: Vec, n: Scalar) -> Scalar:
    """cos^n(theta_h) of the half vector."""
    h = wi + wo
    return power_of_one_minus((h.x * h.x + h.y * h.y) / dot(h, h), 0.5 * n)
