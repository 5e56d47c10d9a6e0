"""How this folder's loops are compiled and spread over the processor's cores.

Kernels are numba functions with explicit signatures, compiled once and cached on disk. They release the interpreter
lock, work on an index range [start, stop) of whole arrays, and so share one thread pool with embree.
"""

from __future__ import annotations

import itertools
import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from typing import Any, TypeVar, cast

import numba

Function = TypeVar("Function", bound=Callable[..., Any])

GRAIN = 16384
"""Items below which a second thread costs more than it brings."""


def kernel(signature: str | None = None) -> Callable[[Function], Function]:
    """Compile for one signature (numba's notation); without one, a helper compiled into its callers."""
    njit: Any = numba.njit
    options = {"nogil": True, "cache": True, "error_model": "numpy"}
    return cast(Callable[[Function], Function], njit(*([signature] if signature else []), **options))


def cores() -> int:
    """Cores this process may use."""
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity else os.cpu_count() or 1


@cache
def _pool() -> ThreadPoolExecutor:
    return ThreadPoolExecutor(cores(), thread_name_prefix="brdf-render")


def in_parallel(function: Callable[..., Any], count: int, *arguments: Any) -> None:
    """Call `function(start, stop, *arguments)` for ranges that together cover [0, count)."""
    parts = max(1, min(4 * cores(), count // GRAIN))
    if parts == 1:
        function(0, count, *arguments)
        return
    bounds = [count * part // parts for part in range(parts + 1)]
    waiting = [_pool().submit(function, start, stop, *arguments) for start, stop in itertools.pairwise(bounds)]
    for part in waiting:
        part.result()
