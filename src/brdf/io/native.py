"""What libraries in C say on their own account."""

from __future__ import annotations

import contextlib
import io
import os
from collections.abc import Iterator


@contextlib.contextmanager
def messages_hidden() -> Iterator[None]:
    """Keeps what a library says for itself off the terminal and out of pipes: OpenEXR writes a line to standard error
    about each broken block, and prints a warning."""
    with contextlib.redirect_stdout(io.StringIO()), contextlib.ExitStack() as undo:
        with contextlib.suppress(OSError):  # where there is no standard error
            kept, nowhere = os.dup(2), os.open(os.devnull, os.O_WRONLY)
            undo.callback(os.close, nowhere)
            undo.callback(os.close, kept)
            undo.callback(os.dup2, kept, 2)
            os.dup2(nowhere, 2)
        yield
