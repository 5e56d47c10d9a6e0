"""Law: Helmholtz reciprocity."""

from __future__ import annotations

from ..reflectance import Reflectance
from .asymmetry import asymmetry
from .probes import pairs, place
from .result import LawResult, law, rests_on_data

PAIRS = 20_000

FORMULA_LIMIT = 1e-6
"""Rounding in float64, with room for the cancellations of sharp lobes."""

DATA_LIMIT = 0.2
"""For measurements: noise, and the two directions sampled unlike. Careful goniometric ones of the RGL database were
found to lie between 0.04 and 0.13, so twice as much says that something is wrong."""


@law("reciprocity")
def reciprocity(reflectance: Reflectance) -> LawResult:
    """f(wi, wo) = f(wo, wi).

    `value` is the cosine-weighted mean of |f(wi, wo) - f(wo, wi)| relative to that of f. A formula has to obey up to
    rounding; measured or tabulated data up to 20 %, and the value is there to be judged.
    """
    wi, wo = pairs(PAIRS)
    value, worst = asymmetry(reflectance(wi, wo), reflectance(wo, wi), wi[:, 2] * wo[:, 2])
    limit = DATA_LIMIT if rests_on_data(reflectance) else FORMULA_LIMIT
    return LawResult("reciprocity", value <= limit, value, limit, place(wi=wi[worst], wo=wo[worst]))
