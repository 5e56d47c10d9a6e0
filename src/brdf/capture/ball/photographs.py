"""Photographs of a ball as measurements: radiance of known normals in known light."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from ...color import luminance
from ...geometry.directions import frame
from .outline import Ball

Array = NDArray[np.floating[Any]]

SEEN_RADIUS = 0.97
"""Share of the ball's radius that is used: beyond, a pixel holds many normals, and some of the ground."""

LEAST_COSINE = 0.02
"""Cosine between normal and light below which a pixel says nothing about f, which it is divided by."""

SRGB_SLOPE = (0.44, -0.58, 3e-3)
"""The slope of the sRGB curve is about 0.44 x^-0.58 for x in [0.003, 1]."""


class Samples(NamedTuple):
    """Measurements of f at pairs of directions."""

    wi: Array
    """(N, 3)"""
    wo: Array
    """(N, 3)"""
    values: Array
    """(N, 3) f [1/sr]"""
    radiance: Array
    """(N, 3) pi f cos(theta_i)"""


@dataclass(frozen=True)
class BallPhotographs:
    """Pictures of one ball, cropped to it, top row first."""

    names: tuple[str, ...]
    pictures: Array
    """(N, H, W, 3) radiance pi f cos(theta_i), for lights of irradiance pi"""
    usable: NDArray[np.bool_]
    """(N, H, W) neither saturated nor hidden"""
    lights: Array
    """(N, 3) unit directions to the lights: x right, y up, z to the camera"""
    ball: Ball
    """in the cropped pictures"""

    def __len__(self) -> int:
        return len(self.pictures)

    @property
    def angles(self) -> Array:
        """(N,) angle between light and camera [rad]."""
        return np.arccos(np.clip(self.lights[:, 2], -1, 1))

    @cached_property
    def seen(self) -> NDArray[np.bool_]:
        """(H, W): on the ball, clear of its limb."""
        return self.ball.normals(*self.pictures.shape[1:3])[1] < SEEN_RADIUS

    @cached_property
    def _frames(self) -> Array:
        """(P, 3, 3) rows tangent, bitangent, normal of the pixels seen."""
        normal = self.ball.normals(*self.pictures.shape[1:3])[0][self.seen]
        return np.stack([*frame(normal), normal], 1)

    def select(self, which: Sequence[int]) -> Self:
        """Some of the photographs."""
        chosen = list(which)
        return replace(
            self, names=tuple(self.names[i] for i in chosen), pictures=self.pictures[chosen],
            usable=self.usable[chosen], lights=self.lights[chosen],
        )  # fmt: skip

    def scaled(self, factor: float) -> Self:
        """All radiances times a factor."""
        return replace(self, pictures=self.pictures * np.float32(factor))

    def pixels(self, number: int, least_cosine: float = LEAST_COSINE) -> Samples:
        """The usable, lit pixels of one photograph."""
        wi, wo = self._frames @ self.lights[number], self._frames[:, :, 2]
        good = (wi[:, 2] > least_cosine) & self.usable[number][self.seen]
        radiance = np.asarray(self.pictures[number][self.seen][good], np.float64)
        wi, wo = wi[good], wo[good]
        return Samples(wi, wo, radiance / (math.pi * wi[:, 2:]), radiance)

    def samples(self) -> Samples:
        """All photographs' usable, lit pixels."""
        parts = [self.pixels(number) for number in range(len(self))]
        return Samples(*(np.concatenate(columns) for columns in zip(*parts, strict=True)))

    def diffuse_level(self) -> float:
        """The luminance that a white diffuser of the ball's typical shade would show facing the light: the median of
        radiance over cosine where the light falls in steeply. Highlights are few pixels and do not move a median."""
        found = [self.pixels(number, least_cosine=0.5) for number in range(len(self))]
        shades = [luminance(part.radiance) / part.wi[:, 2] for part in found if len(part.wi)]
        return float(np.median(np.concatenate(shades))) if shades else 0.0


def visible_weight(radiance: Array, wi: Array) -> Array:
    """(N, 3) weights of squared errors of f that count them as the eye would in a picture: times the slope of the sRGB
    curve at `radiance` (smooth, not the noisy one) and pi cos(theta_i). Above 1 they count as shares."""
    factor, power, least = SRGB_SLOPE
    slope = factor * np.maximum(radiance, least) ** power
    return np.asarray((math.pi * wi[:, 2:] * slope) ** 2)
