"""Many fits from the command line: progress, the table, the page, what failed."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .. import inputs
from ..errors import BrdfError, FileError
from . import output

if TYPE_CHECKING:
    from ..fit import Data

TABLE = "fits.csv"


class FailedFitsError(BrdfError):
    """Some of many fits could not be made."""


def fit_folder(
    data: Sequence[str], models: Sequence[str], options: dict[str, Any], folder: Path, jobs: int,
    scheduler: str | None, table: Path | None, json: bool,
) -> None:  # fmt: skip
    """Make the fits, then the table and the page. Raises FailedFitsError, when everything else is done."""
    from ..fit.batch import fit_many
    from ..fit.table import require_kind, write_table
    from ..loading import files_of
    from ..reproduce.fits import write_page

    for spec in (*data, *models):  # workers read them, and what was fitted before is not read again
        for file in files_of(spec):
            inputs.note(file)
    if table is not None:
        require_kind(table)
        output.require_writable(table)
    with _bar() as progress:
        batch = fit_many(
            data, models, folder, jobs=jobs, scheduler=scheduler, read=read_data, progress=progress, **options
        )
    if batch.fits:
        place = table or folder / TABLE
        write_table(batch.fits, place)
        with output.working("drawing"):
            page = write_page(batch.fits, folder)
        files = {"folder": str(folder), "table": str(place), "page": str(page)}
        if json:
            output.print_json({"fits": batch.fits, "kept": batch.kept, "failures": batch.failures, **files})
        else:
            _print(batch.fits, batch.kept)
            print(place.resolve(), page.resolve(), sep="\n")
    lines = [f"{what}: {why}" for what, why in batch.failures.items()]
    if len(lines) == 1:
        raise FailedFitsError(lines[0])
    if lines:
        for line in lines:
            output.note(line)
        raise FailedFitsError(f"{len(lines)} of {len(batch.fits) + len(lines)} fits failed, named above")


def read_data(spec: str, grazing: float) -> Data:
    """A material, or photographs of a ball: a folder with a list of lights."""
    from ..fit import Data, data_of
    from ..io.sphere_images import FOLDER_FILE
    from ..loading import is_file

    place = Path(spec)
    if is_file(spec) and place.is_dir() and not (place / FOLDER_FILE).exists():
        from ..capture import sphere_samples

        if not any(place.glob("light*.txt")):
            lacking = f"photographs of a ball need light_directions.txt or lights.txt, other folders {FOLDER_FILE}"
            raise FileError(spec, f"holds nothing to fit to: {lacking}.")
        return Data(sphere_samples(spec, grazing=grazing), None)
    return data_of(spec, grazing)


def _print(fits: list[dict[str, Any]], kept: int) -> None:
    """The mean error of each model, and in how many materials it is the nearest."""
    metrics = list(dict.fromkeys(name for one in fits for name in one["errors"]))
    models = list(dict.fromkeys(one["model"] for one in fits))
    least = {one["path"]: min(o["cost"] for o in fits if o["path"] == one["path"]) for one in fits}
    rows = []
    for model in models:
        own = [one for one in fits if one["model"] == model]
        means = [_mean([o["errors"].get(m) for o in own]) for m in metrics]
        wins = sum(one["cost"] == least[one["path"]] for one in own)
        rows.append((model, f"{len(own)}", *means, f"{wins}"))
    output.print_table(("model", "fits", *(f"mean {m}" for m in metrics), "nearest"), rows)
    if kept:
        print(f"{kept} of {len(fits)} fits were there already")


def _mean(errors: Sequence[float | None]) -> str:
    """Of those there are: photographs have no error in the image metric."""
    known = [error for error in errors if error is not None]
    return f"{sum(known) / len(known):.4g}" if known else ""


@contextlib.contextmanager
def _bar() -> Iterator[Callable[[int, int, str], None]]:
    """A progress bar on a terminal."""
    if not sys.stderr.isatty():
        yield lambda done, total, what: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (
        TextColumn("fitting"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(),
        TextColumn("{task.description}"),
    )
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("")
        yield lambda done, total, what: bar.update(task, completed=done, total=total, description=what)
