"""The shared pool: order, coverage, and work handed on from within."""

from __future__ import annotations

import os
import subprocess
import sys
import threading

import numpy as np
import pytest

from brdf import threads


@pytest.fixture(autouse=True)
def two_threads(monkeypatch):
    monkeypatch.setenv("BRDF_THREADS", "2")
    threads._pool.cache_clear()
    yield
    threads._pool.cache_clear()


def test_results_keep_the_order_of_the_arguments():
    assert threads.map_threads(lambda x: x * x, range(50)) == [x * x for x in range(50)]


def test_ranges_cover_everything_once():
    seen = np.zeros(1003, int)

    def count(start, stop):
        seen[start:stop] += 1

    threads.in_ranges(count, len(seen), 100)
    assert (seen == 1).all()


def test_two_threads_work_at_once():
    together = threading.Barrier(2, timeout=10)
    threads.map_threads(lambda _: together.wait(), range(2))


def test_work_handed_on_from_a_worker_does_not_wait_for_itself():
    inner = threads.map_threads(lambda x: sum(threads.map_threads(lambda y: x * y, range(4))), range(8))
    assert inner == [6 * x for x in range(8)]


def test_errors_come_through():
    with pytest.raises(ZeroDivisionError):
        threads.map_threads(lambda x: 1 // x, [1, 0, 2])


FORKING = """
import os, threading
from brdf import threads
threads.map_threads(abs, range(4))
child = os.fork()
if child == 0:
    done = threading.Event()
    threading.Thread(target=lambda: (threads.map_threads(abs, range(4)), done.set()), daemon=True).start()
    os._exit(0 if done.wait(10) else 1)
raise SystemExit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system cannot fork")
def test_a_forked_process_makes_its_own_threads():
    """In a process of its own: other libraries' threads have no say in it."""
    assert subprocess.run([sys.executable, "-c", FORKING], check=False).returncode == 0
