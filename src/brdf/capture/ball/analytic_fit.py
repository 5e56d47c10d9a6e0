"""GGX plus Lambert fitted to samples: the peer that a capture is measured against, and what it continues with."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models.lambertian import Lambertian
from ...models.microfacet import GGX
from ...reflectance import Reflectance

Array = NDArray[np.floating[Any]]

STARTS = (0.05, 0.15, 0.4)
"""Widths from which the fit starts; the best end wins."""
BOUNDS = (0.01, 1.0)
"""Of the width alpha."""
ROBUST = 0.3
"""Residuals above this share of the median weighted value count less: a smaller one leaves highlights out."""
MOST_SAMPLES = 10_000


def fit_ggx_lambert(wi: Array, wo: Array, values: Array, weight: Array, seed: int = 0) -> Reflectance:
    """Lambert's law plus a GGX lobe (Schlick's Fresnel term) nearest to `values` (N, 3) [1/sr] at pairs (N, 3).

    Least squares with a soft L1 loss over a random selection of the samples, `weight` (N, 3) of squared errors of f;
    one width for all channels, albedo and F0 of each. References: Walter2007, Schlick1994.
    """
    from scipy.optimize import least_squares

    if len(wi) > MOST_SAMPLES:
        chosen = np.random.default_rng(seed).choice(len(wi), MOST_SAMPLES, replace=False)
        wi, wo, values, weight = (a[chosen] for a in (wi, wo, values, weight))
    root = np.sqrt(weight / weight.mean())
    h = (wi + wo) / np.linalg.norm(wi + wo, axis=-1, keepdims=True)
    grazing = (1 - np.clip(np.sum(wi * h, -1), 0, 1)) ** 5

    def model(p: Array) -> Array:
        white = GGX(alpha=float(np.clip(math.exp(p[0]), *BOUNDS)), F0=1.0)(wi, wo)
        return np.asarray(p[1:4] / math.pi + white * (p[4:7] + (1 - p[4:7]) * grazing[:, None]))

    typical = float(np.median(np.abs(root * values)))

    def residual(p: Array) -> Array:
        return np.asarray(root * (model(p) - values)).ravel()

    albedo = np.clip(math.pi * np.median(values, axis=0), 1e-3, 1)
    lower = np.array([math.log(BOUNDS[0]), *[0.0] * 6])
    upper = np.array([math.log(BOUNDS[1]), *[1.0] * 6])
    fits = []
    for alpha in STARTS:
        start = np.clip([math.log(alpha), *albedo, 0.04, 0.04, 0.04], lower + 1e-6, upper - 1e-6)
        fits.append(
            least_squares(residual, start, bounds=(lower, upper), loss="soft_l1", f_scale=max(ROBUST * typical, 1e-9))
        )
    p = min(fits, key=lambda fit: fit.cost).x
    made = Lambertian(albedo=p[1:4]) + GGX(alpha=math.exp(p[0]), F0=p[4:7])
    return made.named("GGX + Lambert", "fitted by least squares to photographs")
