"""Law: values are finite and not negative."""

from __future__ import annotations

import numpy as np

from ..reflectance import Reflectance
from .probes import adversarial, over_the_sphere, pairs, place
from .result import LawResult, law, rests_on_data

PAIRS = 50_000


@law("positivity")
def positivity(reflectance: Reflectance) -> LawResult:
    """f >= 0 and finite: everywhere, at grazing angles, at the exact normal, wi = wo, mirrored; float32 and float64.

    `value` counts the offending pairs. Raw measured values below zero are clamped by the call and do not offend; the
    note counts them. A formula must not go below zero to begin with.
    """
    wi, wo = (np.concatenate([a, b]) for a, b in zip(pairs(PAIRS), adversarial(), strict=True))
    if reflectance.transmits:
        wi, wo = over_the_sphere(wi, wo)
    raw, value = reflectance.raw(wi, wo), reflectance(wi, wo)
    single = reflectance(wi.astype(np.float32), wo.astype(np.float32))
    negative = (raw < 0).any(-1)
    bad = ~(np.isfinite(value) & (value >= 0)).all(-1)
    bad_single = ~(np.isfinite(single) & (single >= 0)).all(-1)
    clamped = int(negative.sum())
    if not rests_on_data(reflectance):
        bad |= negative
    offending = bad | bad_single
    notes = []
    if clamped:
        notes.append(f"{clamped} of {len(raw)} raw values below zero, the lowest {np.nanmin(raw):.3g}")
    if bad_single.any():
        notes.append(f"{int(bad_single.sum())} pairs offend in float32")
    count, worst = int(offending.sum()), int(np.argmax(offending))
    where = place(wi=wi[worst], wo=wo[worst]) if count else ""
    return LawResult("positivity", count == 0, count, 0, where, "; ".join(notes))
