"""Shading maps: fitting, looking up, growing. Kautz, Sattler, Sarlette and Klein report 40 s for the fit, in 2004."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from benchmarks.conftest import best_time

import brdf
from brdf.representations.shading import compression as compression
from brdf.representations.shading.slices import Slices

ANGLES = np.linspace(87, 0, 10)
PAIRS = 2_000_000


def stack(size: int, count: int) -> Slices:
    """Random power curves with a little noise: as hard to look up as photographs, if not to compress."""
    rng = np.random.default_rng(0)
    k = rng.uniform(0.2, 1, (size, size, 1, 3)).astype("f4")
    K = rng.uniform(0.5, 2.5, (size, size, 1, 3)).astype("f4")
    x = (np.arange(1, count + 1, dtype="f4") / count)[:, None]
    return Slices(k * x**K + rng.uniform(0, 0.02, (size, size, count, 3)).astype("f4"))


@pytest.mark.benchmark(group="shading map: fit")
@pytest.mark.parametrize("method", compression.METHODS)
def test_fit(benchmark: Any, method: str) -> None:
    """512 x 512 texels, 8 slices (the black one is implied), 3 channels."""
    slices = stack(512, 7)
    small = benchmark.pedantic(compression.METHODS[method], args=(slices,), rounds=5, warmup_rounds=1)
    benchmark.extra_info["RMS error, share of white"] = round(compression.rms(small, slices), 5)
    print(method, benchmark.stats.stats.min if benchmark.stats else "", dict(benchmark.extra_info))


@pytest.mark.benchmark(group="shading map: lookup")
def test_lookup(benchmark: Any, pairs: tuple[np.ndarray, np.ndarray]) -> None:
    """Rendering from what is compressed against rendering from ten pictures: places at random, and row by row."""
    m = brdf.ShadingMap(stack(512, 10), brdf.models.GGX(alpha=0.4) + brdf.models.Lambertian(), ANGLES)
    wi, wo = (w[:PAIRS] for w in pairs)
    random = np.random.default_rng(1).random((PAIRS, 2), dtype="f4")
    side = np.stack(np.meshgrid(np.linspace(0, 1, 2000), np.linspace(0, 1, 1000)), -1).reshape(-1, 2).astype("f4")
    forms = {"pictures": m, "pca 6": m.compress(), "pca 3": m.compress(3)}
    forms |= {name: m.compress(method=name) for name in ("quadratic", "power")}
    for name, form in forms.items():
        for order, uv in (("random", random), ("by rows", side)):
            seconds = best_time(lambda form=form, uv=uv: form(wi, wo, uv), 7)
            benchmark.extra_info[f"{name}, {order}: ns a pair"] = round(seconds / PAIRS * 1e9, 1)
    benchmark.pedantic(forms["pca 6"], args=(wi, wo, random), rounds=3)
    print(dict(benchmark.extra_info))


@pytest.mark.benchmark(group="shading map: make")
def test_ten_photographs(benchmark: Any) -> None:
    """10 photographs of 1024 x 1024, to a compressed map."""
    slices = stack(1024, 10)
    photographs = [np.ascontiguousarray(slices.pictures[:, :, k]) for k in range(10)]
    benchmark.pedantic(
        lambda: brdf.ShadingMap.from_images(photographs, ANGLES, brdf.models.GGX(alpha=0.4)).compress(),
        rounds=3, warmup_rounds=1,
    )  # fmt: skip


@pytest.mark.benchmark(group="shading map: make")
@pytest.mark.parametrize("stored", ["pictures", "compressed"])
def test_growing_sixteenfold(benchmark: Any, stored: str) -> None:
    """512 x 512 to 2048 x 2048."""
    m = brdf.ShadingMap(stack(512, 10), brdf.models.Lambertian(), ANGLES)
    m = m.compress() if stored == "compressed" else m
    benchmark.pedantic(m.synthesise, args=(2048,), rounds=2, warmup_rounds=1)
