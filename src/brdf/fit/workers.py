"""Where many fits run: in this process, in several, or on a Dask cluster."""

from __future__ import annotations

import importlib
import multiprocessing
import os
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from typing import Any, TypeVar

from ..errors import MissingExtraError, ParameterError

Task = TypeVar("Task")
Outcome = TypeVar("Outcome")

DIED = "its process died, twice; is there enough memory? Fewer --jobs need less."

RETRIES = 2
"""On a cluster, where a worker may go away."""

CONNECTING = 20
"""Seconds to wait for a scheduler."""


def outcomes(
    make: Callable[[Task], Outcome], tasks: Sequence[Task], jobs: int, scheduler: str | None, threads: int
) -> Iterator[tuple[Task, Outcome | str]]:
    """`make` of every task, in the order in which they are done; what a task failed with as one line.

    `threads`: of each of `jobs` processes. Raises ParameterError for a scheduler that cannot be reached,
    MissingExtraError.
    """
    if scheduler is not None:
        yield from _on_cluster(make, tasks, scheduler)
    elif jobs == 1 or len(tasks) < 2:
        for task in tasks:
            yield task, make(task)
    else:
        yield from _in_processes(make, tasks, jobs, threads)


def _in_processes(
    make: Callable[[Task], Outcome], tasks: Sequence[Task], jobs: int, threads: int
) -> Iterator[tuple[Task, Outcome | str]]:
    """When a process dies, those beside it stop, too: what was under way is begun again, each by itself."""
    waiting, suspects = list(tasks), list[Task]()
    while waiting or suspects:
        alone = bool(suspects)
        queue = [suspects.pop(0)] if alone else waiting
        context = multiprocessing.get_context("spawn")
        with ProcessPoolExecutor(min(jobs, len(queue)), context, initializer=_begin, initargs=(threads,)) as pool:
            running: dict[Future[Outcome], Task] = {}
            try:
                while queue or running:
                    # no more than run at once: what dies with a process is little, and data are read in turn
                    while queue and len(running) < jobs:
                        future = pool.submit(make, queue[0])
                        running[future] = queue.pop(0)
                    for future in wait(running, return_when=FIRST_COMPLETED).done:
                        outcome = future.result()
                        yield running.pop(future), outcome
            except BrokenProcessPool:
                if alone:
                    yield next(iter(running.values())), DIED
                else:
                    suspects += running.values()


def _begin(threads: int) -> None:
    os.environ["BRDF_THREADS"] = str(threads)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """A process that is killed cannot end those it began, which would wait for more work for ever."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def _on_cluster(
    make: Callable[[Task], Outcome], tasks: Sequence[Task], address: str
) -> Iterator[tuple[Task, Outcome | str]]:
    try:
        distributed: Any = importlib.import_module("distributed")
    except ImportError:
        raise MissingExtraError("fitting on a cluster", "cluster") from None
    with _client(distributed, address) as client:
        futures = {client.submit(make, task, pure=False, retries=RETRIES): task for task in tasks}
        for future in distributed.as_completed(futures, loop=client.loop):
            wrong = future.exception()
            yield futures[future], future.result() if wrong is None else f"{type(wrong).__name__}: {wrong}"


def _client(distributed: Any, address: str) -> Any:
    # In two steps: who only calls the class has nothing to close when that fails, and left to the interpreter's end
    # a half-made client waits 40 seconds for its own thread and complains.
    client: Any = distributed.Client.__new__(distributed.Client)
    try:
        client.__init__(address, timeout=CONNECTING, set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        client.close()
        raise ParameterError(
            f"no Dask scheduler answers at {address} ({error}); start one with `dask scheduler`"
        ) from None
    return client
