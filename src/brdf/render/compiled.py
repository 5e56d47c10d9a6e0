"""How this folder's loops are compiled and spread over the processor's cores.

Kernels are numba functions with explicit signatures, compiled once and cached on disk. They release the interpreter
lock, work on an index range [start, stop) of whole arrays, and so share one thread pool with embree.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba

from ..threads import cores, in_ranges

Function = TypeVar("Function", bound=Callable[..., Any])

GRAIN = 16384
"""Items below which a second thread costs more than it brings."""


def kernel(signature: str | None = None) -> Callable[[Function], Function]:
    """Compile for one signature (numba's notation); without one, a helper compiled into its callers."""
    njit: Any = numba.njit
    options = {"nogil": True, "cache": True, "error_model": "numpy"}
    return cast(Callable[[Function], Function], njit(*([signature] if signature else []), **options))


def in_parallel(function: Callable[..., Any], count: int, *arguments: Any) -> None:
    """Call `function(start, stop, *arguments)` for ranges that together cover [0, count)."""
    in_ranges(lambda start, stop: function(start, stop, *arguments), count, max(GRAIN, -(-count // (4 * cores()))))
