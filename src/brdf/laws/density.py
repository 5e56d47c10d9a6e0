"""Law: the density of the sampler integrates to at most 1."""

from __future__ import annotations

import numpy as np

from ..reflectance import Reflectance
from .probes import place, viewers
from .result import LawResult, law
from .sampling import THETA_DEGREES, cells_of

SAMPLES = 20_000
"""Samples that show where the density is large."""

TOLERANCE = 5e-3
"""Error of the integral over adaptive cells; checked against closed forms."""


@law("density")
def density(reflectance: Reflectance) -> LawResult:
    """`pdf` is finite, not negative, and integrates to at most 1 over the directions the reflectance is defined for.

    `value` is the largest integral over several viewing directions; infinite where a density is below zero or not
    finite.
    """
    wo = viewers(reflectance.isotropic, THETA_DEGREES, reflectance.transmits)
    integrals = []
    for seed, viewer in enumerate(wo):
        drawn = reflectance.sample(viewer, np.random.default_rng(seed).random((SAMPLES, 2)))
        probability = cells_of(reflectance, viewer, drawn.wi[~drawn.is_delta]).probability
        sound = (drawn.pdf >= 0).all() and (probability >= 0).all() and np.isfinite(probability).all()
        integrals.append(float(probability.sum()) if sound else np.inf)
    worst, limit = int(np.argmax(integrals)), 1 + TOLERANCE
    return LawResult("density", integrals[worst] <= limit, integrals[worst], limit, place(wo=wo[worst]))
