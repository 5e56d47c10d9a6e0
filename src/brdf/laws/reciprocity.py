"""Law: Helmholtz reciprocity."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..reflectance import Reflectance
from .asymmetry import Floats, asymmetry
from .probes import over_the_sphere, pairs, place
from .result import LawResult, law, rests_on_data

PAIRS = 20_000

FORMULA_LIMIT = 1e-6
"""Rounding in float64, with room for the cancellations of sharp lobes."""

DATA_LIMIT = 0.2
"""For measurements: noise, and the two directions sampled unlike. Careful goniometric ones of the RGL database were
found to lie between 0.04 and 0.13, so twice as much says that something is wrong."""


@law("reciprocity")
def reciprocity(reflectance: Reflectance) -> LawResult:
    """f(wi, wo) = f(wo, wi); for what transmits into another medium, f(wi, wo) / n(wo)² = f(wo, wi) / n(wi)².

    n is the refractive index on a direction's side [Veach1997]. `value` is the cosine-weighted mean of
    |f(wi, wo) - f(wo, wi)| relative to that of f. A formula has to obey up to rounding, delta events included;
    measured or tabulated data up to 20 %, and the value is there to be judged.
    """
    wi, wo = pairs(PAIRS)
    if reflectance.transmits:
        wi, wo = over_the_sphere(wi, wo)
    forth, back = reflectance(wi, wo), reflectance(wo, wi) * _index_ratio(reflectance, wi, wo)
    value, worst = asymmetry(forth, back, np.abs(wi[:, 2] * wo[:, 2]))
    events = _events(reflectance, wo)
    if len(events.wi):
        # what multiplies the delta function: of wi in one direction, of wo in the other, whose solid angles differ by
        # the ratio, too
        ratio = _index_ratio(reflectance, events.wi, events.wo) ** 2
        forth, back = reflectance.delta(events.wi, events.wo), reflectance.delta(events.wo, events.wi) * ratio
        value_of_events, worst_event = asymmetry(forth, back, np.abs(events.wo[:, 2]))
        if value_of_events > value:
            value, (wi, wo), worst = value_of_events, events, worst_event
    limit = DATA_LIMIT if rests_on_data(reflectance) else FORMULA_LIMIT
    return LawResult("reciprocity", value <= limit, value, limit, place(wi=wi[worst], wo=wo[worst]))


def _index_ratio(reflectance: Reflectance, wi: Floats, wo: Floats) -> Floats:
    """(n(wo) / n(wi))² of pairs (N, 3), as (N, 1)."""
    below_minus_above = (wo[:, 2:] < 0).astype(np.float64) - (wi[:, 2:] < 0)
    ratio: Floats = reflectance.relative_index ** (2 * below_minus_above)
    return ratio


class _Pairs(NamedTuple):
    wi: Floats
    wo: Floats


def _events(reflectance: Reflectance, wo: Floats) -> _Pairs:
    """Delta events drawn for viewing directions (N, 3)."""
    drawn = reflectance.sample(wo, np.random.default_rng(5).random((len(wo), 2)))
    return _Pairs(drawn.wi[drawn.is_delta], wo[drawn.is_delta])
