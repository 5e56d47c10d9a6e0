"""What a class may declare: parameters (numbers and colours), textures (arrays to look up in) and choices."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError, UnknownNameError

if TYPE_CHECKING:
    from .parameterised import Parameterised

Value = float | NDArray[np.float64]
RGB = Any
Scalar = Any


class CallableValue(np.ndarray):
    """The value of a parameter named like a method: `m.albedo` is Lambert's parameter, `m.albedo(wo)` the quantity."""

    _method: Callable[..., Any]

    @classmethod
    def of(cls, value: Value, method: Callable[..., Any]) -> CallableValue:
        array = np.asarray(value).view(cls)
        array._method = method
        return array

    def __call__(self, *arguments: Any, **keywords: Any) -> Any:
        return self._method(*arguments, **keywords)


@dataclass(frozen=True)
class Parameter:
    """One declared parameter.

    `size` is 1 (a number) or 3 (a colour; one number given means all three). `low <= value <= high`. A parameter that
    `follows` another has no default of its own: it takes the other's value unless it is given.
    """

    doc: str
    default: float | tuple[float, ...] | None
    low: float = -math.inf
    high: float = math.inf
    unit: str = "1"
    size: int = 1
    follows: str | None = None
    name: str = field(default="", init=False, compare=False)
    method: Callable[..., Any] | None = field(default=None, init=False, compare=False)
    """The inherited method that bears the same name, if any."""

    def __set_name__(self, owner: type, name: str) -> None:
        object.__setattr__(self, "name", name)
        inherited = (vars(base).get(name) for base in owner.__mro__[1:])
        object.__setattr__(self, "method", next((m for m in inherited if inspect.isfunction(m)), None))

    def __get__(self, owner: Parameterised | None, cls: type) -> Any:
        if owner is None:
            return self
        for name in (self.name, self.follows):
            if name in owner._values:
                value = owner._values[name]
                return value if self.method is None else CallableValue.of(value, partial(self.method, owner))
        raise AttributeError(f"{self.name} is not in force in {owner!r}")

    def validated(self, name: str, value: Any) -> Value:
        """`value` as float (size 1) or float64 array (size 3). Raises ParameterError."""
        try:
            given = np.asarray(value)
            if given.dtype.kind not in "biuf":
                raise TypeError
            array = given.astype(np.float64)
        except (TypeError, ValueError):
            raise ParameterError(f"{name} must be {self._kind}, got {value!r}") from None
        if array.shape not in ((), (self.size,)):
            raise ParameterError(f"{name} must be {self._kind}, got shape {array.shape}")
        if not np.all((array >= self.low) & (array <= self.high) & np.isfinite(array)):
            raise ParameterError(f"{name} must lie in {self.interval}, got {plain(array)}")
        if self.size == 1:
            return float(array.reshape(()))
        array = np.broadcast_to(array, (self.size,)).copy()
        array.flags.writeable = False
        return array

    @property
    def interval(self) -> str:
        """The bounds as mathematics writes them; infinity is never a value."""
        low = "(-inf" if math.isinf(self.low) else f"[{self.low:g}"
        high = "inf)" if math.isinf(self.high) else f"{self.high:g}]"
        return f"{low}, {high}"

    @property
    def _kind(self) -> str:
        return "a number" if self.size == 1 else f"a number or {self.size} numbers"


def plain(array: NDArray[np.float64]) -> str:
    return f"{array:g}" if array.ndim == 0 else "(" + ", ".join(f"{v:g}" for v in array) + ")"


@dataclass(frozen=True)
class Texture:
    """A declared texture: samples (n1, …, nk, channels) of a function, for `texture1d` to `texture3d`.

    Given with or without the channel axis where there is one channel; kept in float32. `low <= samples <= high`.
    """

    doc: str
    default: Any
    dimensions: int = 1
    channels: int = 1
    low: float = -math.inf
    high: float = math.inf
    unit: str = "1"
    name: str = field(default="", init=False, compare=False)

    def __set_name__(self, owner: type, name: str) -> None:
        object.__setattr__(self, "name", name)

    def __get__(self, owner: Parameterised | None, cls: type) -> Any:
        return self if owner is None else owner._given_textures[self.name]

    def validated(self, name: str, value: Any) -> NDArray[np.float32]:
        """`value` as a read-only float32 array with its channel axis. Raises ParameterError."""
        try:
            array = np.array(value, np.float32)
        except (TypeError, ValueError):
            raise ParameterError(f"{name} must be an array of numbers, got {type(value).__name__}") from None
        if array.ndim == self.dimensions and self.channels == 1:
            array = array[..., None]
        if array.ndim != self.dimensions + 1 or array.shape[-1] != self.channels or min(array.shape[:-1]) < 2:
            wanted = ", ".join(["n"] * self.dimensions + [str(self.channels)])
            raise ParameterError(f"{name} must have shape ({wanted}) with n >= 2, got {np.shape(value)}")
        if not np.all((array >= self.low) & (array <= self.high) & np.isfinite(array)):
            raise ParameterError(f"{name} must hold numbers in [{self.low:g}, {self.high:g}]")
        array.flags.writeable = False
        return array


@dataclass(frozen=True)
class Choice:
    """A declared choice between named parts or behaviours; part of the formula's structure, not a number in it."""

    doc: str
    default: str
    options: Mapping[str, Any]
    name: str = field(default="", init=False, compare=False)

    def __set_name__(self, owner: type, name: str) -> None:
        object.__setattr__(self, "name", name)

    def __get__(self, owner: Parameterised | None, cls: type) -> Any:
        return self if owner is None else owner._chosen[self.name]

    def validated(self, name: str, value: Any) -> str:
        """The option's name; a number stands for a name in digits (a year). Raises UnknownNameError."""
        text = f"{value:g}" if isinstance(value, (int, float)) else str(value)
        if text not in self.options:
            raise UnknownNameError(name, text, self.options)
        return text


def number(
    doc: str, default: float | None = None, low: float = -math.inf, high: float = math.inf, unit: str = "1",
    follows: str | None = None,
) -> Any:  # fmt: skip
    return Parameter(doc, default, low, high, unit, 1, follows)


def rgb(
    doc: str,
    default: float | tuple[float, ...],
    low: float = -math.inf,
    high: float = math.inf,
    unit: str = "1",
) -> Any:
    return Parameter(doc, default, low, high, unit, 3)


def albedo(doc: str, default: float | tuple[float, ...] = 0.5) -> Any:
    """A colour in [0, 1]."""
    return rgb(doc, default, 0.0, 1.0)


def width(doc: str, default: float | None = None, follows: str | None = None) -> Any:
    """A lobe width `alpha`, as it enters the formula (not the perceptual roughness)."""
    return Parameter(doc, default, 1e-4, 1.0 if default is None or default <= 1 else 10.0, "1", 1, follows)


def texture(
    doc: str, default: Any, dimensions: int = 1, channels: int = 1, low: float = -math.inf, high: float = math.inf,
    unit: str = "1",
) -> Any:  # fmt: skip
    """Samples that the formula looks up: `default` is an array as a user would give it."""
    return Texture(doc, default, dimensions, channels, low, high, unit)


def choice(doc: str, default: str, options: Mapping[str, Any]) -> Any:
    return Choice(doc, default, options)
