"""How this folder's loops are compiled and spread over the processor's cores.

Kernels are numba functions with explicit signatures, compiled on first use and cached on disk. They release the
interpreter lock, work on an index range [start, stop) of whole arrays, and so share one thread pool with embree.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from ..threads import cores, in_ranges

GRAIN = 16384
"""Items below which a second thread costs more than it brings."""


class Kernel:
    """A function that is compiled, for one signature, when it is first called: most pictures need but some of them."""

    def __init__(self, function: Callable[..., Any], signature: str) -> None:
        self._function, self._signature = function, signature
        self._lock = threading.Lock()
        self._compiled: Callable[..., Any] | None = None

    def __call__(self, *arguments: Any) -> Any:
        if self._compiled is None:
            with self._lock:
                self._compiled = self._compiled or _njit(self._signature)(self._function)
        return self._compiled(*arguments)


def kernel(signature: str) -> Callable[[Callable[..., Any]], Kernel]:
    """Compile for one signature (numba's notation) on first use."""
    return lambda function: Kernel(function, signature)


def helper(function: Callable[..., Any]) -> Callable[..., Any]:
    """A function for kernels to call; it is compiled into them."""
    compiled: Callable[..., Any] = _njit()(function)
    return compiled


def _njit(*signature: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    import numba

    from ..formula.machine_code import kept_on_disk

    njit: Any = numba.njit
    decorator: Callable[[Callable[..., Any]], Callable[..., Any]] = njit(
        *signature, nogil=True, cache=kept_on_disk(), error_model="numpy"
    )
    return decorator


def in_parallel(function: Callable[..., Any], count: int, *arguments: Any) -> None:
    """Call `function(start, stop, *arguments)` for ranges that together cover [0, count)."""
    in_ranges(lambda start, stop: function(start, stop, *arguments), count, max(GRAIN, -(-count // (4 * cores()))))
