"""Photographs left out, predicted from the rest: what a capture is worth."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np

from ...errors import ParameterError
from ...metrics import psnr_of
from ...reflectance import Reflectance
from .photographs import BallPhotographs

Methods = Mapping[str, Reflectance]


class HeldOut(NamedTuple):
    """How well one photograph that took no part is predicted."""

    name: str
    angle: float
    """degrees between light and camera"""
    psnr: Mapping[str, float]
    """dB by method: sRGB of the radiance clamped to [0, 1], over the pixels lit, seen and not saturated"""


def left_out(count: int, every: int) -> list[int]:
    """The photographs that leaving every k-th out leaves out. Raises ParameterError when fewer than 2 would be left or
    none left out."""
    chosen = list(range(every // 2, count, every)) if every >= 2 else []
    if not chosen or count - len(chosen) < 2:
        raise ParameterError(
            f"--hold-out {every} does not go with {count} photographs: it must be 2 or more and "
            "leave one out and 2 to build from"
        )
    return chosen


def hold_out(
    photographs: BallPhotographs, every: int, build: Callable[[BallPhotographs], Methods]
) -> tuple[HeldOut, ...]:
    """Build from all but every `every`-th photograph, predict those. Raises ParameterError."""
    out = left_out(len(photographs), every)
    methods = build(photographs.select([i for i in range(len(photographs)) if i not in out]))
    rows = []
    for number in out:
        wi, wo, _, radiance = photographs.pixels(number, least_cosine=0.0)
        psnr = {name: psnr_of(radiance, math.pi * m.f_cos(wi, wo)) for name, m in methods.items()}
        rows.append(HeldOut(photographs.names[number], float(np.degrees(photographs.angles[number])), psnr))
    return tuple(rows)


def mean_psnr(rows: tuple[HeldOut, ...]) -> dict[str, float]:
    """The mean over the photographs [dB] by method."""
    return {name: float(np.mean([row.psnr[name] for row in rows])) for name in (rows[0].psnr if rows else ())}
