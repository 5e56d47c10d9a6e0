"""Leather, wood, wax, plastic, stone."""

from __future__ import annotations

import math

import numpy as np

from .patterns import Random, cells, noise, places, smoothstep, strokes
from .registry import blend, gloss, material, matte
from .surface import MicroSurface


@material("leather")
def leather(n: int, rng: Random) -> MicroSurface:
    """Grained hide: pebbles of uneven size between creases, pores, a waxed finish."""
    x, y = places(n)
    bend = [0.006 * noise(n, rng, 2, 12, 1.0) + 0.0008 * noise(n, rng, 12, 40, 0.8) for _ in range(2)]
    large = cells(x + bend[0], y + bend[1], rng, 22, 0.95)
    small = cells(x + bend[1], y - bend[0], rng, 46, 0.95)
    pebbles = smoothstep(-0.12, 0.6, large.second - large.nearest)
    grains = smoothstep(-0.12, 0.6, small.second - small.nearest)
    deep = 0.75 + 0.25 * noise(n, rng, 2, 8, 1.0)
    fine = noise(n, rng, 60, 220, 0.6)
    height = 0.0040 * deep * pebbles + 0.0011 * grains + 0.0016 * noise(n, rng, 2, 10, 1.2) + 0.00008 * fine
    worn = 0.25 + 0.5 * pebbles * grains + 0.08 * noise(n, rng, 2, 20, 0.8) + 0.05 * fine
    colour = blend((0.035, 0.014, 0.008), (0.20, 0.085, 0.040), worn)
    return MicroSurface(height, (matte(colour), gloss(0.30, 0.35 + 0.65 * pebbles * grains)))


@material("pressed wood")
def pressed_wood(n: int, rng: Random) -> MicroSurface:
    """Chipboard: flat chips of several woods, pressed over each other in all directions."""
    count = 3600
    size = np.sort(rng.lognormal(0.0, 0.5, count))[::-1]
    chips = strokes(
        n, rng.random(count), rng.random(count), rng.random(count) * math.pi, 0.085 * size, 0.018 * size ** 0.7,
        0.0, 0.0016 * np.arange(count) / count + 0.0014 * rng.random(count), 0.0006,
        0.0008 * rng.standard_normal(count), ground=0.0, flat=True,
    )  # fmt: skip
    kind = rng.random(count)
    grain = chips.of_owner(rng.integers(3, 9, count)) * chips.across + 1.3 * chips.of_owner(rng.random(count))
    grain = grain + 0.25 * noise(n, rng, 6, 40, 0.8)
    lines = smoothstep(0.2, 1.0, np.cos(2 * math.pi * grain))
    fine = noise(n, rng, 50, 240, 0.4)
    height = chips.height - 0.00045 * lines + 0.00018 * fine
    tone = chips.of_owner(kind) - 0.28 * lines + 0.07 * fine
    colour = blend((0.17, 0.085, 0.035), (0.62, 0.42, 0.22), tone)
    edge = smoothstep(0.86, 1.0, np.maximum(np.abs(chips.across), np.abs(chips.along)))
    colour *= (1 - 0.45 * edge)[..., None]
    return MicroSurface(height, (matte(colour), gloss(0.35, chips.of_owner(0.15 + 0.6 * rng.random(count)))))


@material("wax")
def wax(n: int, rng: Random) -> MicroSurface:
    """Candle wax: soft swellings, hardened runs, places that are more polished than others."""
    swell = noise(n, rng, 2, 9, 1.2)
    runs = smoothstep(0.3, 1.6, noise(n, rng, 4, 14, 0.6, stretch=(1.0, 4.0)))
    specks = smoothstep(2.0, 2.8, noise(n, rng, 20, 70, 0.5))
    scratched = noise(n, rng, 20, 160, 0.8, stretch=(0.25, 1.0))
    height = 0.0034 * swell + 0.0036 * runs + 0.0014 * specks + 0.00010 * scratched
    polished = smoothstep(-0.6, 0.9, noise(n, rng, 3, 24, 0.9))
    colour = blend((0.60, 0.38, 0.15), (0.84, 0.68, 0.38), 0.4 + 0.22 * swell + 0.4 * runs - 0.4 * specks)
    return MicroSurface(height, (matte(colour), gloss(0.14, polished), gloss(0.40, 1 - polished)))


@material("plastic")
def plastic(n: int, rng: Random) -> MicroSurface:
    """A moulded casing: one colour, one gloss, a grain of small domes."""
    x, y = places(n)
    bend = [0.003 * noise(n, rng, 4, 20, 0.8) for _ in range(2)]
    domes = cells(x + bend[0], y + bend[1], rng, 34, 0.85)
    rounded = 1 - smoothstep(0.0, 0.85, domes.nearest)
    height = 0.0050 * rounded + 0.0005 * noise(n, rng, 10, 40, 0.6) + 0.00006 * noise(n, rng, 100, 240, 0.2)
    return MicroSurface(height, (matte((0.05, 0.16, 0.42)), gloss(0.18)))


@material("stone")
def stone(n: int, rng: Random) -> MicroSurface:
    """Granite, rough from the saw: grains of feldspar, quartz and mica."""
    x, y = places(n)
    bend = [0.006 * noise(n, rng, 6, 60, 0.7) for _ in range(2)]
    grains = cells(x + bend[0], y + bend[1], rng, 40, 1.0)
    kind = rng.random(1600)
    level = rng.random(1600)
    colours = np.select(
        [kind[:, None] < 0.20, kind[:, None] < 0.52, kind[:, None] < 0.60],
        [(0.035, 0.035, 0.04), (0.34, 0.32, 0.30), (0.42, 0.24, 0.17)],
        (0.50, 0.46, 0.42),
    )
    tone = np.exp(0.12 * rng.standard_normal((1600, 1)))
    fine = noise(n, rng, 60, 250, 0.5)
    colour = (colours * tone)[grains.owner] * (1 + 0.10 * fine)[..., None]
    seam = smoothstep(0.0, 0.12, grains.second - grains.nearest)
    rough = noise(n, rng, 3, 120, 1.4)
    pits = smoothstep(1.2, 2.2, noise(n, rng, 12, 60, 0.6))
    height = 0.0030 * rough + 0.0012 * level[grains.owner] * seam + 0.0008 * seam - 0.004 * pits + 0.00012 * fine
    shining = np.where(kind < 0.20, 0.9, np.where(kind < 0.52, 0.7, 0.15))[grains.owner]
    return MicroSurface(height, (matte(np.clip(colour, 0.01, 0.9)), gloss(0.25, shining)))
