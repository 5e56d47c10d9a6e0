"""The renderer: the pictures users ask for first, warm."""

from __future__ import annotations

import pytest

import brdf


@pytest.mark.benchmark(group="render")
def test_one_light(benchmark):
    """800x600, teapot, one directional light, GGX."""
    m = brdf.models.GGX(alpha=0.2, F0=(1.0, 0.78, 0.34))
    image = benchmark.pedantic(
        brdf.render, args=(m,), kwargs={"lights": "directional:theta=30,phi=45,power=3"}, rounds=5, warmup_rounds=1
    )
    benchmark.extra_info["brightest radiance"] = float(image.pixels.max())


@pytest.mark.benchmark(group="render")
def test_studio(benchmark):
    """800x600, teapot under the studio environment at the default number of samples; error against 16 times as many."""
    m = brdf.load("gold-metallic-paint")
    image = benchmark.pedantic(brdf.render, args=(m,), rounds=3, warmup_rounds=1)
    reference = brdf.render(m, size=(800, 600), samples=256, seed=1)
    noise = image.developed().astype(float) - reference.developed()
    benchmark.extra_info["RMS of the noise, of 255"] = float((noise**2).mean() ** 0.5)
