"""An environment as shaders read it: radiance and density side by side, and a list of places drawn by brightness."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .environment import Environment

Floats = NDArray[np.float32]

SIDE = 256
"""Cells along each side of the square of numbers from which places are drawn: 65,536 places in all."""


def map_texels(environment: Environment) -> Floats:
    """(H, W, 4): radiance, and the density with which `sample` draws there [1/sr]."""
    return np.concatenate([environment.pixels, environment.density[..., None]], -1)


def places(environment: Environment) -> Floats:
    """(256, 256, 2) places (u, v) in the map, in [0, 1]: v down, both before the environment is turned.

    One for each cell of the square of the two numbers that `sample` takes, rows by the first of them.
    """
    cells = np.stack(np.meshgrid(np.arange(SIDE), np.arange(SIDE), indexing="ij"), -1).reshape(-1, 2)
    within = np.random.default_rng(SIDE).random(cells.shape)
    directions = environment.unturned().sample(((cells + within) / SIDE).astype(np.float32))[0].astype(np.float64)
    u = np.arctan2(directions[:, 0], -directions[:, 2]) / (2 * np.pi) + 0.5
    v = np.arctan2(np.hypot(directions[:, 0], directions[:, 2]), directions[:, 1]) / np.pi
    return np.stack([u, v], -1).astype(np.float32).reshape(SIDE, SIDE, 2)
