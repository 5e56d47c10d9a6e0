"""Woven, knitted and napped materials."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...models.oren_nayar import OrenNayar
from ...models.sheen import CharlieSheen
from .patterns import Floats, Random, Strokes, noise, strokes
from .registry import blend, gloss, layer, material, matte
from .surface import MicroSurface


class Weave(NamedTuple):
    """Threads that cross: those of the warp run up, those of the weft across."""

    strokes: Strokes
    is_warp: NDArray[np.bool_]
    """(n, n)"""
    thread: NDArray[np.int32]
    """(n, n) number of the thread that shows; -1 between the threads"""


def weave(n: int, rng: Random, threads: int, over: int, period: int, fill: float, bulge: float, uneven: float) -> Weave:
    """A twill of `threads` in each direction: every warp thread passes over `over` of each `period` weft threads.

    Each next thread does so one weft thread later. `fill`: width of a thread in spacings, `bulge`: its height,
    `uneven`: how much widths vary.
    """
    spacing = 1 / threads
    i, j = np.meshgrid(np.arange(threads), np.arange(threads), indexing="ij")  # warp thread, weft thread
    warp_on_top = (j - i) % period < over
    begins = warp_on_top & ~np.roll(warp_on_top, 1, 1)
    width = fill * spacing * (1 + uneven * rng.standard_normal((2, threads)))
    wander = 0.06 * spacing * rng.standard_normal((2, threads))
    warp_i, warp_j = np.nonzero(begins)
    weft_begins = ~warp_on_top & np.roll(warp_on_top, 1, 0)
    weft_i, weft_j = np.nonzero(weft_begins)
    under = period - over
    x = np.concatenate([(warp_i + 0.5) * spacing + wander[0, warp_i], (weft_i + under / 2) * spacing])
    y = np.concatenate([(warp_j + over / 2) * spacing, (weft_j + 0.5) * spacing + wander[1, weft_j]])
    angle = np.concatenate([np.full(len(warp_i), math.pi / 2), np.zeros(len(weft_i))])
    length = np.concatenate([np.full(len(warp_i), over + 0.75), np.full(len(weft_i), under + 0.75)]) * spacing
    across = np.concatenate([width[0, warp_i], width[1, weft_j]])
    height = bulge * spacing
    laid = strokes(n, x, y, angle, length, across, across / 2, 0.0, height, ground=-height)
    thread = np.concatenate([warp_i, threads + weft_j])
    shown = np.where(laid.owner >= 0, thread[laid.owner], -1)
    return Weave(laid, (shown >= 0) & (shown < threads), shown.astype(np.int32))


def _fibres(laid: Strokes, length: Floats | float, twists: float, phase: Floats | float = 0.0) -> Floats:
    """(n, n) ridges of twisted yarn, -1 to 1: slanting lines around the thread."""
    around = np.arcsin(np.clip(laid.across, -1, 1)) / math.pi
    return np.asarray(np.cos(2 * math.pi * (twists * length * laid.along / 2 + around + phase)))


def _by_thread(rng: Random, woven: Weave, count: int) -> Floats:
    """(n, n) one random number a thread."""
    values = rng.standard_normal(count)
    return np.asarray(np.where(woven.thread >= 0, values[np.maximum(woven.thread, 0)], 0))


@material("jeans")
def jeans(n: int, rng: Random) -> MicroSurface:
    """Denim: a three-and-one twill, the warp indigo and worn, the weft white."""
    threads = 48
    woven = weave(n, rng, threads, over=3, period=4, fill=0.95, bulge=0.12, uneven=0.08)
    ridges = _fibres(woven.strokes, 3.0, 2.5)
    fuzz = noise(n, rng, 60, 220, 0.3)
    height = woven.strokes.height + (0.03 * ridges + 0.009 * fuzz) / threads
    slub = noise(n, rng, 2, 60, 0.4, stretch=(0.15, 1.0))
    worn = 0.30 + 0.16 * _by_thread(rng, woven, 2 * threads) + 0.12 * slub + 0.10 * fuzz
    worn += 0.9 * (woven.strokes.height * threads - 0.55)
    warp = blend((0.016, 0.030, 0.075), (0.17, 0.25, 0.40), worn)
    weft = blend((0.22, 0.26, 0.33), (0.42, 0.45, 0.48), 0.5 + 0.3 * ridges + 0.2 * fuzz)
    colour = np.where(woven.is_warp[..., None], warp, weft)
    colour[woven.thread < 0] = (0.01, 0.015, 0.03)
    return MicroSurface(height, (layer(OrenNayar(albedo=1.0, sigma=0.4), colour),))


@material("cloth")
def cloth(n: int, rng: Random) -> MicroSurface:
    """A coarse plain weave of dyed wool yarn."""
    threads = 32
    woven = weave(n, rng, threads, over=1, period=2, fill=1.05, bulge=0.10, uneven=0.07)
    ridges = _fibres(woven.strokes, 1.75, 1.6)
    fuzz = noise(n, rng, 50, 200, 0.4)
    height = woven.strokes.height + (0.07 * ridges + 0.012 * fuzz) / threads
    tone = 0.5 + 0.22 * _by_thread(rng, woven, 2 * threads) + 0.12 * ridges + 0.15 * fuzz
    warp = blend((0.22, 0.035, 0.02), (0.42, 0.09, 0.05), tone)
    weft = blend((0.30, 0.12, 0.03), (0.52, 0.25, 0.08), tone)
    colour = np.where(woven.is_warp[..., None], warp, weft)
    return MicroSurface(height, (layer(OrenNayar(albedo=1.0, sigma=0.35), colour), layer(CharlieSheen(color=0.06))))


@material("nylon")
def nylon(n: int, rng: Random) -> MicroSurface:
    """Ripstop: a fine plain weave of shining filaments with a thicker thread at regular distances."""
    threads, every = 80, 10
    woven = weave(n, rng, threads, over=1, period=2, fill=1.05, bulge=0.10, uneven=0.02)
    thick = (woven.thread >= 0) & (woven.thread % threads % every == 0)
    filaments = np.cos(2 * math.pi * 2.5 * woven.strokes.across)
    puckered = noise(n, rng, 2, 8, 1.5)
    height = woven.strokes.height + (0.02 * filaments + 0.10 * thick) / threads + 0.0012 * puckered
    tone = 0.5 + 0.12 * _by_thread(rng, woven, 2 * threads)
    colour = blend((0.55, 0.13, 0.012), (0.80, 0.23, 0.03), tone)
    return MicroSurface(height, (matte(0.8 * colour), gloss(0.28, 0.9)))


@material("wool")
def wool(n: int, rng: Random) -> MicroSurface:
    """Stocking stitch of thick yarn, with loose fibres."""
    columns, rows = 12, 15
    i, j = (a.ravel() for a in np.meshgrid(np.arange(columns), np.arange(rows), indexing="ij"))
    wide, high = 1 / columns, 1 / rows
    side = np.concatenate([np.full(len(i), -1.0), np.full(len(i), 1.0)])
    i, j = np.tile(i, 2), np.tile(j, 2)
    loose = 0.04 * rng.standard_normal((2, len(i)))
    x = (i + 0.5 + side * (0.235 + 0.3 * loose[0])) * wide
    y = (j + 0.5 + loose[1]) * high
    angle = math.pi / 2 - side * 0.50 + 0.05 * rng.standard_normal(len(i))
    legs = strokes(n, x, y, angle, 2.1 * high, 0.58 * wide, 0.25 * wide, 0.0, 0.14 * wide, -0.12 * wide, ground=0.0)
    turn = 3.2 * legs.along + 0.9 * np.arcsin(legs.across) * np.where(legs.owner % len(side) < len(side) / 2, 1, -1)
    plies = np.abs(np.sin(math.pi * turn / 2))
    fuzz = noise(n, rng, 40, 200, 0.5)
    height = legs.height + wide * (0.07 * plies + 0.006 * fuzz)
    hairs, count = 0.014 * wide, 5000
    loose_fibres = strokes(
        n, rng.random(count), rng.random(count), rng.random(count) * math.pi, 0.05 + 0.5 * wide * rng.random(count),
        2.2 * hairs, hairs, 0.20 * wide + 0.12 * wide * rng.random(count), 0.0, 0.06 * wide, ground=-1.0,
    )  # fmt: skip
    over = (loose_fibres.height > height) & (loose_fibres.height < height + 0.12 * wide)
    tone = 0.45 + 0.35 * (plies - 0.6) + 0.22 * fuzz + 0.2 * over
    colour = blend((0.30, 0.24, 0.16), (0.66, 0.58, 0.45), tone)
    fluffy = np.where(over, loose_fibres.height, height)
    return MicroSurface(fluffy, (layer(OrenNayar(albedo=1.0, sigma=0.5), colour), layer(CharlieSheen(color=0.08))))


@material("suede")
def suede(n: int, rng: Random) -> MicroSurface:
    """A dense short nap, brushed this way and that."""
    count = 40_000
    x, y = rng.random(count), rng.random(count)
    brushed = noise(256, rng, 1, 10, 1.0)
    at = brushed[(y * 256).astype(int), (x * 256).astype(int)]
    angle = 0.9 * at + 0.7 * rng.standard_normal(count)
    clumps = noise(n, rng, 6, 50, 0.7)
    deep = 0.0022 * rng.random(count)
    nap = strokes(
        n, x, y, angle, 0.014 + 0.012 * rng.random(count), 0.0036, 0.0009, deep, 0.0003, 0.0012, ground=-0.001
    )
    fine = noise(n, rng, 80, 250, 0.2)
    height = nap.height + 0.0009 * clumps + 0.0001 * fine
    tone = 0.45 + 0.16 * nap.of_owner(rng.standard_normal(count)) + 60 * (nap.height - 0.0028) + 0.12 * clumps
    colour = blend((0.15, 0.075, 0.035), (0.46, 0.27, 0.15), tone)
    return MicroSurface(height, (layer(OrenNayar(albedo=1.0, sigma=0.5), colour), layer(CharlieSheen(color=0.10))))
