"""GGX plus Lambert fitted to samples: the peer that a capture is measured against, and what it continues with."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...fit import Samples, fit
from ...models.lambertian import Lambertian
from ...models.microfacet import GGX
from ...reflectance import Reflectance

Array = NDArray[np.floating[Any]]

ROBUST = "soft_l1"
"""Outliers (dust, stands, the camera's own reflection) count less."""
MOST_SAMPLES = 10_000


def fit_ggx_lambert(wi: Array, wo: Array, values: Array, weight: Array, seed: int = 0) -> Reflectance:
    """Lambert's law plus a GGX lobe (Schlick's Fresnel term) nearest to `values` (N, 3) [1/sr] at pairs (N, 3).

    A robust fit to a random selection of the samples, `weight` (N, 3) of squared errors of f; one width for all
    channels, albedo and F0 of each. References: Walter2007, Schlick1994.
    """
    if len(wi) > MOST_SAMPLES:
        chosen = np.random.default_rng(seed).choice(len(wi), MOST_SAMPLES, replace=False)
        wi, wo, values, weight = (a[chosen] for a in (wi, wo, values, weight))
    # A fit is of f cos, and of values that are not negative, as noise can be.
    samples = Samples.of(wi, wo, np.maximum(values, 0), weight / wi[:, 2:] ** 2, grazing=90.0)
    made = fit(samples, Lambertian() + GGX(), robust=ROBUST, budget="quick", seed=seed).reflectance
    return made.named("GGX + Lambert", "fitted by least squares to photographs")
