"""The command line: `brdf VERB …`. Each verb is a thin skin over one public function.

Starting it imports the argument parser and nothing of the package's mathematics; a verb imports what it uses.
Exit codes: 0 done, 1 a law does not hold (`check`), 2 a mistake of the caller, 3 a mistake of ours, 130 interrupted.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Sequence

USER_MISTAKE, OWN_MISTAKE, INTERRUPTED = 2, 3, 130


def main() -> None:
    """Entry point of the `brdf` command."""
    if hasattr(signal, "SIGPIPE"):
        # End silently when the reader of our output leaves (as `head` does), like any other tool.
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    sys.exit(run(sys.argv[1:]))


def run(arguments: Sequence[str]) -> int:
    """Carry out one command line; returns the exit code. A mistake is one line on standard error, never a traceback."""
    from ..errors import BrdfError
    from ..inputs import kept

    try:
        with kept():
            return _dispatch(arguments)
    except BrdfError as error:
        return _fail(str(error), USER_MISTAKE)
    except KeyboardInterrupt:
        return INTERRUPTED
    except Exception as error:
        if os.environ.get("BRDF_DEBUG"):
            raise
        what = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
        return _fail(f"unexpected {what}; please report it with the traceback that BRDF_DEBUG=1 shows", OWN_MISTAKE)


def _dispatch(arguments: Sequence[str]) -> int:
    import typer

    from .app import app

    try:
        result = app(list(arguments) or ["--help"], prog_name="brdf", standalone_mode=False)
    except typer.TyperException as error:
        context = getattr(error, "ctx", None)
        command = context.command_path if context is not None else "brdf"
        message = error.format_message().strip().rstrip(".")
        return _fail(f"{message[:1].lower()}{message[1:]} (see `{command} --help`)", USER_MISTAKE)
    except typer.Abort:
        return INTERRUPTED
    sys.stdout.flush()
    return result if isinstance(result, int) else 0


def _fail(message: str, code: int) -> int:
    print("brdf: " + " ".join(message.split()), file=sys.stderr)
    return code
