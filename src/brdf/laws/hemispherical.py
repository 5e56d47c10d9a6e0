"""Law: radiosity does not exceed irradiance."""

from __future__ import annotations

import numpy as np

from ..geometry.directions import cosine_weighted
from ..geometry.quadrature import replicated_points
from ..reflectance import Reflectance
from .result import LawResult, law

SAMPLES = 65_536
TOLERANCE = 1e-3
STANDARD_ERRORS = 4


@law("hemispherical", excused_by="energy")
def hemispherical(reflectance: Reflectance) -> LawResult:
    """The hemispherical-hemispherical reflectance B / E under even light is at most 1.

    B / E = 1/pi int rho(wo) cos_o dwo, the cosine-weighted mean of the directional albedo. `value` is the largest
    channel's less 4 standard errors of its estimate. What breaks the law of energy may break this one, too.
    """
    points = replicated_points(SAMPLES)
    rng = np.random.default_rng(11)
    wo = cosine_weighted(rng.random((*points.shape[:-1], 2)))
    shares = reflectance._flux_shares(reflectance.sample(wo, points), wo)
    means = shares.mean(1, np.float64)
    ratio, error = means.mean(0), means.std(0, ddof=1) / np.sqrt(len(means))
    certain = np.nan_to_num(ratio - STANDARD_ERRORS * error, nan=np.inf)
    channel = int(np.argmax(certain))
    value, limit = float(certain[channel]), 1 + TOLERANCE
    note = f"B / E {ratio[channel]:.4f} ± {error[channel]:.1g}"
    return LawResult("hemispherical", value <= limit, value, limit, "", note)
