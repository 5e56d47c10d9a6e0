"""Evaluations a second of every model, float32, and beside Mitsuba's where it has the same model, in the same run."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from benchmarks.conftest import best_time, million_per_second, mitsuba_time

import brdf

COUNT = 4_000_000

PEERS: dict[str, dict[str, Any]] = {
    "Lambertian": {"type": "diffuse"},
    "GGX": {"type": "roughconductor", "distribution": "ggx", "alpha": 0.2, "material": "none"},
    "Disney": {"type": "principled"},
}
"""The Mitsuba plugin of the same kind; its parameters hardly change its time."""


@pytest.mark.benchmark(group="models")
@pytest.mark.parametrize("name", brdf.models.names())
def test_model(benchmark, pairs, name):
    m = brdf.models.get(name)()
    if m.has_delta and not m(np.float32([0.6, 0, 0.8]), np.float32([0, 0, 1])).any():
        pytest.skip("a delta distribution has no values to evaluate")
    wi, wo = (w[:COUNT] for w in pairs)
    benchmark.pedantic(m, args=(wi, wo), rounds=3, warmup_rounds=1)
    seconds = best_time(lambda: m(wi, wo), 3)
    info = benchmark.extra_info
    info["million evaluations a second"] = million_per_second(COUNT, seconds)
    few = slice(0, 200_000)
    exact = m(wi[few].astype("f8"), wo[few].astype("f8"))
    info["relative error p99.9 against float64"] = float(
        np.quantile(np.abs(m(wi[few], wo[few]) - exact) / np.maximum(np.abs(exact), 1e-4), 0.999)
    )
    if name in PEERS:
        peer = mitsuba_time(PEERS[name], wi, wo)
        if peer is not None:
            info["times Mitsuba"] = round(peer / seconds, 2)
    print(name, dict(info))
