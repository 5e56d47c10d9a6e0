"""Law: the sampler draws what its density says."""

from __future__ import annotations

import numpy as np

from ..reflectance import Reflectance, Sample
from .cells import Cells, Floats, counted
from .probes import place, viewers
from .result import LawResult, law

THETA_DEGREES = (0.0, 15.0, 45.0, 70.0, 85.0)
SAMPLES = 60_000
SIGNIFICANCE = 1e-3
"""Chance that a sampler without fault is accused, over all viewing directions together."""

CERTAIN = 3.0
"""Errors of the integral that the deviation expected by chance, the root of a count, has to exceed."""

SMALLEST = 10.0
"""Expected samples below which a cell is pooled with others: the test's statistic needs that many."""


@law("sampling")
def sampling(reflectance: Reflectance) -> LawResult:
    """Samples follow `pdf`: Pearson's chi-squared test over adaptive cells, for several viewing directions.

    `value` is the smallest p-value, `limit` the significance 0.001 in Šidák's correction for the number of viewing
    directions. What is drawn below the horizon counts as a cell of its own, whose probability the density leaves
    over. A delta event is a cell of its own, too, with its probability. References: Pearson1900, Sidak1967.
    """
    wo = viewers(reflectance.isotropic, THETA_DEGREES, reflectance.transmits)
    p_values = [chi_squared_p(*_counts(reflectance, viewer, seed)) for seed, viewer in enumerate(wo)]
    limit = 1 - (1 - SIGNIFICANCE) ** (1 / len(wo))
    worst = int(np.argmin(p_values))
    note = f"{len(wo)} viewing directions, {SAMPLES} samples each"
    return LawResult("sampling", p_values[worst] >= limit, p_values[worst], limit, place(wo=wo[worst]), note)


def _counts(reflectance: Reflectance, viewer: Floats, seed: int) -> tuple[Floats, Floats]:
    """Expected and observed numbers of samples in the cells.

    The last entry is for what lies outside the domain of the density, unless the integral is too uncertain to say how
    much that should be.
    """
    drawn = reflectance.sample(viewer, np.random.default_rng(seed).random((SAMPLES, 2)))
    # what is drawn where the density is 0 is missing from it, and is found there
    smooth = drawn.wi[~drawn.is_delta & (drawn.pdf > 0)]
    cells = cells_of(reflectance, viewer, smooth)
    probabilities, events = _events(drawn)
    expected = SAMPLES * np.concatenate([cells.probability, probabilities])
    observed = np.concatenate([cells.counts, events]).astype(np.float64)
    leftover, outside = SAMPLES - expected.sum(), SAMPLES - observed.sum()
    if max(leftover, outside) < (CERTAIN * SAMPLES * cells.error) ** 2:
        return expected, observed
    return np.append(expected, max(leftover, 0.0)), np.append(observed, outside)


def _events(drawn: Sample) -> tuple[Floats, Floats]:
    """Probability and number of draws of each delta event that was drawn, told apart by direction."""
    events = drawn.is_delta & (drawn.pdf > 0)
    wi, probability = drawn.wi[events], drawn.pdf[events]
    _, first, counts = np.unique(np.round(wi, 6), axis=0, return_index=True, return_counts=True)
    return probability[first], counts.astype(np.float64)


def cells_of(reflectance: Reflectance, viewer: Floats, samples: Floats) -> Cells:
    """The density and the samples of one viewing direction, cell by cell."""
    lowest = -1.0 if reflectance.transmits else 0.0
    return counted(lambda wi: reflectance.pdf(wi, viewer), samples, lowest)


def chi_squared_p(expected: Floats, observed: Floats) -> float:
    """The p-value of observed against expected counts (C,); cells that expect fewer than 10 are pooled.

    0 where there are samples and none are expected at all.
    """
    from scipy.special import gammaincc

    order = np.argsort(expected)
    expected, observed = expected[order], observed[order]
    # as few of the smallest cells as together expect enough
    small = int(np.sum(expected < SMALLEST))
    while 0 < small < len(expected) and expected[:small].sum() < SMALLEST:
        small += 1
    pooled_expected, pooled_observed = (np.append(a[small:], a[:small].sum()) for a in (expected, observed))
    if not np.isfinite(pooled_expected).all():
        return 0.0
    if pooled_expected[-1] == 0:
        if pooled_observed[-1] > 0:
            return 0.0
        pooled_expected, pooled_observed = pooled_expected[:-1], pooled_observed[:-1]
    statistic = ((pooled_observed - pooled_expected) ** 2 / pooled_expected).sum()
    freedom = len(pooled_expected) - 1
    return float(gammaincc(freedom / 2, statistic / 2)) if freedom > 0 else 1.0
