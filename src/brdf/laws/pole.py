"""Law: nothing special happens at the normal."""

from __future__ import annotations

import numpy as np

from ..geometry.directions import from_spherical
from ..reflectance import Reflectance
from .asymmetry import asymmetry
from .probes import pairs, place
from .result import LawResult, law, rests_on_data

PAIRS = 4_000
AZIMUTHS = 8

TILT = 1e-8
"""Angle [rad] of the viewers next to the normal: small beside the sharpest lobe, whose width is 1e-4."""

LIMIT = 1e-2
"""A lobe of width 1e-4 changes by up to 0.2 % over the tilt."""
DATA_LIMIT = 0.2
"""Tables over polar angles have a row for each azimuth at the pole, which measurements do not fill alike."""


@law("pole")
def pole(reflectance: Reflectance) -> LawResult:
    """As the viewer nears the normal, f tends to its value at the normal, from every azimuth alike.

    `value` is the cosine-weighted mean change relative to f, between the normal and viewers 1e-8 rad away, of the worst
    azimuth. What transmits is measured above the surface.
    """
    wi, _ = pairs(2 * PAIRS)
    wi = wi[-PAIRS:]
    at_normal = reflectance(wi, np.array([0.0, 0.0, 1.0]))
    limit = DATA_LIMIT if rests_on_data(reflectance) else LIMIT
    worst, where = 0.0, ""
    for phi in np.arange(AZIMUTHS) * (2 * np.pi / AZIMUTHS) + 0.1:
        wo = from_spherical(np.array(TILT), phi)
        value, index = asymmetry(at_normal, reflectance(wi, wo), wi[:, 2])
        if value >= worst:
            worst, where = value, place(wi=wi[index], wo=wo)
    return LawResult("pole", worst <= limit, worst, limit, where)
