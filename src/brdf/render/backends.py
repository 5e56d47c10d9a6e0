"""Which renderer draws: the processor's, or the graphics card's where there is one."""

from __future__ import annotations

import warnings
from collections.abc import Callable

from ..errors import DriverError, UnknownNameError
from .progress import Report
from .task import Floats, Task

Draw = Callable[[Task, Report | bool | None], tuple[Floats, Floats]]
"""Draws the radiance reflected to each pixel (H W, 3) and the shape's coverage (H W,)."""


def chosen(backend: str, on_processor: Draw, on_card: Draw) -> Draw:
    """The one for a backend; without a driver that for "gl" warns and the processor draws. Raises UnknownNameError."""

    def with_fallback(task: Task, progress: Report | bool | None) -> tuple[Floats, Floats]:
        try:
            return on_card(task, progress)
        except DriverError as error:
            warnings.warn(f"{error}; the CPU draws instead", RuntimeWarning, stacklevel=4)
            return on_processor(task, progress)

    backends: dict[str, Draw] = {"cpu": on_processor, "gl": with_fallback}
    if backend not in backends:
        raise UnknownNameError("backend", backend, backends)
    return backends[backend]
