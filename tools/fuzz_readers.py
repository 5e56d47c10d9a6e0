"""Break a sample of every format many times, read each, and tell what came of it: crashes, time, memory.

    python tools/fuzz_readers.py [--mutations 10000] [--only NAME] [--seconds 600]

A crash is any exception but FileError. Memory is the peak that Python and NumPy allocate while a file is read, over the
size of the file; files below 64 KB count as 64 KB, for what Python needs whatever it reads. The samples are those of
tests/io/samples.py. Run it from the top folder.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
import traceback
import tracemalloc
from pathlib import Path

import numpy as np

sys.path[:0] = [str(Path(__file__).parents[1]), str(Path(__file__).parents[1] / "tests")]

from tests.io.mutations import mutated, refused  # noqa: E402  (found by the path above)
from tests.io.samples import SAMPLES  # noqa: E402

LEAST_BYTES = 65536


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mutations", type=int, default=10_000)
    parser.add_argument("--only", choices=[*SAMPLES])
    parser.add_argument("--seconds", type=float, default=600.0, help="at most, for each reader")
    options = parser.parse_args()
    print(f"{'reader':24} {'files':>6} {'refused':>8} {'crashes':>8} {'longest':>9} {'memory':>8}")
    crashed = 0
    for name in [options.only] if options.only else SAMPLES:
        crashed += fuzz(name, options.mutations, options.seconds)
    sys.exit(crashed > 0)


def fuzz(name: str, count: int, seconds: float) -> int:
    """Prints one line; returns the number of crashes."""
    extension, content = SAMPLES[name]
    data, rng = content(), np.random.default_rng(1)
    done = said = crashes = 0
    longest = most = 0.0
    begun = time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"m{extension}"
        for content_ in (data, data[: len(data) // 2], data[:-1]):  # what is imported once, for whole and broken files
            path.write_bytes(content_)
            refused(name, path)
        while done < count and time.perf_counter() - begun < seconds:
            path.write_bytes(mutated(data, rng))
            start = time.perf_counter()
            crashes, said = crashes + _crashes(name, path), said + (_last is not None)
            longest = max(longest, time.perf_counter() - start)
            if done % 10 == 0:  # tracing costs several times as much as reading
                tracemalloc.start()
                _crashes(name, path)
                most = max(most, tracemalloc.get_traced_memory()[1] / max(path.stat().st_size, LEAST_BYTES))
                tracemalloc.stop()
            done += 1
    print(f"{name:24} {done:6} {said:8} {crashes:8} {longest:8.3f}s {most:7.2f}x", flush=True)
    return crashes


_last: str | None = None


def _crashes(name: str, path: Path) -> int:
    global _last
    try:
        _last = refused(name, path)
    except Exception:
        _last = None
        traceback.print_exc(limit=-3)
        return 1
    return 0


if __name__ == "__main__":
    main()
