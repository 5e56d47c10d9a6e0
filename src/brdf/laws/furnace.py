"""Law: what promises to lose no light loses none."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..reflectance import Reflectance
from .probes import place, viewers
from .result import LawResult, law

THETA_DEGREES = (0.0, 30.0, 60.0, 75.0, 85.0, 89.0)
SAMPLES = 16_384
TOLERANCE = 2e-3
STANDARD_ERRORS = 4


@law("furnace")
def furnace(reflectance: Reflectance) -> LawResult:
    """In a white furnace, with light of the same radiance all around, a white surface cannot be seen: its albedo is 1.

    Measured where it is promised: `lossless` of the class holds the values that make the reflectance lose nothing, the
    other parameters stay. `value` is the largest |albedo - 1| less 4 standard errors of its estimate.
    """
    values = reflectance.lossless
    if values is None:
        return LawResult("furnace", True, 0.0, TOLERANCE, "", "not promised")
    bare: Any = reflectance
    whitened: Reflectance = bare.replaced(**values) if values else reflectance
    wo = viewers(whitened.isotropic, THETA_DEGREES, whitened.transmits)
    albedo, error = whitened.albedo(wo, SAMPLES), whitened.albedo_error(wo, SAMPLES)
    lost = np.nan_to_num(np.abs(albedo - 1) - STANDARD_ERRORS * error, nan=np.inf)
    viewer, channel = np.unravel_index(int(np.argmax(lost)), lost.shape)
    value = max(float(lost[viewer, channel]), 0.0)
    note = f"albedo {albedo[viewer, channel]:.4f} ± {error[viewer, channel]:.1g}"
    return LawResult("furnace", value <= TOLERANCE, value, TOLERANCE, place(wo=wo[viewer]), note)
