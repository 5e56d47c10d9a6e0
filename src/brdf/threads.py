"""One pool of threads for everything that releases the interpreter lock: kernels, NumPy on large blocks, embree."""

from __future__ import annotations

import functools
import os
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any, TypeVar

Argument = TypeVar("Argument")
Result = TypeVar("Result")

_here = threading.local()


def cores() -> int:
    """Threads in use: `BRDF_THREADS`, else the cores this process may run on."""
    given = os.environ.get("BRDF_THREADS", "")
    if given.isdigit():
        return max(1, int(given))
    affinity: Any = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity else os.cpu_count() or 1


def map_threads(function: Callable[[Argument], Result], arguments: Sequence[Argument]) -> list[Result]:
    """`function` of each argument, in order of the arguments, on all cores."""
    if len(arguments) < 2 or cores() == 1 or getattr(_here, "is_worker", False):
        return [function(argument) for argument in arguments]
    return list(_pool().map(function, arguments))


def in_ranges(function: Callable[[int, int], Any], count: int, size: int) -> None:
    """Call `function(start, stop)` for ranges of `size` that together cover [0, count)."""
    map_threads(lambda start: function(start, min(start + size, count)), range(0, count, size))


@functools.cache
def _pool() -> ThreadPoolExecutor:
    return ThreadPoolExecutor(cores(), thread_name_prefix="brdf", initializer=_mark_worker)


if hasattr(os, "register_at_fork"):
    # A forked process has the pool without its threads: waiting for those would wait forever.
    os.register_at_fork(after_in_child=_pool.cache_clear)


def _mark_worker() -> None:
    """Work that is handed on from a worker runs there: waiting for the pool from within it could wait forever."""
    _here.is_worker = True
