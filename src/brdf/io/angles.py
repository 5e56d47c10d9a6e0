"""Pairs of directions at which text formats are written."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ReflectanceError
from ..geometry.directions import to_spherical
from ..reflectance import Reflectance
from ..representations.baking.bake import require_values
from ..representations.tables.bases import HalfBasis

Array = NDArray[np.floating[Any]]

_LEAST_COSINE = 0.02
"""Instruments do not measure closer to the horizon, and models are unbounded there."""


def goniometer_pairs(reflectance: Reflectance) -> tuple[Array, Array, Array]:
    """Angles (N, 4), theta_i phi_i theta_o phi_o [rad], and `wi`, `wo` (N, 3): about 3,000 pairs over half and
    difference angles, as dense near the mirror direction as MERL's bins are.

    Raises ReflectanceError for a reflectance that is anisotropic, transmits or mirrors.
    """
    if not reflectance.isotropic:
        name = reflectance.name or type(reflectance).__name__
        raise ReflectanceError(f"{name} is anisotropic, which such text does not hold; write .bin, .csail or .bsdf")
    require_values(reflectance)
    theta_h = np.linspace(0, 1, 22) ** 2 * math.radians(88)
    theta_d, phi_d = np.radians(np.arange(0.5, 89, 5)), np.radians(np.arange(0, 181, 15))
    nodes = np.meshgrid(theta_h, theta_d, phi_d, indexing="ij")
    wi, wo = (w.reshape(-1, 3) for w in HalfBasis("half-turn").directions(*nodes))
    above = (wi[:, 2] > _LEAST_COSINE) & (wo[:, 2] > _LEAST_COSINE)
    wi, wo = wi[above], wo[above]
    angles = np.stack([*to_spherical(wi), *to_spherical(wo)], -1)
    return angles, wi, wo
