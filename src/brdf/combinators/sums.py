"""Reflectances made of reflectances: sums, scaled ones, mixtures."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError
from ..formula import where
from ..formula.vec import Vec
from ..geometry.sampling import MixtureSampler, Sampler
from ..parameters import RGB, Parameterised, rgb
from ..reflectance import Floats, Reflectance
from .of_one import OfOne

_SHARE = rgb("share of the second", default=0.5, low=0.0, high=1.0)


class Sum(Reflectance):
    """f = f1 + f2 + …; its lobes are `lobe1`, `lobe2`, …"""

    def __init__(self, lobes: list[Reflectance]) -> None:
        if not lobes:
            raise ValueError("a sum needs at least one lobe")
        self._children = {f"lobe{i + 1}": lobe for i, lobe in enumerate(lobes)}
        self.name = " + ".join(lobe.name or type(lobe).__name__ for lobe in lobes)

    @property
    def has_formula(self) -> bool:
        return all(lobe.has_formula for lobe in self._children.values())

    @property
    def isotropic(self) -> bool:
        return all(lobe.isotropic for lobe in self._children.values())

    @property
    def structure(self) -> tuple[Any, ...]:
        return (Sum, *(lobe.structure for lobe in self._children.values()))

    @property
    def values(self) -> Mapping[str, Any]:
        return {f"{key}_{k}": v for key, lobe in self._children.items() for k, v in lobe.values.items()}

    @property
    def textures(self) -> Mapping[str, NDArray[Any]]:
        return {f"{key}_{k}": v for key, lobe in self._children.items() for k, v in lobe.textures.items()}

    @property
    def children(self) -> Mapping[str, Reflectance]:
        return self._children

    @property
    def transmits(self) -> bool:  # type: ignore[override]
        return any(lobe.transmits for lobe in self._children.values())

    @property
    def varies(self) -> bool:  # type: ignore[override]
        return any(lobe.varies for lobe in self._children.values())

    @property
    def relative_index(self) -> float:
        return next((lobe.relative_index for lobe in self._children.values() if lobe.transmits), 1.0)

    def _delta_arrays(self, wi: Floats, wo: Floats) -> Floats:
        total: Floats = np.add.reduce([lobe.delta(wi, wo) for lobe in self._children.values()])
        return total

    def f(self, wi: Vec, wo: Vec) -> Vec:
        first, *others = (self._value(getattr(self, key), wi, wo) for key in self.children)
        total: Vec = sum(others, first)
        return total

    def _value(self, lobe: Any, wi: Vec, wo: Vec) -> Vec:
        """A lobe that only reflects adds nothing below the horizon to one that transmits."""
        value: Vec = lobe.f(wi, wo)
        if self.transmits and not lobe.transmits:
            value = where((wi.z > 0) & (wo.z > 0), value, 0.0 * wi.z)
        return value

    def _evaluate_arrays(self, wi: Floats, wo: Floats, clamp: bool) -> Floats:
        lobe_values = (lobe(wi, wo) if clamp else lobe.raw(wi, wo) for lobe in self._children.values())
        total: Floats = np.add.reduce(list(lobe_values))
        return total

    def _evaluate_places(self, wi: Floats, wo: Floats, uv: Floats, clamp: bool) -> Floats:
        lobe_values = (lobe(wi, wo, uv) if clamp else lobe.raw(wi, wo, uv) for lobe in self._children.values())
        total: Floats = np.add.reduce(list(lobe_values))
        return total

    def _make_sampler(self) -> Sampler:
        lobes = list(self._children.values())
        return MixtureSampler([lobe.sampler for lobe in lobes], [_typical_albedo(lobe) for lobe in lobes])

    def _state(self) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
        return {}, {}

    @classmethod
    def _restore(cls, header: Any, arrays: Any, children: Mapping[str, Reflectance]) -> Reflectance:
        return cls(list(children.values()))

    def __repr__(self) -> str:
        return " + ".join(map(repr, self._children.values()))


class Scaled(Parameterised, OfOne):
    """f = scale · f_base."""

    scale: RGB = rgb("factor", default=1.0, low=0.0)

    def __init__(self, base: Reflectance, scale: Any = 1.0) -> None:
        super().__init__(scale=scale)
        OfOne.__init__(self, base)

    @property
    def structure(self) -> tuple[Any, ...]:
        return (Scaled, self._children["base"].structure)

    @property
    def values(self) -> dict[str, Any]:
        return super().values | {f"base_{k}": v for k, v in self._children["base"].values.items()}

    @property
    def textures(self) -> dict[str, NDArray[Any]]:
        return {f"base_{k}": v for k, v in self._children["base"].textures.items()}

    @property
    def transmits(self) -> bool:  # type: ignore[override]
        return self._children["base"].transmits

    @property
    def relative_index(self) -> float:
        return self._children["base"].relative_index

    def _delta_arrays(self, wi: Floats, wo: Floats) -> Floats:
        carried = self._children["base"].delta(wi, wo)
        return carried * np.asarray(self.scale, carried.dtype)

    def f(self, wi: Vec, wo: Vec) -> Vec:
        value: Vec = self.scale * self.base.f(wi, wo)
        return value

    def _evaluate_arrays(self, wi: Floats, wo: Floats, clamp: bool) -> Floats:
        base = self._children["base"]
        value: Floats = base(wi, wo) if clamp else base.raw(wi, wo)
        return value * np.asarray(self.scale, value.dtype)

    def _evaluate_places(self, wi: Floats, wo: Floats, uv: Floats, clamp: bool) -> Floats:
        base = self._children["base"]
        value: Floats = base(wi, wo, uv) if clamp else base.raw(wi, wo, uv)
        return value * np.asarray(self.scale, value.dtype)

    def _make_sampler(self) -> Sampler:
        return self._children["base"].sampler

    def _state(self) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
        return {"scale": list(self.scale)}, {}

    @classmethod
    def _restore(cls, header: Any, arrays: Any, children: Mapping[str, Reflectance]) -> Reflectance:
        return cls(children["base"], header["scale"])

    def replaced(self, **changes: Any) -> Scaled:
        return Scaled(self._children["base"], **{"scale": self.scale, **changes})

    def __repr__(self) -> str:
        return f"{tuple(map(float, self.scale))} * {self._children['base']!r}"


def add(a: Reflectance, b: Reflectance) -> Sum:
    """a + b, nested sums flattened."""
    lobes = [lobe for m in (a, b) for lobe in (m.children.values() if isinstance(m, Sum) else (m,))]
    return Sum(lobes)


def scaled(base: Reflectance, scale: Any) -> Scaled:
    """scale · base; `scale` is a number or an RGB triple >= 0. Raises ParameterError."""
    if isinstance(base, Scaled):
        outer = Scaled(base, scale).scale
        return Scaled(base.children["base"], outer * base.scale)
    return Scaled(base, scale)


def mix(a: Reflectance, b: Reflectance, t: Any) -> Sum:
    """(1 - t) a + t b; `t` is a number or an RGB triple in [0, 1]. Raises ParameterError."""
    share = _SHARE.validated("t", t)
    return add(scaled(a, 1 - share), scaled(b, share))


def lobes(base: Reflectance, count: int) -> Sum:
    """`count` copies of `base`, each scaled by 1 / count and with parameters of its own: a sum to fit. Raises
    ParameterError.
    """
    if count != int(count) or count < 1:
        raise ParameterError(f"lobes must be a whole number of at least 1, got {count}")
    return Sum([Scaled(base, 1 / count) for _ in range(int(count))])


def _typical_albedo(lobe: Reflectance) -> float:
    """A weight for choosing between lobes: the mean albedo at 45 degrees. It only steers the sampling."""
    return float(lobe.albedo([np.sqrt(0.5), 0.0, np.sqrt(0.5)], samples=256).mean())
