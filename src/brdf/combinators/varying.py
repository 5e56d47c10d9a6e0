"""A reflectance whose parameters change over the surface (SV-BRDF): an image a parameter."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import DirectionError, ParameterError, ReflectanceError, UnknownNameError
from ..formula import texture2d
from ..formula.backends import backend_of
from ..formula.textures import lookup
from ..formula.vec import Vec
from ..geometry.arguments import MIDDLE
from ..geometry.sampling import CosineSampler, MixtureSampler, Sampler
from ..parameters import Parameterised, declaration
from ..reflectance import Reflectance
from .sums import Scaled, Sum

PREFIX = "map_"

SAMPLED_PLACES = 4
"""Places whose samplers are mixed; they span the range of the maps."""

GRID = 16
"""Places along each side among which those are chosen."""


class SpatiallyVarying(Reflectance):
    """f(wi, wo, uv) = f_base(wi, wo) with the parameters that the maps have at uv      [1/sr]

    `maps`: for each parameter that varies, by its full name in `base.values`, an image (rows, columns) or (rows,
    columns, channels), the first row at the top; u runs to the right, v up, both in [0, 1]; linearly filtered, clamped
    at the edge. `at(uv)` is the reflectance of one place.

    One density serves all places: a mixture of the base's samplers at a few of them and of a cosine lobe. Raises
    UnknownNameError, ParameterError, and ReflectanceError for a base that has delta events, or whose derived textures
    depend on a parameter that should vary.
    """

    varies = True

    def __init__(self, base: Reflectance, **maps: ArrayLike) -> None:
        if not maps:
            raise ParameterError("a spatially varying reflectance needs a map for at least one parameter")
        if base.varies or not base.has_formula or base.has_delta:
            raise ReflectanceError(f"{base.name} cannot vary: it needs a formula, no delta events, and to be uniform")
        self._children = {"base": base}
        self.maps: dict[str, NDArray[np.float32]] = {name: _validated(base, name, m) for name, m in maps.items()}
        self._refuse_stale_textures(base)
        self.name = f"{base.name}, varying {' and '.join(maps)}"

    def _refuse_stale_textures(self, base: Reflectance) -> None:
        if base.textures:
            for name, image in self.maps.items():
                ends = [with_values(base, {name: image.reshape(-1, image.shape[-1])[i]}).textures
                        for i in (image.mean(-1).argmin(), image.mean(-1).argmax())]  # fmt: skip
                if any(not np.array_equal(ends[0][key], ends[1][key]) for key in ends[0]):
                    raise ReflectanceError(f"{name} of {base.name} cannot vary: a table is derived from it")

    @property
    def children(self) -> Mapping[str, Reflectance]:
        return self._children

    @property
    def isotropic(self) -> bool:
        return all(m.isotropic for m in self._typical())

    @property
    def structure(self) -> tuple[Any, ...]:
        shapes = ((name, image.shape) for name, image in self.maps.items())
        return (SpatiallyVarying, *shapes, self._children["base"].structure)

    @property
    def values(self) -> Mapping[str, Any]:
        return {f"base_{k}": v for k, v in self._children["base"].values.items()}

    @property
    def textures(self) -> Mapping[str, NDArray[Any]]:
        own = {PREFIX + name: image for name, image in self.maps.items()}
        return own | {f"base_{k}": v for k, v in self._children["base"].textures.items()}

    def f(self, wi: Vec, wo: Vec) -> Vec:
        bound: Any = self
        u, v = bound.uv
        here = {}
        for name, image in self.maps.items():
            channels = texture2d(getattr(bound, PREFIX + name), 1.0 - v, u)
            here[name] = channels[0] if image.shape[-1] == 1 else channels
        value: Vec = bound.bound_child("base", here).f(wi, wo)
        return value

    def at(self, uv: ArrayLike = MIDDLE) -> Reflectance:
        """The reflectance of one place (2,). Raises DirectionError."""
        place = np.asarray(uv, np.float64)
        if place.shape != (2,):
            raise DirectionError(f"uv must have shape (2,), got {place.shape}")
        u, v = place
        values = {
            name: np.array(lookup(image, (np.float64(1 - v), np.float64(u)), backend_of(u)).components)
            for name, image in self.maps.items()
        }
        return with_values(self._children["base"], values)

    def _typical(self) -> list[Reflectance]:
        """The reflectances of a few places, from where the first map is smallest to where it is largest."""
        axis = (np.arange(GRID) + 0.5) / GRID
        places = np.stack(np.meshgrid(axis, axis), -1).reshape(-1, 2)
        image = next(iter(self.maps.values()))
        size = np.array(image.shape[:2])
        rows, columns = np.minimum((np.stack([1 - places[:, 1], places[:, 0]]) * size[:, None]).astype(int).T,
                                   size - 1).T  # fmt: skip
        order = np.argsort(image[rows, columns].mean(-1), kind="stable")
        chosen = order[np.linspace(0, len(order) - 1, SAMPLED_PLACES).round().astype(int)]
        return [self.at(places[i]) for i in chosen]

    def _make_sampler(self) -> Sampler:
        samplers: list[Sampler] = [m.sampler for m in self._typical()]
        return MixtureSampler([*samplers, CosineSampler()], [1.0] * (len(samplers) + 1))

    def _state(self) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
        return {}, {PREFIX + name: image for name, image in self.maps.items()}

    @classmethod
    def _restore(cls, header: Any, arrays: Mapping[str, NDArray[Any]], children: Any) -> Reflectance:
        maps = {key.removeprefix(PREFIX): a for key, a in arrays.items() if key.startswith(PREFIX)}
        return cls(children["base"], **maps)


def with_values(m: Reflectance, values: Mapping[str, Any]) -> Reflectance:
    """A copy with other values, by full name, inside sums and scaled reflectances, too. Raises ReflectanceError."""
    inner = {key: {k.removeprefix(f"{key}_"): v for k, v in values.items() if k.startswith(f"{key}_")}
             for key in m.children}  # fmt: skip
    if isinstance(m, Sum):
        return Sum([with_values(lobe, inner[key]) for key, lobe in m.children.items()])
    if isinstance(m, Scaled):
        base = with_values(m.children["base"], inner["base"])
        return Scaled(base, values.get("scale", m.scale))
    if not values:
        return m
    if not isinstance(m, Parameterised) or m.children:
        raise ReflectanceError(f"parameters of {m.name or type(m).__name__} cannot be replaced")
    plain = {k: float(np.squeeze(v)) if np.size(v) == 1 else v for k, v in values.items()}
    changed: Reflectance = m.replaced(**plain)
    return changed


def _validated(base: Reflectance, name: str, image: ArrayLike) -> NDArray[np.float32]:
    """The map as read-only (rows, columns, 1 or 3) in float32."""
    declared = declaration(base, name) if name in base.values else None
    if declared is None:
        raise UnknownNameError("parameter to vary", name, base.values)
    try:
        array = np.array(image, np.float32)
    except (TypeError, ValueError):
        raise ParameterError(f"the map of {name} must be an array of numbers") from None
    if array.ndim == 2:
        array = array[..., None]
    if array.ndim != 3 or array.shape[-1] not in (1, declared.size) or 0 in array.shape:
        raise ParameterError(f"the map of {name} must be (rows, columns, {declared.size}), got {np.shape(image)}")
    if not np.all((array >= np.float32(declared.low)) & (array <= np.float32(declared.high))):
        raise ParameterError(f"the map of {name} must lie in [{declared.low:g}, {declared.high:g}]")
    # rounding to float32 must not lead out of the bounds
    array = np.ascontiguousarray(np.broadcast_to(array, (*array.shape[:2], declared.size)))
    array.flags.writeable = False
    return array
