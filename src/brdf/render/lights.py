"""Lights without extent, and how the command line writes them.

Power is stated so that it can be read off the picture: a white matte surface that faces a light of power 1 (at a
distance of 1 from a point light) has radiance 1; its irradiance is pi times the power.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import ParameterError, UnknownNameError

Floats = NDArray[np.float32]


def direction(theta: float, phi: float) -> NDArray[np.float64]:
    """The unit vector `theta` degrees from +y, turned `phi` degrees from +z towards +x."""
    t, p = np.radians(theta), np.radians(phi)
    return np.array([np.sin(t) * np.sin(p), np.cos(t), np.sin(t) * np.cos(p)])


def _colour(power: ArrayLike) -> NDArray[np.float64]:
    array = np.asarray(power, np.float64)
    if array.shape not in ((), (3,)) or not (np.isfinite(array) & (array >= 0)).all():
        raise ParameterError(f"power of a light must be a number or an RGB triple >= 0, got {power!r}")
    return np.broadcast_to(array, (3,)).copy()


def _slashed(values: NDArray[np.float64]) -> str:
    return "/".join(f"{value:g}" for value in values)


@dataclass(frozen=True, eq=False)
class Directional:
    """Parallel light from the direction `theta` degrees from +y (up), `phi` degrees from +z towards +x (right).

    `power`: a number or RGB. Raises ParameterError.
    """

    theta: float = 45.0
    phi: float = 30.0
    power: Any = 1.0

    def __post_init__(self) -> None:
        if not (math.isfinite(self.theta) and math.isfinite(self.phi)):
            raise ParameterError("theta and phi of a directional light must be finite degrees")
        object.__setattr__(self, "power", _colour(self.power))

    def __str__(self) -> str:
        return f"directional:theta={self.theta:g},phi={self.phi:g},power={_slashed(self.power)}"

    @property
    def toward(self) -> NDArray[np.float64]:
        """The unit vector to the light."""
        return direction(self.theta, self.phi)

    def seen_from(self, points: Floats) -> tuple[Floats, Floats, Floats]:
        """For world points (N, 3): unit directions to the light (N, 3), distances (N,), irradiances (N, 3)."""
        count = len(points)
        toward = np.ascontiguousarray(np.broadcast_to(self.toward.astype(np.float32), (count, 3)))
        irradiance = np.broadcast_to((math.pi * self.power).astype(np.float32), (count, 3))
        return toward, np.full(count, 1e30, np.float32), irradiance


@dataclass(frozen=True, eq=False)
class Point:
    """Light from one world point, falling with the square of the distance. `power`: a number or RGB, at distance 1."""

    position: Any
    power: Any = 1.0

    def __post_init__(self) -> None:
        position = np.asarray(self.position, np.float64)
        if position.shape != (3,) or not np.isfinite(position).all():
            raise ParameterError(f"position of a point light must be three numbers, got {self.position!r}")
        object.__setattr__(self, "position", position)
        object.__setattr__(self, "power", _colour(self.power))

    def __str__(self) -> str:
        return f"point:{_slashed(self.position)},power={_slashed(self.power)}"

    def seen_from(self, points: Floats) -> tuple[Floats, Floats, Floats]:
        """As for a directional light; a point in the very place of the light gets no light from it."""
        offset = self.position.astype(np.float32) - points
        distance = np.linalg.norm(offset, axis=-1)
        apart = distance > 0
        safe = np.where(apart, distance, 1)
        toward = np.where(apart[:, None], offset / safe[:, None], np.array([0, 1, 0], np.float32)).astype(np.float32)
        falloff = (apart / safe**2)[:, None]
        return toward, distance.astype(np.float32), (math.pi * self.power * falloff).astype(np.float32)


Light = Directional | Point

KINDS = {"directional": Directional, "point": Point}
OPTIONS = {"directional": ("theta", "phi", "power"), "point": ("position", "power")}


def parse(text: str) -> Light:
    """A light from text such as "directional:theta=30,phi=45,power=3" or "point:1/2/3,power=1/.9/.8".

    Raises UnknownNameError for a kind or option that does not exist, ParameterError for a bad value.
    """
    kind, _, rest = text.partition(":")
    kind = kind.strip().lower()
    if kind not in KINDS:
        raise UnknownNameError("light", kind, KINDS)
    given: dict[str, Any] = {}
    for part in filter(None, (piece.strip() for piece in rest.split(","))):
        name, equals, value = part.partition("=")
        if not equals:
            if kind != "point" or given:
                raise ParameterError(f"light {text!r}: {part!r} is not of the form option=value")
            name, value = "position", part
        if name not in OPTIONS[kind]:
            raise UnknownNameError(f"option of a {kind} light", name, OPTIONS[kind])
        if name in given:
            raise ParameterError(f"light {text!r}: {name} is given twice")
        given[name] = _numbers(text, name, value)
    if kind == "point" and "position" not in given:
        raise ParameterError(f"light {text!r}: a point light needs its position, as in point:1/2/3")
    return Directional(**given) if kind == "directional" else Point(**given)


def _numbers(text: str, name: str, value: str) -> float | tuple[float, ...]:
    sizes: Mapping[str, tuple[int, ...]] = {"position": (3,), "power": (1, 3)}
    try:
        numbers = tuple(float(part) for part in value.split("/"))
    except ValueError:
        numbers = ()
    allowed = sizes.get(name, (1,))
    if len(numbers) not in allowed:
        form = {(1,): "a number", (3,): "three numbers x/y/z", (1, 3): "a number or r/g/b"}[allowed]
        raise ParameterError(f"light {text!r}: {name} must be {form}, got {value!r}")
    return numbers if len(numbers) > 1 else numbers[0]
