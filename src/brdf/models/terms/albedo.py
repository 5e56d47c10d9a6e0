"""Directional albedos as tables: the integral that layering and energy compensation need of a lobe."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...formula import Scalar, Vec, maximum, sqrt
from ...geometry.directions import from_spherical
from ...geometry.quadrature import gauss_legendre, half_vector_rule
from .ndf.projected_area import node_coordinate

COSINES = 64
"""Nodes between horizon and normal, evenly over the root of the cosine."""

LOWEST = 1e-6
"""Cosine that stands for the horizon."""


def albedo_table(lobe: Callable[[Vec, Vec], Any], azimuths: Sequence[float] = (0.0,)) -> NDArray[np.float32]:
    """Directional albedo of `lobe(wi, wo)` [1/sr] over (root of the cosine, azimuth): (64, n, 1) in [0, 1]."""
    cosines = np.maximum(np.linspace(0, 1, COSINES) ** 2, LOWEST)
    table = np.empty((COSINES, len(azimuths), 1), np.float32)
    for row, column in np.ndindex(COSINES, len(azimuths)):
        wo = from_spherical(np.arccos(cosines[row]), azimuths[column])
        rule = half_vector_rule(wo, 64, 48)
        values = lobe(Vec(*rule.directions.T), Vec(*wo))
        table[row, column, 0] = np.sum(values * rule.directions[:, 2] * rule.weights)
    return table.clip(0, 1)


def cosine_mean(table: NDArray[np.float32]) -> float:
    """(1 / pi) integral of the tabulated albedo times the cosine: in the root x of the cosine, of E 4 x^3."""
    x, weight = gauss_legendre(4 * COSINES)
    along = np.interp(x, np.linspace(0, 1, COSINES), table[..., 0].mean(axis=1))
    return float(np.sum(along * 4 * x**3 * weight))


def albedo_coordinate(cosine: Scalar) -> Scalar:
    """Texture coordinate of a cosine along the first axis of a table."""
    return node_coordinate(sqrt(maximum(cosine, 0.0)), COSINES)
