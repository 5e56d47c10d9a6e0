"""One file or material into another format or representation, and what that costs."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import NamedTuple

from . import io, metrics
from .errors import ParameterError, UnknownNameError
from .loading import load
from .reflectance import Reflectance
from .representations.slice_stack import SliceStack
from .representations.table import Table

DEFAULT_BUDGET = "16K"

REPRESENTATIONS: dict[str, Callable[[Reflectance, str], Table]] = {
    "slices": lambda m, budget: SliceStack.bake(m, budget=budget),
    "table": lambda m, budget: Table.bake(m),
}
"""What a reflectance can be baked to, by the name the command line uses; each takes it and a budget."""


class Conversion(NamedTuple):
    """What `convert` did."""

    source: Reflectance
    written: Reflectance
    """as read back from the file"""
    comparison: metrics.Comparison
    """how far `written` is from `source`"""
    file_bytes: int
    """size of the file"""


def bake(m: Reflectance, to: str = "slices", budget: str | None = None) -> Table:
    """`m` as "slices" or "table"; a budget ("16K", "64K", "256K") is for slices alone.

    Raises UnknownNameError, ParameterError, or ReflectanceError when the representation cannot hold `m`.
    """
    if to not in REPRESENTATIONS:
        raise UnknownNameError("representation", to, REPRESENTATIONS)
    if budget is not None and to != "slices":
        raise ParameterError(f"a budget has no effect with {to!r}; it belongs to 'slices'")
    baked = REPRESENTATIONS[to](m, budget or DEFAULT_BUDGET)
    return baked.named(m.name, f"{to} of {m.source or m.name}")


def convert(
    source: str | os.PathLike[str] | Reflectance,
    target: str | os.PathLike[str],
    to: str | None = None,
    budget: str | None = None,
) -> Conversion:
    """Write `source` (whatever `brdf.load` takes) to the file `target`, in the format of its extension.

    With `to` it is first baked (see `bake`). The file is read back and compared with the source. Raises as `load`,
    `bake` and `io.write`.
    """
    m = source if isinstance(source, Reflectance) else load(source)
    if to is None and budget is not None:
        to = "slices"
    io.write(m if to is None else bake(m, to, budget), target)
    written = io.read(target)
    return Conversion(m, written, metrics.compare(m, written), os.path.getsize(target))
