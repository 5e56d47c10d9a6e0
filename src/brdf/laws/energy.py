"""Law: no more light leaves than arrives."""

from __future__ import annotations

import numpy as np

from ..reflectance import Reflectance
from .probes import place, viewers
from .result import LawResult, law

THETA_DEGREES = (0.0, 20.0, 40.0, 55.0, 65.0, 75.0, 80.0, 83.0, 86.0, 88.0, 89.0)
SAMPLES = 16_384
TOLERANCE = 1e-3
STANDARD_ERRORS = 4
"""An estimate this many of its own standard errors above the limit is no accident."""


@law("energy")
def energy(reflectance: Reflectance) -> LawResult:
    """The directional albedo is at most 1, from the normal to 89 degrees; for what transmits, from below as well.

    It counts flux: the radiance that enters a medium grows by the square of the index, and is divided by it.
    `value` is the largest channel's albedo less 4 standard errors of its estimate, which is what is known for sure.
    """
    wo = viewers(reflectance.isotropic, THETA_DEGREES, reflectance.transmits)
    # of the base class: a model may have a parameter called `albedo`
    albedo = reflectance.albedo(wo, SAMPLES)
    error = reflectance.albedo_error(wo, SAMPLES)
    certain = np.nan_to_num(albedo - STANDARD_ERRORS * error, nan=np.inf)
    viewer, channel = np.unravel_index(int(np.argmax(certain)), certain.shape)
    value, limit = float(certain[viewer, channel]), 1 + TOLERANCE
    note = f"albedo {albedo[viewer, channel]:.4f} ± {error[viewer, channel]:.1g}"
    return LawResult("energy", value <= limit, value, limit, place(wo=wo[viewer]), note)
