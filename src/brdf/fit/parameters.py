"""The numbers of a reflectance that a fit may change, and the coordinates in which it searches for them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..combinators.sums import Scaled, Sum
from ..errors import ReflectanceError
from ..formula.derivative import derivative
from ..formula.graph import reachable
from ..formula.trace import component_names, trace
from ..models import EnergyCompensated, Model
from ..parameters import Parameter
from ..reflectance import Reflectance

Array = NDArray[np.float64]

WIDE = 20.0
"""A non-negative parameter whose upper bound exceeds its lower one, or its default, by more is searched by its
logarithm."""
FLOOR = 1e-4
"""What stands for a lower bound of 0 on a logarithmic scale, in parts of the default."""
REACH = 30.0
"""Factor about the default within which an unbounded scale starts."""


_linear: dict[tuple[Any, ...], frozenset[str]] = {}
"""By structure."""


@dataclass(frozen=True)
class Component:
    """One number: a parameter, or one channel of a colour."""

    name: str
    parameter: str
    """Full name of the parameter it is of."""
    channel: int
    low: float
    high: float
    default: float
    is_colour: bool
    is_linear: bool
    """Whether f is linear in it and all others of which this holds, taken together: those can be solved for."""
    is_log: bool
    """Whether its coordinate is its logarithm, else the number itself."""

    def to_coordinate(self, value: float) -> float:
        return math.log(max(value, self.lowest)) if self.is_log else value

    def to_value(self, coordinate: float) -> float:
        return min(max(math.exp(coordinate), self.low), self.high) if self.is_log else coordinate

    @property
    def lowest(self) -> float:
        """The least value that its coordinate reaches."""
        return max(self.low, FLOOR * self._typical) if self.is_log else self.low

    @property
    def bounds(self) -> tuple[float, float]:
        """Of the coordinate."""
        if not self.is_log:
            return self.low, self.high
        return math.log(self.lowest), math.log(self.high) if math.isfinite(self.high) else math.inf

    @property
    def start_range(self) -> tuple[float, float]:
        """Of the coordinate, where a search may begin: within the bounds and not absurdly far from the default."""
        low, high = self.bounds
        middle = self.to_coordinate(self.default)
        spread = math.log(REACH) if self.is_log else max(1.0, abs(self.default))
        if self.is_log and math.isfinite(self.high):  # narrow lobes are far from the default
            low, high = low if self.low > 0 else max(low, middle - spread), high
        else:
            low, high = max(low, middle - spread), min(high, middle + spread)
        margin = 0.02 * (high - low)  # a search that begins at a bound may never leave it
        return low + margin, high - margin

    @property
    def _typical(self) -> float:
        return abs(self.default) or 1.0


def components(m: Reflectance) -> list[Component]:
    """All numbers of a reflectance, in the order in which its kernels take them.

    Raises ReflectanceError for a reflectance without declared parameters.
    """
    if m.structure not in _linear:
        _linear[m.structure] = _linear_colours(m)
    declared = _declared(m)
    found = []
    for name, value in m.values.items():
        if name not in declared:
            raise ReflectanceError(f"{m.name or type(m).__name__} has numbers without bounds ({name}); fit a model")
        numbers = np.atleast_1d(np.asarray(value, np.float64))
        is_linear = name in _linear[m.structure]
        for channel, component in enumerate(component_names(name, len(numbers))):
            number = float(numbers[channel])
            found.append(_component(component, name, channel, declared[name], number, len(numbers), is_linear))
    return found


def _component(
    name: str, full: str, channel: int, declared: Parameter, value: float, size: int, is_linear: bool
) -> Component:
    low, high = declared.low, declared.high
    reference = low if low > 0 else max(abs(value), 1.0 if high <= 1 else 0.0) or 1.0
    is_log = not is_linear and low >= 0 and high / reference > WIDE
    return Component(name, full, channel, low, high, value, size == 3, is_linear, is_log)


def _linear_colours(m: Reflectance) -> frozenset[str]:
    """The colours that f is linear in, all of them together."""
    program = trace(m)
    inputs = {name: [program.graph.symbol(c) for c in component_names(name, n)] for name, n in program.parameters}
    linear: list[str] = []
    for name, symbols in inputs.items():
        if len(symbols) != 3:
            continue
        tried = [symbol for known in [*linear, name] for symbol in inputs[known]]
        slopes = [d for symbol in tried for d in derivative(program.outputs, symbol)]
        if not set(reachable(slopes)) & set(tried):
            linear.append(name)
    return frozenset(linear)


def _declared(m: Reflectance) -> dict[str, Parameter]:
    """The declarations of all parameters in force, by full name."""
    found: dict[str, Parameter] = dict(m.declarations()) if isinstance(m, (Model, Scaled)) else {}
    for key, child in m.children.items():
        found |= {f"{key}_{name}": parameter for name, parameter in _declared(child).items()}
    return found


def with_values(m: Reflectance, values: Mapping[str, Any]) -> Reflectance:
    """The same reflectance with other values, all of them by full name. Raises ReflectanceError."""

    def of(child: str) -> dict[str, Any]:
        return {name.removeprefix(f"{child}_"): v for name, v in values.items() if name.startswith(f"{child}_")}

    match m:
        case Model():
            made: Reflectance = m.replaced(**values)
        case Scaled():
            made = Scaled(with_values(m.children["base"], of("base")), values["scale"])
        case Sum():
            made = Sum([with_values(child, of(key)) for key, child in m.children.items()])
        case EnergyCompensated():
            base = with_values(m.children["base"], of("base"))
            made = EnergyCompensated(base)  # type: ignore[arg-type]
        case _:
            raise ReflectanceError(f"{m.name or type(m).__name__} is no model; fit a model, or a sum of scaled ones")
    return made


def grouped(numbers: Array, all_components: list[Component]) -> dict[str, Any]:
    """Numbers in order of the components -> values by parameter, within their bounds."""
    found: dict[str, list[float]] = {}
    for number, component in zip(numbers, all_components, strict=True):
        found.setdefault(component.parameter, []).append(min(max(float(number), component.low), component.high))
    return {name: value[0] if len(value) == 1 else tuple(value) for name, value in found.items()}


def with_defaults(m: Reflectance) -> Reflectance:
    """The same reflectance with the values that its parameters have where nothing is given."""
    declared = _declared(m)
    values = {n: v if declared[n].default is None else declared[n].default for n, v in m.values.items()}
    return with_values(m, values)
