"""From linear radiance to what a screen shows: exposure, tone curve, sRGB."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..color import srgb_encode
from ..errors import ParameterError, UnknownNameError

Floats = NDArray[np.floating[Any]]

MIDDLE_GREY = 0.18

MOST_STOPS = 100
"""Whatever is brighter or darker than this has no picture; its factor still fits in float32."""


def _clip(x: Floats) -> Floats:
    return x


def _reinhard(x: Floats) -> Floats:
    """x / (1 + x), scaled so that middle grey stays [Reinhard2002]."""
    x = x / (1 - MIDDLE_GREY)
    return x / (1 + x)


FILMIC_SCALE = 0.7231708
"""Solves _filmic(0.18) = 0.18: middle grey stays middle grey."""


def _filmic(x: Floats) -> Floats:
    """A rational fit of the ACES curve [Narkowicz2015]: highlights roll off instead of clipping."""
    x = x * FILMIC_SCALE
    return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)


NEUTRAL_SHOULDER = 0.8 - 0.04
"""Brightness above which the neutral curve compresses."""


def _neutral(x: Floats) -> Floats:
    """Colours of products stay what they are, brighter ones are compressed and fade to white [Khronos2024].

    Takes RGB in the last axis: 0.04, what a dielectric reflects of white surroundings, is taken off, and the brightest
    channel decides how far the others are scaled.
    """
    least = x.min(-1, keepdims=True)
    x = x - np.where(least < 0.08, least * (1 - 6.25 * least), 0.04)
    peak = x.max(-1, keepdims=True)
    room = 1 - NEUTRAL_SHOULDER
    above = np.maximum(peak, NEUTRAL_SHOULDER)
    compressed = 1 - room**2 / (above + room - NEUTRAL_SHOULDER)
    kept = 1 / (0.15 * (above - compressed) + 1)
    return np.where(peak < NEUTRAL_SHOULDER, x, compressed * (x / above * kept + 1 - kept))


CURVES: dict[str, Callable[[Floats], Floats]] = {
    "clip": _clip, "reinhard": _reinhard, "filmic": _filmic, "neutral": _neutral, "linear": _clip,
}  # fmt: skip
"""In the order in which shaders number them."""


def require_exposure(exposure: float) -> None:
    """Raises ParameterError for one that is out of its bounds."""
    if not abs(exposure) <= MOST_STOPS:
        raise ParameterError(f"exposure must lie in [-{MOST_STOPS}, {MOST_STOPS}] stops, got {exposure!r}")


def developed(linear: Floats, tone: str = "filmic", exposure: float = 0.0) -> Floats:
    """Linear radiance, RGB in the last axis -> values in [0, 1] as sRGB encodes them; for "linear" as they are.

    `tone`: "clip" (faithful below 1), "reinhard" or "filmic", each of which leaves middle grey (0.18) as it is,
    "neutral" (for colours of products), or "linear". `exposure` is in stops.
    Raises UnknownNameError and ParameterError.
    """
    if tone not in CURVES:
        raise UnknownNameError("tone curve", tone, CURVES)
    require_exposure(exposure)
    linear = np.asarray(linear)
    # Beyond 1e4 every curve is white; the bound keeps their squares finite.
    exposed = np.clip(linear * linear.dtype.type(2.0**exposure), 0, 1e4)
    shown = np.clip(CURVES[tone](exposed), 0, 1)
    return shown if tone == "linear" else srgb_encode(shown)
