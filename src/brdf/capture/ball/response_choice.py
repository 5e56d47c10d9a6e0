"""Which response a camera had that saved 8 bits: most save sRGB, some what the sensor counted.

Under the wrong one no isotropic material fits: shades do not follow the lights. Both are tried, a simple material is
fitted to each, and its pictures are compared with the files' own numbers, which are the same for both.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...color import srgb_encode
from .analytic_fit import fit_ggx_lambert
from .photographs import BallPhotographs, visible_weight

Array = NDArray[np.floating[Any]]

CANDIDATES = ("srgb", "linear")
CLEAR = 1.3
"""Factor between the misfits from which linear numbers are believed; 2 to 10 on the sets of docs/capture-sphere.md."""
SAMPLES = 4000


def chosen_response(readings: Mapping[str, BallPhotographs], strength: Array) -> tuple[str, str]:
    """One of the `CANDIDATES`, and why. `readings`: the photographs under each; `strength` (N, 3) their lights'."""
    srgb, linear = (_misfit(readings[name], strength, name) for name in CANDIDATES)
    if srgb > CLEAR * linear:
        return "linear", f"an isotropic material fits {srgb / max(linear, 1e-9):.1f} times better than read as sRGB"
    return "srgb", f"read as linear, an isotropic material fits {linear / max(srgb, 1e-9):.1f} times as badly"


def _misfit(photographs: BallPhotographs, strength: Array, response: str) -> float:
    """Mean difference between the files' numbers and those of GGX + Lambert fitted to them."""
    rng = np.random.default_rng(0)
    parts, each = [], max(SAMPLES // len(photographs), 50)
    for number in range(len(photographs)):
        wi, wo, values, radiance = photographs.pixels(number)
        some = rng.choice(len(wi), min(each, len(wi)), replace=False)
        light = np.broadcast_to(strength[number], (len(some), 3))
        parts.append((wi[some], wo[some], values[some], radiance[some], light))
    wi, wo, values, radiance, light = (np.concatenate(column) for column in zip(*parts, strict=True))
    scale = 2 * photographs.diffuse_level()
    if not scale > 0:
        return math.inf
    predicted = radiance
    for _ in range(2):  # the second time with weights without noise
        weight = visible_weight(predicted / scale, wi)
        predicted = math.pi * scale * fit_ggx_lambert(wi, wo, values / scale, weight).f_cos(wi, wo)
    encode = srgb_encode if response == "srgb" else np.asarray
    numbers = [encode(np.clip(light * found, 0, 1)) for found in (predicted, radiance)]
    return float(np.mean(np.abs(numbers[0] - numbers[1])))
