"""A progress bar that keeps out of sight while there is nothing to wait for."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from types import TracebackType
from typing import Any, Self

PATIENCE = 1.0
"""Seconds before the bar appears."""

Report = Callable[[float], None]


class Progress:
    """Counts `total` equal steps. `report`: a function of the share done, True or None for a bar, False for nothing.

    None shows the bar only where standard error is a terminal. The bar appears once a second has passed.
    """

    def __init__(self, title: str, total: int, report: Report | bool | None) -> None:
        self._title, self._total, self._done = title, total, 0
        self._report = report if callable(report) else None
        self._wanted = report is True or (report is None and sys.stderr.isatty())
        self._bar: Any = None
        self._start = time.monotonic()

    def step(self) -> None:
        """One more step is done."""
        self._done += 1
        if self._report is not None:
            self._report(self._done / self._total)
        elif self._bar is not None:
            self._bar.advance(0)
        elif self._wanted and self._done < self._total and time.monotonic() - self._start > PATIENCE:
            from rich.console import Console
            from rich.progress import Progress as Bar

            self._bar = Bar(console=Console(stderr=True), transient=True)
            self._bar.add_task(self._title, total=self._total, completed=self._done)
            self._bar.start()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._bar is not None:
            self._bar.stop()
