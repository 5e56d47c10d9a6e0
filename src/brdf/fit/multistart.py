"""Many searches on few samples, the hopeless ones given up, the best one carried on to the end on all of them."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..threads import map_threads
from .equations import Equations
from .levenberg import Evaluate, Problem, Search, advance, begin
from .losses import Loss
from .parameters import Component
from .samples import Samples

Array = NDArray[np.float64]

FEW = 10_000
"""Samples that searches begin on."""

ROUNDS = ((6, 0.5), (12, 0.25), (40, 0.0))
"""Steps, and the share of the searches that goes on after them; the best always does."""

FINALISTS = 3
"""Distinct minima that are looked at on all samples."""

SAME = 1e-3
"""Relative difference of costs below which two searches count as having found the same minimum."""

ROUNDING = 1e-10
"""Of a cost in single precision, in parts of the energy: residuals of a model that fits are differences of values."""


def stratified(samples: Samples, loss: Loss, count: int, seed: int) -> Samples:
    """About `count` samples with weights that make sums over them estimates of those over all.

    Drawn systematically along the order of the data, half by weight alone, half by what they contribute to the loss:
    highlights, which few samples see, stay in. All of them where there are no more than that.
    """
    if len(samples) <= count:
        return samples
    cosine = samples.wi[:, 2:]
    size = (samples.weight * np.square(loss.scale(samples.values * cosine) - loss.scale(0.0 * cosine))).sum(1)
    weight = samples.weight.sum(1)
    # A bounded share by weight and an even share keep any one sample from being all that is seen.
    share = 0.4 * size / max(float(size.sum()), 1e-300) + 0.3 * weight / weight.sum() + 0.3 / len(samples)
    at = np.cumsum(share) * count / share.sum()
    first = np.random.default_rng(seed).random()
    chosen = np.unique(np.searchsorted(at, first + np.arange(count), side="left").clip(max=len(samples) - 1))
    kept = samples[chosen]
    return kept.reweighted(kept.weight / np.minimum(share[chosen] * count / share.sum(), 1)[:, None])


def start_points(components: list[Component], free: NDArray[np.bool_], count: int, seed: int) -> list[Array]:
    """`count` points: the defaults, then a scrambled Sobol sequence over the start ranges.

    The channels of a colour start from one value.
    """
    from scipy.stats import qmc

    defaults = np.array([c.default for c in components])
    names = list(dict.fromkeys(c.parameter for c, is_free in zip(components, free, strict=True) if is_free))
    if count < 2 or not names:
        return [defaults]
    sequence = qmc.Sobol(len(names), rng=np.random.default_rng(seed)).random_base2(max(1, math.ceil(math.log2(count))))
    points = [defaults]
    for u in sequence[: count - 1]:
        at = dict(zip(names, u, strict=True))
        points.append(
            np.array(
                [
                    c.to_value(c.start_range[0] + at[c.parameter] * (c.start_range[1] - c.start_range[0]))
                    if is_free
                    else c.default
                    for c, is_free in zip(components, free, strict=True)
                ]
            )
        )
    return points


def run_rounds(problem: Problem, evaluate: Evaluate, starts: list[Array]) -> list[Search]:
    """Searches from all starts, best first; after each round only the better ones go on."""
    searches: list[Search] = map_threads(lambda numbers: begin(problem, evaluate, numbers), starts)
    going = [s for s in searches if np.isfinite(s.cost)]
    for steps, share in ROUNDS:
        map_threads(lambda s, steps=steps: advance(problem, evaluate, s, steps), going)  # type: ignore[misc]
        going.sort(key=lambda s: s.cost)
        going = going[: max(FINALISTS, math.ceil(share * len(going)))]
    return sorted((s for s in searches if np.isfinite(s.cost)), key=lambda s: s.cost)


def same(cost: float, best: float, energy: float) -> bool:
    """Whether two costs are those of one minimum; `energy` is the cost of no reflectance at all."""
    return cost <= best * (1 + SAME) + ROUNDING * energy


def distinct(searches: list[Search], energy: float, most: int = FINALISTS) -> list[Search]:
    """The best searches that ended in different minima."""
    found: list[Search] = []
    for search in searches:
        if not found or not same(search.cost, found[-1].cost, energy):
            found.append(search)
    return found[:most]


def energy_of(samples: Samples) -> float:
    """Half the weighted sum of squared f cos."""
    return 0.5 * float(np.sum(samples.weight * np.square(samples.values * samples.wi[:, 2:])))


def polish(problem: Problem, equations: Equations, searches: list[Search], steps: int) -> Search:
    """The best of some searches on all samples, carried on to the end."""
    begun = [begin(problem, equations, search.numbers) for search in searches]
    for search in begun:
        search.damping = 1e-4  # they come from a minimum
    best = min(begun, key=lambda s: s.cost)
    return advance(problem, equations, best, steps)
