"""The materials that can be simulated, by name: a module of this folder enters its own."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...models.lambertian import Lambertian
from ...models.microfacet import GGX
from ...reflectance import Reflectance
from .surface import Layer, MicroSurface

Make = Callable[[int, np.random.Generator], MicroSurface]

REGISTRY: dict[str, Make] = {}


def material(name: str) -> Callable[[Make], Make]:
    """Enter a function of (texels across, random generator) under that name."""

    def enter(make: Make) -> Make:
        REGISTRY[name] = make
        return make

    return enter


def matte(colour: ArrayLike) -> Layer:
    """Lambertian of the albedo `colour`, (3,) or (n, n, 3)."""
    return Layer(Lambertian(albedo=1.0), _weight(colour))


def gloss(alpha: float, weight: ArrayLike = 1.0, F0: float = 0.04) -> Layer:
    """A colourless GGX highlight; `weight` a number, (3,) or (n, n)."""
    scale = np.asarray(weight, np.float32)
    return Layer(GGX(alpha=alpha, F0=F0), _weight(scale[..., None] if scale.ndim != 1 else scale))


def layer(reflectance: Reflectance, weight: ArrayLike = 1.0) -> Layer:
    """Any reflectance; `weight` a number, (3,) or (n, n, 3)."""
    return Layer(reflectance, _weight(weight))


def blend(first: ArrayLike, second: ArrayLike, share: NDArray[Any]) -> NDArray[Any]:
    """(n, n, 3) from one colour to another as `share` (n, n) goes from 0 to 1."""
    t = np.clip(share, 0, 1)[..., None]
    return np.asarray((1 - t) * np.asarray(first) + t * np.asarray(second))


def _weight(values: ArrayLike) -> NDArray[np.float32]:
    array = np.asarray(values, np.float32)
    if array.ndim == 3:
        return np.ascontiguousarray(np.broadcast_to(array, (*array.shape[:2], 3)))
    return np.array(np.broadcast_to(array, (1, 1, 3)))
