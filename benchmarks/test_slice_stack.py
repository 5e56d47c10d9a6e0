"""How close 16 KB come: the slice stack against the published fit of each of the 100 materials."""

from __future__ import annotations

import time

import numpy as np
import pytest

import brdf


@pytest.mark.benchmark(group="compact")
@pytest.mark.parametrize("budget", ["4K", "8K", "16K", "32K", "64K", "256K"])
def test_all_materials(benchmark, budget):
    fitted = [name for name in brdf.materials.names() if "bagher_sgd" in brdf.materials.fits(name)]
    sources = [brdf.materials.get(name, "bagher_sgd") for name in fitted]
    brdf.SliceStack.bake(sources[0], budget)  # compiles
    start = time.perf_counter()
    stacks = benchmark.pedantic(lambda: [brdf.SliceStack.bake(m, budget) for m in sources], rounds=1)
    seconds = time.perf_counter() - start
    psnr = {m.name: brdf.metrics.psnr(m, k, size=96) for m, k in zip(sources, stacks, strict=True)}
    values = np.array(list(psnr.values()))
    worst = sorted(psnr, key=lambda name: psnr[name])[:5]
    benchmark.extra_info.update(
        {
            "budget": budget,
            "seconds a material": round(seconds / len(sources), 3),
            "mean PSNR": round(float(values.mean()), 2),
            "mean PSNR, each capped at 100": round(float(values.clip(max=100).mean()), 2),
            "median": round(float(np.median(values)), 2),
            "least": round(float(values.min()), 2),
            "worst": {name: round(psnr[name], 1) for name in worst},
        }
    )
    print(benchmark.extra_info)
