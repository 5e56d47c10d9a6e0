"""Axis parameterisations: where the nodes of a table's axis lie.

A warp is a monotone map between an angle and a coordinate in [0, 1]. `coordinate` is a formula (it runs on every
array library and traces into shaders) of the angle's sine and cosine, because those are what two directions give
without loss; `angle` is its inverse on NumPy arrays and places the nodes. Angles beyond the last node have the last
node's coordinate.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import ParameterError, UnknownNameError
from ...formula import Scalar

HALF_PI = math.pi / 2


class Angle(NamedTuple):
    """An angle as a formula knows it: `sine` and `cosine`, of unit norm together.

    In [0, pi], with `sine` >= 0, but for the axes of a whole circle (`Circle`, `TwoSided`).
    """

    sine: Scalar
    cosine: Scalar


@dataclass(frozen=True)
class Warp:
    """Base of the warps. `extent` is the angle of the last node [rad]; that of the first is 0.

    A subclass is a frozen dataclass that gives `coordinate` and `angle`; it enters the registry by being defined.
    """

    kinds: ClassVar[dict[str, type[Warp]]] = {}
    periodic: ClassVar[bool] = False
    """Whether coordinate 1 is coordinate 0 again."""

    extent: float = HALF_PI

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        Warp.kinds[cls.__name__] = cls

    def __post_init__(self) -> None:
        if not 0 < self.extent <= 2 * math.pi:
            raise ParameterError(f"a warp's extent must lie in (0, 2 pi], got {self.extent:g}")

    def coordinate(self, angle: Angle) -> Scalar:
        """The formula: the coordinate in [0, 1]."""
        raise NotImplementedError

    def angle(self, coordinate: ArrayLike) -> NDArray[np.float64]:
        """The angle [rad] at coordinates in [0, 1], any shape."""
        raise NotImplementedError

    def density(self, angle: ArrayLike) -> NDArray[np.float64]:
        """How fast the coordinate grows with the angle [1/rad] at angles [rad] in [0, extent], any shape.

        Times n - 1 it is the number of nodes per radian. A pole may be infinitely dense.
        """
        raise NotImplementedError

    def nodes(self, count: int) -> NDArray[np.float64]:
        """The angles [rad] of `count` nodes, (count,)."""
        return self.angle(np.linspace(0.0, 1.0, count))

    @property
    def state(self) -> dict[str, Any]:
        """What `warp_from` turns back into this warp; plain JSON values."""
        values = {field.name: getattr(self, field.name) for field in fields(self)}
        plain = {name: value.state if isinstance(value, Warp) else value for name, value in values.items()}
        return {"kind": type(self).__name__, **plain}


def warp_from(state: Mapping[str, Any]) -> Warp:
    """The warp that `state` describes. Raises UnknownNameError, ParameterError, or TypeError for a wrong number."""
    values = dict(state)
    kind = values.pop("kind", None)
    if kind not in Warp.kinds:
        raise UnknownNameError("axis warp", str(kind), Warp.kinds)
    return Warp.kinds[kind](**{name: _value(value) for name, value in values.items()})


def _value(value: Any) -> Any:
    if isinstance(value, Mapping):
        return warp_from(value)
    return tuple(value) if isinstance(value, list) else value
