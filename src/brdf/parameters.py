"""Parameters declared once.

A class that has parameters declares them in its body: default, bounds, unit, one line of documentation. Constructor,
validation, `brdf info`, fit transforms, sliders and shader uniforms all derive from the declaration.

    class Ward(Model):
        rho: RGB = albedo("specular reflectance scale", default=0.5)
        alpha_x: Scalar = width("RMS slope along the tangent", default=0.2)
        alpha_y: Scalar = width("RMS slope along the bitangent", follows="alpha_x")
"""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from .errors import ParameterError, UnknownNameError

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
            raise ParameterError(f"{name} must lie in {self.interval}, got {_plain(array)}")
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


def _plain(array: NDArray[np.float64]) -> str:
    return f"{array:g}" if array.ndim == 0 else "(" + ", ".join(f"{v:g}" for v in array) + ")"


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
        if not isinstance(value, str) or value not in self.options:
            raise UnknownNameError(name, str(value), self.options)
        return str(value)


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


def choice(doc: str, default: str, options: Mapping[str, Any]) -> Any:
    return Choice(doc, default, options)


class Parameterised:
    """Something with declared parameters and choices, given to the constructor by name and read as attributes.

    Immutable: `replaced(alpha=0.3)` gives a changed copy. `Parameterised` options of a choice are *parts*: instances
    made here, whose parameters are taken from the same keywords and appear beside the owner's.
    """

    _declared: ClassVar[dict[str, Parameter]] = {}
    _choices: ClassVar[dict[str, Choice]] = {}

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        own = vars(cls)
        cls._declared = cls._declared | {k: v for k, v in own.items() if isinstance(v, Parameter)}
        cls._choices = cls._choices | {k: v for k, v in own.items() if isinstance(v, Choice)}

    def __init__(self, /, **given: Any) -> None:
        self._chosen = {name: c.validated(name, given.pop(name, c.default)) for name, c in self._choices.items()}
        self._parts: dict[str, Parameterised] = {}
        for name, chosen in self._chosen.items():
            option = self._choices[name].options[chosen]
            if isinstance(option, type) and issubclass(option, Parameterised):
                taken = {k: given.pop(k) for k in list(given) if k in option._declared and k not in self._declared}
                self._parts[name] = option(**taken)
        for name in given:
            if name not in self._declared:
                self._refuse(name)
        self._values = {
            name: p.validated(name, given.get(name, p.default))
            for name, p in self._declared.items()
            if name in given or p.default is not None
        }
        # A leader whose followers are all given takes no part in the formula.
        for leader in {p.follows for p in self._declared.values() if p.follows}:
            followers = [name for name, p in self._declared.items() if p.follows == leader]
            if all(name in given for name in followers):
                if leader in given:
                    raise ParameterError(f"{leader} has no effect beside {' and '.join(followers)}")
                del self._values[leader]

    def _refuse(self, name: str) -> None:
        for choice_name, c in self._choices.items():
            for option_name, option in c.options.items():
                if isinstance(option, type) and issubclass(option, Parameterised) and name in option._declared:
                    raise ParameterError(
                        f"{name} has no effect with {choice_name}={self._chosen[choice_name]!r}; "
                        f"it belongs to {choice_name}={option_name!r}"
                    )
        known = [*self._choices, *self.declarations()]
        raise UnknownNameError(f"parameter of {type(self).__name__}", name, known)

    def declarations(self) -> dict[str, Parameter]:
        """Every parameter this instance can be given, its parts' included."""
        found = dict(self._declared)
        for part in self._parts.values():
            found |= part.declarations()
        return found

    @property
    def values(self) -> dict[str, Value]:
        """The values in force by name: numbers and (3,) arrays."""
        found = dict(self._values)
        for part in self._parts.values():
            found |= part.values
        return found

    @property
    def choices(self) -> dict[str, str]:
        return dict(self._chosen)

    @property
    def structure(self) -> tuple[Any, ...]:
        """What the traced formula depends on beside the numbers: class, choices, which parameters are in force."""
        parts = tuple(part.structure for part in self._parts.values())
        return (type(self), *self._chosen.items(), *self._values, *parts)

    def replaced(self, **changes: Any) -> Any:
        """A copy with other values.

        Values that a change leaves without effect go: those of a part that is chosen anew, a leader's when all its
        followers are given (`alpha` beside `alpha_x` and `alpha_y`), the followers' when their leader is given.
        """
        kept = dict(self._values)
        for name, part in self._parts.items():
            if name not in changes:
                kept |= part.values
        declared = self.declarations()
        followers: dict[str, list[str]] = {}
        for name, parameter in declared.items():
            if parameter.follows:
                followers.setdefault(parameter.follows, []).append(name)
        for leader, names in followers.items():
            if leader in changes:
                kept = {k: v for k, v in kept.items() if k not in names}
            elif all(name in changes or name in kept for name in names):
                kept.pop(leader, None)
        return type(self)(**{**self._chosen, **kept, **changes})

    def __getattr__(self, name: str) -> Any:
        if not name.startswith("_"):
            for part in self.__dict__.get("_parts", {}).values():
                if name in part.declarations():
                    return getattr(part, name)
        raise AttributeError(f"{type(self).__name__!r} has no attribute {name!r}")

    def __setattr__(self, name: str, value: Any) -> None:
        if not name.startswith("_") and (name in self._choices or name in self.declarations()):
            raise AttributeError(f"{name} cannot be assigned; make a changed copy with replaced({name}=...)")
        super().__setattr__(name, value)

    def __repr__(self) -> str:
        shown = [f"{k}={v!r}" for k, v in self._chosen.items() if len(self._choices[k].options) > 1]
        shown += [f"{k}={_plain(np.asarray(v))}" for k, v in self.values.items()]
        return f"{type(self).__name__}({', '.join(shown)})"
