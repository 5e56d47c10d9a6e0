"""Law: what `sample` returns fits together."""

from __future__ import annotations

import numpy as np

from ..geometry.directions import cosine_weighted
from ..reflectance import Reflectance
from .probes import place
from .result import LawResult, law

SAMPLES = 20_000
LIMIT = 1e-3
"""Relative; float32 directions near a sharp peak round that much."""


@law("weight")
def weight(reflectance: Reflectance) -> LawResult:
    """A sample's weight is f |cos| / pdf with the pdf of `pdf`, its direction is a unit vector; float64 and float32.

    `value` is the largest of: deviation of a direction's length from 1, deviation of the returned density from
    `pdf(wi, wo)`, deviation of weight times density from f |cos|, each relative. For delta events the probability takes
    the place of the density and `delta` that of f |cos|. Samples of density 0 have to have weight 0.
    """
    rng = np.random.default_rng(11)
    wo, u = cosine_weighted(rng.random((SAMPLES, 2))), rng.random((SAMPLES, 2))
    if reflectance.transmits:
        wo[::2] *= -1
    deviation = np.maximum(_deviation(reflectance, wo, u), _deviation(reflectance, wo.astype(np.float32), u))
    worst = int(np.argmax(deviation))
    value = float(deviation[worst])
    return LawResult("weight", value <= LIMIT, value, LIMIT, place(wo=wo[worst]))


def _deviation(reflectance: Reflectance, wo: np.ndarray, u: np.ndarray) -> np.ndarray:
    """The deviations (N,) of samples for viewing directions (N, 3)."""
    wi, weights, pdf, is_delta = reflectance.sample(wo, u)
    length = np.abs(np.linalg.norm(wi, axis=-1) - 1)
    again = reflectance.pdf(wi, wo)
    in_density = np.where(is_delta, 0, np.abs(again - pdf) / np.where(pdf > 0, pdf, 1))
    f_cos = np.where(is_delta[:, None], reflectance.delta(wi, wo), reflectance.f_cos(wi, wo))
    apart = np.abs(weights * pdf[:, None] - f_cos).max(-1)
    # where nothing can be drawn, nothing may be weighed
    in_weight = np.where(pdf > 0, apart / np.maximum(f_cos.max(-1), np.finfo(wi.dtype).tiny), weights.max(-1))
    deviation = np.maximum.reduce([length, in_density, np.where(f_cos.max(-1) + weights.max(-1) > 0, in_weight, 0)])
    worst: np.ndarray = np.nan_to_num(deviation, nan=np.inf)
    return worst
