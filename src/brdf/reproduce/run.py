"""Find a document, run it, and put what comes out into a folder: whole, or not at all."""

from __future__ import annotations

import importlib
import os
import pkgutil
from pathlib import Path
from typing import Any

from ..container import replacing_folder
from ..errors import FileError, UnknownNameError
from . import documents
from .report import RESULTS, Report


def names() -> list[str]:
    """The documents whose results can be made again."""
    return sorted(found.name for found in pkgutil.iter_modules(documents.__path__))


def title(name: str) -> str:
    """What a document is about, in one line. Raises UnknownNameError."""
    return str(_document(name).TITLE)


def reproduce(
    name: str, out: str | os.PathLike[str] | None = None, quick: bool = False, force: bool = False, settings: Any = None
) -> Report:
    """Make the results of a document again, in a folder of figures, `results.json`, `results.md` and `index.html`.

    `name`: one of `names()`. `out`: the folder, by default NAME-results. `quick`: fewer materials and smaller pictures,
    within a minute. `force`: replace the folder of an earlier run. `settings`: the document's own, in place of its full
    or quick ones. Numbers do not depend on the run, timings do. Raises UnknownNameError; FileError when the folder
    exists or cannot be written.
    """
    document = _document(name)
    folder = Path(out if out is not None else f"{name}-results")
    chosen = settings if settings is not None else document.SETTINGS["quick" if quick else "full"]
    _require_free(folder, force)
    with replacing_folder(folder) as temporary:
        report = Report(name, document.TITLE, document.SOURCE, chosen)
        document.run(report, chosen)
        report.write(temporary)
    report.folder = folder
    return report


def _document(name: str) -> Any:
    if name not in names():
        raise UnknownNameError("document", name, names())
    return importlib.import_module(f"{documents.__name__}.{name}")


def _require_free(folder: Path, force: bool) -> None:
    """Raises FileError where something stands: it is replaced on request, and only where an earlier run wrote it."""
    if not os.path.lexists(folder):
        return
    if not force:
        raise FileError(folder, "exists; choose another folder with -o, or replace it with --force.")
    if not (folder / RESULTS).is_file():
        raise FileError(folder, f"was not written by this command (it has no {RESULTS}); choose another folder.")
