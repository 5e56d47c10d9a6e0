"""Radiance of a height field under one distant lamp: shadows, masking, one bounce."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...geometry.directions import from_spherical
from ...threads import in_ranges
from . import kernels
from .surface import MicroSurface

Floats = NDArray[np.float32]
Indices = NDArray[np.int32]

DIRECTIONS = 8
"""Directions into which a texel looks for its neighbours: with the 4 texels of a pixel, 32 a pixel."""
GRAZING = 0.01
"""Least cosine of a viewing direction: a texel that is seen may have a normal that turns away."""
ALBEDO_COSINES = np.linspace(0.02, 1, 17, dtype=np.float32)
"""Cosines at which the albedo of a layer is tabulated."""
BLOCK = 1 << 16
"""Texels a thread takes at once."""


class Tracer:
    """Follows light over a surface. Texels are numbered row by row; N = n².

    Direct light takes the reflectances as they are, with the shadows that the height field casts in the lamp's
    direction. Light that bounces once is gathered over each texel's hemisphere; in it every surface counts as a
    diffuser of the directional albedo that the reflectance has there: exact for Lambertian layers.
    """

    def __init__(self, surface: MicroSurface, bounce: bool = True, seed: int = 0) -> None:
        self._surface, self._bounce, self._seed = surface, bounce, seed
        self._height = np.ascontiguousarray(surface.height * surface.size, np.float64)
        self._height -= self._height.mean()
        self._top = float(self._height.max())
        self._all = np.arange(surface.size**2, dtype=np.int32)

    def seen(self, wo: Any) -> Indices:
        """(N,) the texel that shows at each texel of the mean plane: parallax and masking."""
        texels, w = np.empty_like(self._all), _unit(wo)
        self._in_blocks(lambda a, b: kernels.seen(a, b, self._height, self._top, w, texels))
        return texels

    def light(self, wi: Any) -> Light:
        """What a lamp in direction `wi` does to every texel, whoever looks."""
        count, w = len(self._all), _unit(wi)
        light = Light(np.empty((count, 3), np.float32), np.empty(count, np.float32), None)
        if self._bounce:
            light.emitted = np.empty((count, 3), np.float32)
            _ = self._albedos  # found once, not by each thread

        def fill(start: int, stop: int) -> None:
            wi_local, visible = light.directions[start:stop], np.empty(stop - start, np.bool_)
            kernels.local(self._height, self._all[start:stop], w, -1.0, wi_local)
            kernels.lit(start, stop, self._height, self._top, w, visible)
            light.irradiance[start:stop] = np.maximum(wi_local[:, 2], 0) * visible
            if light.emitted is not None:
                albedo = self._albedo(wi_local[:, 2], self._all[start:stop])
                light.emitted[start:stop] = albedo * (light.irradiance[start:stop, None] / np.float32(math.pi))

        self._in_blocks(fill)
        return light

    def radiance(self, light: Light, wo: Any, texels: Indices | None = None) -> Floats:
        """(N, 3) radiance towards `wo` under irradiance 1 (on a plane that faces the lamp), of `texels` if given."""
        texels, w = self._all if texels is None else texels, _unit(wo)
        radiance = np.empty((len(texels), 3), np.float32)

        def fill(start: int, stop: int) -> None:
            radiance[start:stop] = self._towards(w, light, texels[start:stop])

        if light.emitted is not None:
            _ = self._neighbours  # as above
        self._in_blocks(fill)
        return radiance

    def _towards(self, w: Any, light: Light, texels: Indices) -> Floats:
        wo_local = np.empty((len(texels), 3), np.float32)
        kernels.local(self._height, texels, w, GRAZING, wo_local)
        total = np.zeros((len(texels), 3), np.float32)
        shown = np.flatnonzero(light.irradiance[texels] > 0)
        source = texels[shown]
        wi, wo, irradiance = light.directions[source], wo_local[shown], light.irradiance[source, None]
        direct = np.zeros((len(shown), 3), np.float32)
        for layer in self._surface.layers:
            direct += layer.weights(source) * layer.reflectance(wi, wo)
        total[shown] = direct * irradiance
        if light.emitted is not None:
            indirect = np.empty_like(total)
            kernels.gathered(texels, self._neighbours, light.emitted, indirect)
            total += indirect * self._albedo(wo_local[:, 2], texels)
        return total

    @cached_property
    def _neighbours(self) -> Indices:
        found = np.empty((len(self._all), DIRECTIONS), np.int32)
        self._in_blocks(lambda a, b: kernels.neighbours(a, b, self._height, self._top, self._seed, found))
        return found

    @cached_property
    def _albedos(self) -> list[Floats]:
        directions = from_spherical(np.arccos(ALBEDO_COSINES), math.pi / 4).astype(np.float32)
        return [layer.reflectance.albedo(directions, 1024).astype(np.float32) for layer in self._surface.layers]

    def _albedo(self, cosine: Floats, texels: Indices) -> Floats:
        """(N, 3) albedo of `texels` towards local directions of that cosine."""
        place = np.clip((cosine - ALBEDO_COSINES[0]) / (1 - ALBEDO_COSINES[0]), 0, 1) * (len(ALBEDO_COSINES) - 1)
        low = np.minimum(place.astype(np.intp), len(ALBEDO_COSINES) - 2)
        part = (place - low)[:, None].astype(np.float32)
        total = np.zeros((len(cosine), 3), np.float32)
        for layer, table in zip(self._surface.layers, self._albedos, strict=True):
            total += layer.weights(texels) * (table[low] * (1 - part) + table[low + 1] * part)
        return total

    def _in_blocks(self, fill: Callable[[int, int], Any]) -> None:
        in_ranges(fill, len(self._all), BLOCK)


@dataclass
class Light:
    """A lamp's light on every texel."""

    directions: Floats
    """(N, 3) to the lamp, in the texels' frames"""
    irradiance: Floats
    """(N,) on the texels; 0 in shadow"""
    emitted: Floats | None
    """(N, 3) radiance that leaves towards other texels; None for no bounce"""


def _unit(w: Any) -> NDArray[np.float64]:
    return np.asarray(w, np.float64).reshape(3)
