"""Law: what is declared isotropic is isotropic."""

from __future__ import annotations

import numpy as np

from ..geometry.directions import rotated
from ..reflectance import Reflectance
from .asymmetry import asymmetry
from .probes import pairs, place
from .result import LawResult, law

PAIRS = 20_000
LIMIT = 1e-5
"""Rounding, with room for tables kept in float32."""


@law("isotropy")
def isotropy(reflectance: Reflectance) -> LawResult:
    """Turning both directions together about the normal changes nothing.

    `value` is the cosine-weighted mean change relative to f, each pair turned by an angle of its own. What is declared
    anisotropic is measured as well, without a limit.
    """
    wi, wo = pairs(PAIRS)
    angle = np.random.default_rng(3).uniform(0.1, 2 * np.pi - 0.1, len(wi))
    turned = reflectance(rotated(wi, angle), rotated(wo, angle))
    value, worst = asymmetry(reflectance(wi, wo), turned, wi[:, 2] * wo[:, 2])
    limit = LIMIT if reflectance.isotropic else np.inf
    note = "" if reflectance.isotropic else "declared anisotropic"
    return LawResult("isotropy", value <= limit, value, limit, place(wi=wi[worst], wo=wo[worst]), note)
