"""Compiled loops over a periodic height field: rays along it, local frames, gathered light.

Heights are in texels; texel (row, column) stands at x = column, y = -row, and between texels the field is bilinear. The
loops work on ranges of texels and release the interpreter lock.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, TypeVar

import numba
import numpy as np

from ...formula.machine_code import kept_on_disk

Function = TypeVar("Function", bound=Callable[..., Any])


def compiled(function: Function) -> Function:
    """The function as machine code, made when it is first called."""
    njit: Any = numba.njit
    made: Function = njit(nogil=True, cache=kept_on_disk(), error_model="numpy")(function)
    return made


TILES = 4
"""How many times its width a ray is followed over the field."""
CLEARANCE = 1e-4
"""Texels by which ground must rise above a ray to stop it: a plane does not shadow itself."""


@compiled
def _ground(height: Any, row: float, column: float) -> float:
    """The field at a place in [0, n)."""
    n = height.shape[0]
    r, c = int(row), int(column)
    y, x = row - r, column - c
    below, right = (r + 1 if r + 1 < n else 0), (c + 1 if c + 1 < n else 0)
    upper = (1 - x) * height[r, c] + x * height[r, right]
    lower = (1 - x) * height[below, c] + x * height[below, right]
    value: float = (1 - y) * upper + y * lower
    return value


@compiled
def _wrapped(place: float, n: int) -> float:
    """A place within one tile of [0, n), in it."""
    if place < 0:
        place += n
    return place if place < n else max(place - n, 0.0)


@compiled
def _texel(n: int, row: float, column: float) -> int:
    r, c = math.floor(row + 0.5), math.floor(column + 0.5)
    return (r - n * (r // n)) * n + c - n * (c // n)


@compiled
def _first_hit(height: Any, top: float, row: float, column: float, z: float, x: float, y: float, up: float) -> int:
    """The texel, as a flat index, that the ray towards (x, y, up) meets first; -1 for none."""
    n = height.shape[0]
    major = max(abs(x), abs(y))
    if major < 1e-9 * abs(up):
        return -1 if up >= 0 else _texel(n, row, column)
    d_row, d_column, rise = -y / major, x / major, up / major
    row, column = _wrapped(row % n, n), _wrapped(column % n, n)
    above = z - _ground(height, row, column)
    away = above > CLEARANCE  # a ray that leaves the ground and is stopped at once meets the next texel, not its own
    for _ in range(TILES * n):
        row, column, z = _wrapped(row + d_row, n), _wrapped(column + d_column, n), z + rise
        if rise >= 0 and z > top:
            return -1
        clear = z - _ground(height, row, column)
        if clear < -CLEARANCE:
            back = clear / (clear - max(above, 0.0)) if away else 0.0
            return _texel(n, row - back * d_row, column - back * d_column)
        above, away = clear, True
    return -1


@compiled
def lit(start: int, stop: int, height: Any, top: float, w: Any, out: Any) -> None:
    """out[i - start] = whether the direction w is free of ground, seen from texel i."""
    n = height.shape[0]
    for i in range(start, stop):
        r, c = i // n, i % n
        out[i - start] = _first_hit(height, top, r, c, height[r, c], w[0], w[1], w[2]) < 0


@compiled
def seen(start: int, stop: int, height: Any, top: float, w: Any, out: Any) -> None:
    """out[i] = the texel that a viewer in direction w sees where texel i of the plane z = 0 would be."""
    n = height.shape[0]
    for i in range(start, stop):
        r, c = i // n, i % n
        far = (top + 1) / w[2]
        hit = _first_hit(height, top, r - far * w[1], c + far * w[0], top + 1, -w[0], -w[1], -w[2])
        out[i] = hit if hit >= 0 else i


@compiled
def _frame(height: Any, i: int) -> Any:
    """Tangent and bitangent and normal, from central differences; the tangent runs along x."""
    n = height.shape[0]
    r, c = i // n, i % n
    slope_x = (height[r, (c + 1) % n] - height[r, c - 1]) / 2
    slope_y = (height[r - 1, c] - height[(r + 1) % n, c]) / 2
    a = 1 / math.sqrt(1 + slope_x * slope_x)
    b = 1 / math.sqrt(1 + slope_x * slope_x + slope_y * slope_y)
    normal = (-slope_x * b, -slope_y * b, b)
    tangent = (a, 0.0, slope_x * a)
    bitangent = (
        normal[1] * tangent[2] - normal[2] * tangent[1],
        normal[2] * tangent[0] - normal[0] * tangent[2],
        normal[0] * tangent[1] - normal[1] * tangent[0],
    )
    return tangent, bitangent, normal


@compiled
def local(height: Any, texels: Any, w: Any, least: float, out: Any) -> None:
    """out[j] = direction w in the frame of texel texels[j], lifted to a cosine of at least `least`."""
    for j in range(len(texels)):
        tangent, bitangent, normal = _frame(height, texels[j])
        x = w[0] * tangent[0] + w[1] * tangent[1] + w[2] * tangent[2]
        y = w[0] * bitangent[0] + w[1] * bitangent[1] + w[2] * bitangent[2]
        z = max(w[0] * normal[0] + w[1] * normal[1] + w[2] * normal[2], least)
        scale = 1 / math.sqrt(x * x + y * y + z * z)
        out[j, 0], out[j, 1], out[j, 2] = x * scale, y * scale, z * scale


@compiled
def _random(key: int) -> float:
    """A number in [0, 1) from an integer: the finaliser of a well-mixed hash."""
    x = np.uint32(key)
    x = np.uint32((x ^ (x >> np.uint32(16))) * np.uint32(0x7FEB352D))
    x = np.uint32((x ^ (x >> np.uint32(15))) * np.uint32(0x846CA68B))
    return np.float64(x ^ (x >> np.uint32(16))) / 4294967296.0


@compiled
def neighbours(start: int, stop: int, height: Any, top: float, seed: int, out: Any) -> None:
    """out[i, k] = the texel that texel i sees in the k-th of K directions, -1 for the sky.

    The directions follow the cosine to the texel's normal: one in each of K rings of equal weight, the golden angle
    apart, turned at random from texel to texel.
    """
    n, count = height.shape[0], out.shape[1]
    golden = math.pi * (3 - math.sqrt(5))
    for i in range(start, stop):
        tangent, bitangent, normal = _frame(height, i)
        turn = 2 * math.pi * _random(2 * i + 7919 * seed)
        shift = _random(2 * i + 1 + 7919 * seed)
        r, c = i // n, i % n
        for k in range(count):
            share = (k + shift) / count
            sine, cosine = math.sqrt(share), math.sqrt(1 - share)
            a, b = sine * math.cos(turn + k * golden), sine * math.sin(turn + k * golden)
            x = a * tangent[0] + b * bitangent[0] + cosine * normal[0]
            y = a * tangent[1] + b * bitangent[1] + cosine * normal[1]
            z = a * tangent[2] + b * bitangent[2] + cosine * normal[2]
            out[i, k] = _first_hit(height, top, r, c, height[r, c], x, y, z)


@compiled
def gathered(texels: Any, neighbour: Any, radiance: Any, out: Any) -> None:
    """out[j] = mean over the directions of texel texels[j] of the radiance met there."""
    count = neighbour.shape[1]
    for j in range(len(texels)):
        for channel in range(3):
            out[j, channel] = 0
        for k in range(count):
            m = neighbour[texels[j], k]
            if m >= 0:
                for channel in range(3):
                    out[j, channel] += radiance[m, channel] / count
