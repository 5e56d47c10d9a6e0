"""Three (or more) components that a formula treats as one: a direction, a colour, the channels of a texture.

A `Vec` holds one value a component (structure of arrays): Python numbers, arrays of any library, or traced
expressions. Arithmetic is component by component; a scalar meets every component.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterator
from typing import Any

Scalar = Any
"""One component: a number, an array of any supported library, or a traced expression."""


class Vec:
    """Components `x`, `y`, `z` (or red, green, blue); further ones by index."""

    __slots__ = ("components",)
    __array_ufunc__ = None  # NumPy arrays hand the operation over to us instead of looping over the components

    def __init__(self, *components: Scalar) -> None:
        self.components = components

    @property
    def x(self) -> Scalar:
        return self.components[0]

    @property
    def y(self) -> Scalar:
        return self.components[1]

    @property
    def z(self) -> Scalar:
        return self.components[2]

    def __iter__(self) -> Iterator[Scalar]:
        return iter(self.components)

    def __len__(self) -> int:
        return len(self.components)

    def __getitem__(self, index: int) -> Scalar:
        return self.components[index]

    def __repr__(self) -> str:
        return f"Vec{self.components!r}"

    def __add__(self, other: Any) -> Vec:
        return _each(operator.add, self, other)

    def __radd__(self, other: Any) -> Vec:
        return _each(operator.add, other, self)

    def __sub__(self, other: Any) -> Vec:
        return _each(operator.sub, self, other)

    def __rsub__(self, other: Any) -> Vec:
        return _each(operator.sub, other, self)

    def __mul__(self, other: Any) -> Vec:
        return _each(operator.mul, self, other)

    def __rmul__(self, other: Any) -> Vec:
        return _each(operator.mul, other, self)

    def __truediv__(self, other: Any) -> Vec:
        return _each(operator.truediv, self, other)

    def __rtruediv__(self, other: Any) -> Vec:
        return _each(operator.truediv, other, self)

    def __pow__(self, other: Any) -> Vec:
        return _each(operator.pow, self, other)

    def __neg__(self) -> Vec:
        return Vec(*(-c for c in self.components))

    def __lt__(self, other: Any) -> Vec:
        return _each(operator.lt, self, other)

    def __le__(self, other: Any) -> Vec:
        return _each(operator.le, self, other)

    def __gt__(self, other: Any) -> Vec:
        return _each(operator.gt, self, other)

    def __ge__(self, other: Any) -> Vec:
        return _each(operator.ge, self, other)


def elementwise(function: Callable[..., Scalar], *arguments: Any) -> Any:
    """`function` of the arguments; once per component where any of them is a `Vec`.

    Raises ValueError when two vectors differ in length.
    """
    return _each(function, *arguments) if any(isinstance(a, Vec) for a in arguments) else function(*arguments)


def _each(function: Callable[..., Scalar], *arguments: Any) -> Vec:
    lengths = {len(a) for a in arguments if isinstance(a, Vec)}
    if len(lengths) > 1:
        raise ValueError(f"vectors of {sorted(lengths)} components do not combine")
    columns = [a.components if isinstance(a, Vec) else (a,) * max(lengths) for a in arguments]
    return Vec(*(function(*row) for row in zip(*columns, strict=True)))
