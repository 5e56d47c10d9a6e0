"""What the benchmarks share: direction pairs, and how a measurement is recorded.

Run with `uv run --all-extras pytest benchmarks --benchmark-enable -s`. Each benchmark records its error and the ratio
to a peer measured in the same run; nothing asserts a time.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

PAIRS = 10_000_000


@pytest.fixture(scope="session")
def pairs() -> tuple[np.ndarray, np.ndarray]:
    """Ten million float32 pairs on the upper hemisphere, cosines above 0.02."""
    rng = np.random.default_rng(0)

    def directions() -> np.ndarray:
        z = rng.uniform(0.02, 1, PAIRS).astype("f4")
        phi = rng.uniform(0, 2 * np.pi, PAIRS).astype("f4")
        r = np.sqrt(1 - z * z)
        return np.stack([r * np.cos(phi), r * np.sin(phi), z], -1)

    return directions(), directions()


def best_time(function: Callable[[], Any], repeats: int = 5) -> float:
    """Seconds of the fastest call, after one to warm up."""
    function()
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        function()
        times.append(time.perf_counter() - start)
    return min(times)


def million_per_second(pairs: int, seconds: float) -> float:
    return round(pairs / seconds / 1e6, 2)


def mitsuba_time(plugin: dict[str, Any], wi: np.ndarray, wo: np.ndarray) -> float | None:
    """Seconds of the plugin's evaluation, NumPy in and out, or None where Mitsuba or its compiler is missing."""
    try:
        import drjit as dr
        import mitsuba as mi
    except ImportError:
        return None
    if "llvm_ad_rgb" not in mi.variants():
        return None
    mi.set_variant("llvm_ad_rgb")
    bsdf = mi.load_dict(plugin)

    def run() -> None:
        interaction = dr.zeros(mi.SurfaceInteraction3f, len(wi))
        interaction.wi = mi.Vector3f(wi.T)
        np.array(bsdf.eval(mi.BSDFContext(), interaction, mi.Vector3f(wo.T)))

    return best_time(run, 3)
