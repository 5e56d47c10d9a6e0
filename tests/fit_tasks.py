"""What other processes are asked to do: they find it here by name."""

from __future__ import annotations

import os
import signal
import time
from pathlib import Path


def square(number: int) -> int:
    return number * number


def die_once(path: str) -> str:
    """Ends its process, the first time."""
    flag = Path(path)
    if flag.exists():
        return "done"
    flag.touch()
    os.kill(os.getpid(), signal.SIGKILL)
    return "never"


def die(number: int) -> str:
    os.kill(os.getpid(), signal.SIGKILL)
    return "never"


def sleep_long(path: str) -> None:
    """Writes this process's number to a file beside the others', and stays."""
    Path(path).write_text(str(os.getpid()))
    time.sleep(120)
