# mypy: allow-untyped-defs, allow-untyped-calls
"""Fits of curves to the samples s_i of every texel and channel at increasing x_i, the last of them 1.

Loops over texels [start, stop) of `samples` (T, N, 3); `out` (T, 6) takes two numbers a channel. The exponent K is
looked for twice: in wide steps, then in narrow ones around the best of them.
Reference: Kautz2004, section 5.
"""

from __future__ import annotations

import math
from typing import Any

import numba
import numpy as np

from ...formula.machine_code import kept_on_disk

_njit: Any = numba.njit(nogil=True, cache=kept_on_disk(), error_model="numpy")

STEP, WIDE = 0.01, 25
"""The narrow step of the exponent, and how many of them make a wide one."""
LEAST, MOST = 0.05, 10.0
"""Bounds of the exponent: what darkens with the light (a highlight that moves on) would drive it to zero."""
FLOOR = np.float32(1e-4)
"""Samples below this share of the brightest count as this much where a logarithm is taken."""


def powers_table(x: Any) -> Any:
    """x_i^K for K = 0, STEP, … up to MOST: (steps, N) float32."""
    exponents = np.arange(round(MOST / STEP) + 1) * STEP
    return np.ascontiguousarray(np.asarray(x)[None, :] ** exponents[:, None], np.float32)


@_njit
def _misfit_of_end(s, n, channel, k, table, row, count):
    """Squared error of k x^K at the samples before the last, where k is the last."""
    total = np.float32(0)
    for i in range(count - 1):
        d = s[n, i, channel] - k * table[row, i]
        total += d * d
    return total


@_njit
def _misfit_of_best(s, n, channel, table, row, count):
    """Squared error of k x^K at all samples with the best k, less the sum of squares of the samples."""
    cross, square = 0.0, 0.0  # in double precision: near the best the errors differ little
    for i in range(count):
        p = np.float64(table[row, i])
        cross += s[n, i, channel] * p
        square += p * p
    return -cross * cross / square


@_njit
def _search(s, n, channel, k, table, count, joint):
    """The row of the table with the least misfit."""
    best, where = np.inf, 0
    last = table.shape[0] - 1
    for step in range(0, last + 1, WIDE):
        e = _misfit_of_best(s, n, channel, table, step, count) if joint else _misfit_of_end(
            s, n, channel, k, table, step, count)  # fmt: skip
        if e < best:
            best, where = e, step
    middle = where
    for step in range(max(middle - WIDE, 0), min(middle + WIDE, last) + 1):
        e = _misfit_of_best(s, n, channel, table, step, count) if joint else _misfit_of_end(
            s, n, channel, k, table, step, count)  # fmt: skip
        if e < best:
            best, where = e, step
    return where


@_njit
def searched(start, stop, samples, table, joint, out):
    """k, K by search in `table`; k is the brightest sample, or the best one where `joint`."""
    count = samples.shape[1]
    for n in range(start, stop):
        for c in range(3):
            k = samples[n, count - 1, c]
            row = _search(samples, n, c, k, table, count, joint)
            row = min(max(row, round(LEAST / STEP)), table.shape[0] - 1)
            if joint:
                cross, square = np.float32(0), np.float32(0)
                for i in range(count):
                    cross += samples[n, i, c] * table[row, i]
                    square += table[row, i] * table[row, i]
                k = cross / square
            out[n, c] = k
            out[n, 3 + c] = row * STEP if k > 0 else 1.0


@_njit
def solved(start, stop, samples, logarithms, steps, out):
    """k the brightest sample, K from the logarithms weighted by s², then `steps` of Gauss and Newton."""
    count = samples.shape[1]
    for n in range(start, stop):
        for c in range(3):
            k = samples[n, count - 1, c]
            K = np.float32(1)
            if k > 0:
                above, below = np.float32(0), np.float32(0)
                for i in range(count - 1):
                    s = samples[n, i, c]
                    weighted = s * s * logarithms[i]
                    above += weighted * math.log(max(s / k, FLOOR))
                    below += weighted * logarithms[i]
                K = min(max(above / below, np.float32(LEAST)), np.float32(MOST)) if below > 0 else np.float32(MOST)
                for _ in range(steps):
                    above, below = np.float32(0), np.float32(0)
                    for i in range(count - 1):
                        p = k * math.exp(K * logarithms[i])
                        slope = p * logarithms[i]
                        above += (p - samples[n, i, c]) * slope
                        below += slope * slope
                    if below > 0:
                        K = min(max(K - above / below, np.float32(LEAST)), np.float32(MOST))
            out[n, c] = k
            out[n, 3 + c] = K


@_njit
def projected(start, stop, samples, operator, out):
    """The best p, q of s = p x + q x²: a linear `operator` (2, N) on the samples."""
    count = samples.shape[1]
    for n in range(start, stop):
        for c in range(3):
            p, q = np.float32(0), np.float32(0)
            for i in range(count):
                p += operator[0, i] * samples[n, i, c]
                q += operator[1, i] * samples[n, i, c]
            out[n, c] = p
            out[n, 3 + c] = q
