"""The slice stack fitted to photographs of a ball, as smooth as predicts photographs best."""

from __future__ import annotations

import math

import numpy as np

from ...reflectance import Reflectance
from ...representations.baking.bake import diffuse_floor
from ...representations.baking.bake_scattered import SMOOTHNESS, bake_scattered
from ...representations.tables.layout import Layout
from ...representations.tables.table import Table
from .photographs import BallPhotographs, visible_weight

FLOOR = 0.5
"""The diffuse floor as a share of the darkest values (their lowest percentile): noise goes below them."""
TRIED = (1e-4, 1e-3, 1e-2, 1e-1)
"""Smoothness, from following every sample to hardly leaving the analytic fit."""
VALIDATION = 3
"""Every third photograph is left out to choose among them."""
ENOUGH = 8
"""Photographs from which on the choice is made."""


def fit_stack(photographs: BallPhotographs, analytic: Reflectance, layout: Layout) -> Table:
    """A slice stack near `analytic` that fits all usable pixels, errors weighted as the eye sees them."""
    smoothness = _chosen(photographs, analytic, layout) if len(photographs) >= ENOUGH else SMOOTHNESS
    return _fitted(photographs, analytic, layout, smoothness).with_albedo()


def _chosen(photographs: BallPhotographs, analytic: Reflectance, layout: Layout) -> float:
    """The smoothness with which photographs left out are predicted best; each counts by its mean squared error."""
    out = range(1, len(photographs), VALIDATION)
    rest = photographs.select([i for i in range(len(photographs)) if i not in out])
    left = photographs.select(out)
    return min(TRIED, key=lambda smoothness: _error(_fitted(rest, analytic, layout, smoothness), left, analytic))


def _fitted(photographs: BallPhotographs, analytic: Reflectance, layout: Layout, smoothness: float) -> Table:
    wi, wo, values, _ = photographs.samples()
    weight = visible_weight(math.pi * analytic.f_cos(wi, wo), wi)
    floor = FLOOR * diffuse_floor(math.pi * values, np.ones(len(wi), np.bool_), 0.01)
    return bake_scattered(wi, wo, values, layout, weight=weight, prior=analytic, floor=floor, smoothness=smoothness)


def _error(stack: Table, photographs: BallPhotographs, analytic: Reflectance) -> float:
    """The sum of the photographs' mean squared visible errors."""
    total = 0.0
    for number in range(len(photographs)):
        wi, wo, values, _ = photographs.pixels(number)
        weight = visible_weight(math.pi * analytic.f_cos(wi, wo), wi)
        total += float(np.mean(np.minimum(weight * (stack(wi, wo) - values) ** 2, 1.0)))
    return total
