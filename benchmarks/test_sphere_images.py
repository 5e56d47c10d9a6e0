"""Pictures of spheres: evaluations a second beside a formula and a table in the same run, and their error beside it.

The second benchmark is the PSNR of 100 shipped materials: the tables of docs/sphere-images.md.
"""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks.conftest import best_time, million_per_second

import brdf

PAIRS = 2_000_000
BLENDS = ("paper", "monotone", "separated")


@pytest.mark.benchmark(group="sphere images")
def test_evaluations_a_second(benchmark, pairs):
    wi, wo = (w[:PAIRS] for w in pairs)
    source = brdf.models.Lambertian(albedo=0.5) + brdf.models.GGX(alpha=0.2, F0=0.04)
    images = brdf.SphereImages.bake(source, size=512)
    metals = brdf.SphereImages.bake(source, "metal", size=512)
    many = brdf.SphereImages.bake(source, np.linspace(0, 173, 64), size=64)
    contenders = {
        "GGX": brdf.models.GGX(alpha=0.2),
        "Table 64 KB": brdf.SliceStack.bake(source, "64K"),
        **{f"4 pictures, {blend}": images.with_blend(blend) for blend in BLENDS},
        "6 pictures, separated": metals.with_blend("separated"),
        "64 pictures, monotone": many,
    }
    rates = {}
    for name, m in contenders.items():
        rate = million_per_second(PAIRS, best_time(lambda m=m: m(wi, wo), 3))
        psnr = "-" if name == "GGX" else round(brdf.metrics.psnr(source, m), 1)
        rates[name] = {"million evaluations a second": rate, "PSNR": psnr, "bytes": m.nbytes}
    benchmark.pedantic(lambda: images(wi, wo), rounds=3, warmup_rounds=1)
    benchmark.extra_info.update(rates)
    for name, row in rates.items():
        print(f"{name:24s}", row)


@pytest.mark.benchmark(group="compact")
@pytest.mark.parametrize(("angles", "size"), [("plastic", 256), ("plastic", 512), ("metal", 256)])
def test_hundred_materials(benchmark, angles, size):
    names = [name for name in brdf.materials.names() if "/" not in name]
    sources = [brdf.materials.get(f"{name}@bagher_sgd") for name in names]
    assert len(sources) == 100
    baked = benchmark.pedantic(lambda: [brdf.SphereImages.bake(m, angles, size) for m in sources], rounds=1)
    for blend in BLENDS:
        psnr = [brdf.metrics.psnr(m, k.with_blend(blend)) for m, k in zip(sources, baked, strict=True)]
        worst = names[int(np.argmin(psnr))]
        benchmark.extra_info[blend] = {"mean": round(np.mean(psnr), 2), "least": round(min(psnr), 2), "worst": worst}
    print(angles, size, benchmark.extra_info)
