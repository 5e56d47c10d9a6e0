"""Evaluations a second, float32, NumPy arrays in and out, beside peers in the same run."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from benchmarks.conftest import best_time, million_per_second, mitsuba_time

import brdf
from brdf.formula import engine
from brdf.formula.vec import Vec

CHUNK = 16_384


def plain_numpy(m: Any, wi: np.ndarray, wo: np.ndarray) -> np.ndarray:
    """The formula on NumPy in chunks that fit the cache: the fastest plain NumPy has been seen to be."""
    out = np.empty_like(wi)
    with np.errstate(all="ignore"):
        for start in range(0, len(wi), CHUNK):
            part = slice(start, start + CHUNK)
            rgb = engine.run(m, Vec(*wi[part].T), Vec(*wo[part].T), True, number=np.float32)
            for channel, component in enumerate(rgb):
                out[part, channel] = component
    return out


def _record(benchmark: Any, m: Any, pairs: tuple[np.ndarray, np.ndarray]) -> dict[str, Any]:
    wi, wo = pairs
    benchmark.pedantic(m, args=pairs, rounds=5, warmup_rounds=1)
    seconds = benchmark.stats.stats.min if benchmark.stats else best_time(lambda: m(wi, wo))
    few = slice(0, 200_000)
    exact = m(wi[few].astype("f8"), wo[few].astype("f8"))
    error = np.abs(m(wi[few], wo[few]) - exact) / np.maximum(np.abs(exact), 1e-4)
    info: dict[str, Any] = benchmark.extra_info
    info["million evaluations a second"] = million_per_second(len(wi), seconds)
    info["relative error p99.9 against float64"] = float(np.quantile(error, 0.999))
    few = slice(0, 2_000_000)
    info["times plain NumPy"] = round(
        best_time(lambda: plain_numpy(m, wi[few], wo[few]), 2) / seconds * len(wi) / 2_000_000, 2
    )
    info["seconds"] = seconds
    return info


@pytest.mark.benchmark(group="evaluate")
def test_ggx_and_oren_nayar(benchmark, pairs):
    gold = {"fresnel": "conductor", "eta": (0.143, 0.375, 1.442), "k": (3.983, 2.386, 1.603)}
    m = brdf.models.Microfacet(alpha=0.2, **gold) + brdf.models.OrenNayar()
    info = _record(benchmark, m, pairs)
    conductor = {"type": "roughconductor", "distribution": "ggx", "alpha": 0.2, "material": "Au"}
    peer = mitsuba_time(conductor, *pairs)
    if peer is not None:
        info["times Mitsuba roughconductor"] = round(peer / info["seconds"], 2)
    print(info)


@pytest.mark.benchmark(group="evaluate")
def test_sgd(benchmark, pairs):
    print(_record(benchmark, brdf.load("gold-metallic-paint"), pairs))


@pytest.mark.benchmark(group="evaluate")
def test_merl_trilinear(benchmark, pairs):
    """A MERL table, angles included, against scipy's map_coordinates on three channels without them."""
    from scipy.ndimage import map_coordinates

    from brdf.representations.tables.merl import from_merl, to_merl

    m = from_merl(to_merl(brdf.load("gold-metallic-paint")).astype("f4"), "gold-metallic-paint", "SGD fit")
    wi, wo = (w[:2_000_000] for w in pairs)
    benchmark.pedantic(m, args=(wi, wo), rounds=5, warmup_rounds=1)
    seconds = benchmark.stats.stats.min if benchmark.stats else best_time(lambda: m(wi, wo))
    table = next(iter(m.textures.values()))
    at = np.random.default_rng(0).uniform(0, 1, (3, len(wi))) * np.array(table.shape[:3])[:, None] - 0.5
    peer = best_time(lambda: [map_coordinates(table[..., c], at, order=1, mode="nearest") for c in range(3)], 1)
    info = benchmark.extra_info
    info["million evaluations a second"] = million_per_second(len(wi), seconds)
    info["times scipy map_coordinates"] = round(peer / seconds, 2)
    info["relative error p99.9 against float64"] = float(
        np.quantile(np.abs(m(wi, wo) - m(wi.astype("f8"), wo.astype("f8"))) / np.maximum(m(wi, wo), 1e-4), 0.999)
    )
    print(info)
