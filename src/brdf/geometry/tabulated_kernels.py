"""The compiled loops of `tabulated_sampler`: one direction at a time.

The functions are plain Python; `compiled` turns one into a kernel for an array type when it is first needed.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

from numba import njit, types

from ..formula.machine_code import kept_on_disk
from .search import first_above

SIZES = types.UniTuple(types.int64, 4)  # type: ignore[no-untyped-call]


@functools.cache
def compiled(function: Callable[..., None], real: str) -> Callable[..., None]:
    """The kernel of `sample` or `density` for `real` = "float32" | "float64" directions."""
    number = getattr(types, real)
    directions = types.Array(number, 2, "A", readonly=True)
    table = types.Array(types.float64, 1, "C", readonly=True)
    arrays = {
        sample: (directions, types.Array(types.float64, 2, "A", readonly=True), table, table, table),
        density: (directions, directions, table, table),
    }[function]
    out = types.Array(number, 2 if function is sample else 1, "C")
    signature = types.void(types.int64, types.int64, *arrays, SIZES, types.float64, types.boolean, out)
    kernel: Callable[..., None] = njit(signature, nogil=True, cache=kept_on_disk(), error_model="numpy")(function)
    return kernel


@njit(error_model="numpy", nogil=True)
def _azimuth(x, y):  # type: ignore[no-untyped-def]
    """Cosine and sine of the azimuth; 1 and 0 along the normal."""
    radius = math.sqrt(x * x + y * y)
    inverse = 1.0 / radius if radius > 0 else 0.0
    return (x * inverse, y * inverse) if radius > 0 else (1.0, 0.0)


@njit(error_model="numpy", nogil=True)
def _position(z, last, count):  # type: ignore[no-untyped-def]
    """Lower node of the polar angle with cosine z, and the weight of the next one."""
    position = min(math.acos(min(max(z, -1.0), 1.0)) / last, 1.0) * (count - 1)
    lower = min(int(position), count - 2)
    return lower, position - lower


@njit(error_model="numpy", nogil=True)
def _around(x, y, count):  # type: ignore[no-untyped-def]
    """Lower node of the azimuth, the next one, and the weight of the next one."""
    position = math.atan2(y, x) * (count / (2 * math.pi))
    lower = math.floor(position)
    return int(lower) % count, (int(lower) + 1) % count, position - lower


@njit(error_model="numpy", nogil=True)
def _left_over(u, share, happens):  # type: ignore[no-untyped-def]
    """The uniform number in [0, 1) left of `u` once it has decided what happens with probability `share`."""
    left = u / share if happens else (u - share) / (1.0 - share)
    return min(max(left, 0.0), 1.0 - 2.0**-53)


@njit(error_model="numpy", nogil=True)
def _inverted(cumulative, row, u, size):  # type: ignore[no-untyped-def]
    """The entry of a row of cumulative probabilities that `u` falls into, and where in it, in [0, 1]."""
    first = row * size
    low = first_above(cumulative, u, first, first + size - 1)
    below = cumulative[low - 1] if low > first else 0.0
    width = cumulative[low] - below
    return low, min(max((u - below) / width, 0.0), 1.0) if width > 0 else 0.5


def sample(start, stop, wo, u, shares, rings, sectors, sizes, last, isotropic, wi):  # type: ignore[no-untyped-def]
    """Fills wi[start:stop] with directions drawn for viewing directions `wo` with numbers `u` (N, 2)."""
    n_theta_o, n_phi_o, n_theta_h, n_phi_h = sizes
    for i in range(start, stop):
        x, y, z = float(wo[i, 0]), float(wo[i, 1]), float(wo[i, 2])
        first, second = u[i, 0], u[i, 1]
        node, weight = _position(z, last, n_theta_o)
        up = first < weight
        first = _left_over(first, weight, up)
        node = (node + 1 if up else node) * n_phi_o
        if n_phi_o > 1:
            lower, upper, weight = _around(x, y, n_phi_o)
            up = first < weight
            first = _left_over(first, weight, up)
            node += upper if up else lower
        diffuse = first < shares[node]
        first = _left_over(first, shares[node], diffuse)
        if diffuse:
            radius, phi = math.sqrt(first), 2 * math.pi * second
            wi[i, 0], wi[i, 1] = radius * math.cos(phi), radius * math.sin(phi)
            wi[i, 2] = math.sqrt(max(1.0 - first, 0.0))
            continue

        ring, along = _inverted(rings, node, first, n_theta_h)
        sector, around = _inverted(sectors, ring, second, n_phi_h)
        inner, outer = ((ring % n_theta_h) / n_theta_h) ** 6, ((ring % n_theta_h + 1) / n_theta_h) ** 6
        t = inner + along * (outer - inner)
        phi = (sector % n_phi_h + around) * (2 * math.pi / n_phi_h)
        radius, cosine, sine = math.sqrt(t * (2 - t)), math.cos(phi), math.sin(phi)
        if isotropic:
            cos_o, sin_o = _azimuth(x, y)
            cosine, sine = cosine * cos_o - sine * sin_o, sine * cos_o + cosine * sin_o
        hx, hy, hz = radius * cosine, radius * sine, 1 - t
        twice = 2 * (x * hx + y * hy + z * hz)
        wi[i, 0], wi[i, 1], wi[i, 2] = twice * hx - x, twice * hy - y, twice * hz - z


def density(start, stop, wi, wo, shares, densities, sizes, last, isotropic, pdf):  # type: ignore[no-untyped-def]
    """Fills pdf[start:stop] with the density of `sample` [1/sr]."""
    n_theta_o, n_phi_o, n_theta_h, n_phi_h = sizes
    cells = n_theta_h * n_phi_h
    for i in range(start, stop):
        pdf[i] = 0
        x, y, z = float(wo[i, 0]), float(wo[i, 1]), float(wo[i, 2])
        cosine = float(wi[i, 2])
        if not (cosine > 0 and z > 0):
            continue
        hx, hy, hz = wi[i, 0] + x, wi[i, 1] + y, cosine + z
        length = math.sqrt(hx * hx + hy * hy + hz * hz)
        inverse = 1.0 / length
        hx, hy, hz = hx * inverse, hy * inverse, hz * inverse
        t = min((hx * hx + hy * hy) / (1 + hz), 1.0)
        ring = min(int(t ** (1 / 6) * n_theta_h), n_theta_h - 1)
        if isotropic:
            cos_o, sin_o = _azimuth(x, y)
            hx, hy = hx * cos_o + hy * sin_o, hy * cos_o - hx * sin_o
        sector = math.floor(math.atan2(hy, hx) * (n_phi_h / (2 * math.pi)))
        cell = ring * n_phi_h + (int(sector) + n_phi_h if sector < 0 else int(sector))

        lower, weight = _position(z, last, n_theta_o)
        left, right, turn = _around(x, y, n_phi_o) if n_phi_o > 1 else (0, 0, 0.0)
        share = lobe = 0.0
        for a in range(2):
            for b in range(2 if n_phi_o > 1 else 1):
                node = (lower + a) * n_phi_o + (right if b else left)
                blend = (weight if a else 1 - weight) * (turn if b else 1 - turn)
                share += blend * shares[node]
                lobe += blend * densities[node * cells + cell]
        # a half vector's solid angle is that of wi over 4 wo.h, and wo.h is half the length of wi + wo
        pdf[i] = share * cosine * (1 / math.pi) + 2 * lobe * inverse
