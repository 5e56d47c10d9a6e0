"""Directions at which the laws are measured: reflectance-independent, seeded, dense where lobes are sharp."""

from __future__ import annotations

import functools
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..geometry.directions import cosine_weighted, from_spherical, reflected, to_spherical

Floats = NDArray[np.floating[Any]]

SEED = 7
GRAZING = np.array([1e-6, 1e-4, 1e-2])
"""Cosines close to the horizon."""


@functools.cache
def pairs(count: int) -> tuple[Floats, Floats]:
    """About `count` pairs (N, 3) of directions above the horizon, float64, read-only.

    One half is cosine-weighted in both directions. In the other half `wi` mirrors `wo` in half vectors whose angle to
    the normal is log-uniform from 1e-4 to 1, so that a lobe of any width is met on its flanks.
    """
    rng = np.random.default_rng(SEED)
    wo = cosine_weighted(rng.random((count, 2)))
    mirrored = np.arange(count) < count // 2
    theta_h = np.exp(rng.uniform(np.log(1e-4), 0, count))
    h = from_spherical(theta_h, rng.uniform(-np.pi, np.pi, count))
    wi = np.where(mirrored[:, None], reflected(wo, h), cosine_weighted(rng.random((count, 2))))
    above = (wi[:, 2] > 0) & (wo[:, 2] > 0)
    made = wi[above], wo[above]
    for array in made:
        array.flags.writeable = False
    return made


@functools.cache
def adversarial() -> tuple[Floats, Floats]:
    """All pairs of delicate directions (N, 3): the exact normal, grazing to a cosine of 1e-6, axis-aligned, oblique.

    Among them are wi = wo, exact mirror directions, and directions opposite up to the cosine.
    """
    cosines = np.concatenate([GRAZING, np.cos(np.radians([30.0, 45.0, 80.0]))])
    azimuths = np.arange(8) * (np.pi / 4)
    sine = np.sqrt((1 - cosines) * (1 + cosines))[:, None]
    ring = np.broadcast_arrays(sine * np.cos(azimuths), sine * np.sin(azimuths), cosines[:, None])
    directions = np.concatenate([[[0.0, 0.0, 1.0]], np.stack(ring, axis=-1).reshape(-1, 3)])
    wi, wo = np.repeat(directions, len(directions), axis=0), np.tile(directions, (len(directions), 1))
    for array in (wi, wo):
        array.flags.writeable = False
    return wi, wo


def over_the_sphere(wi: Floats, wo: Floats) -> tuple[Floats, Floats]:
    """Pairs above the horizon (N, 3) as pairs on all sides, (4 N, 3): for what transmits."""
    flip = np.array([1, 1, -1])
    return np.concatenate([wi, wi, wi * flip, wi * flip]), np.concatenate([wo, wo * flip, wo, wo * flip])


def viewers(isotropic: bool, theta_degrees: tuple[float, ...], below: bool = False) -> Floats:
    """Viewing directions (N, 3) at polar angles [degrees], each at an azimuth of its own, or three.

    With `below` as many more follow below the horizon.
    """
    theta = np.radians(theta_degrees)
    if below:
        theta = np.concatenate([theta, np.pi - theta])
    phi = 0.3 + 2.4 * np.arange(len(theta))
    turns = np.zeros(1) if isotropic else np.array([0, np.pi / 3, 2 * np.pi / 3])
    return from_spherical(theta[:, None], phi[:, None] + turns).reshape(-1, 3)


def place(**directions: Floats) -> str:
    """Directions as text: `wi = (30.0°, 90.0°), wo = …`, polar angle and azimuth."""
    shown = []
    for name, w in directions.items():
        theta, phi = (float(np.degrees(angle)) for angle in to_spherical(w))
        shown.append(f"{name} = ({theta:.5g}°, {phi:.4g}°)")
    return ", ".join(shown)
