"""Many fits from the command line: progress, the table, the page, what failed."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

from ..errors import BrdfError
from . import output

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
    from ..reproduce.fits import write_page

    if table is not None:
        require_kind(table)
        output.require_writable(table)
    with _bar() as progress:
        batch = fit_many(data, models, folder, jobs=jobs, scheduler=scheduler, progress=progress, **options)
    if batch.fits:
        place = table or folder / TABLE
        write_table(batch.fits, place)
        with output.working("drawing"):
            page = write_page(batch.fits, folder, _by_name(data))
        files = {"folder": str(folder), "table": str(place), "page": str(page)}
        if json:
            output.print_json({"fits": batch.fits, "kept": batch.kept, "failures": batch.failures, **files})
        else:
            _print(batch.fits, batch.kept)
            print(place.resolve(), page.resolve(), sep="\n")
    if batch.failures:
        first = next(iter(batch.failures.items()))
        more = f" and {len(batch.failures) - 1} more" if len(batch.failures) > 1 else ""
        for what, why in list(batch.failures.items())[1:]:
            output.note(f"{what}: {why}")
        raise FailedFitsError(f"{first[0]}: {first[1]}{more}")


def _by_name(data: Sequence[str]) -> dict[str, str]:
    """What to load each material by: its name is its file's stem, or its own."""
    return {Path(spec).stem: spec for spec in data} | {spec: spec for spec in data}


def _print(fits: list[dict[str, Any]], kept: int) -> None:
    """The mean error of each model, and in how many materials it is the nearest."""
    metrics = list(dict.fromkeys(name for one in fits for name in one["errors"]))
    models = list(dict.fromkeys(one["model"] for one in fits))
    least = {one["data"]: min(o["cost"] for o in fits if o["data"] == one["data"]) for one in fits}
    rows = []
    for model in models:
        own = [one for one in fits if one["model"] == model]
        means = [sum(o["errors"].get(m, 0.0) for o in own) / len(own) for m in metrics]
        wins = sum(one["cost"] == least[one["data"]] for one in own)
        rows.append((model, f"{len(own)}", *(f"{mean:.4g}" for mean in means), f"{wins}"))
    output.print_table(("model", "fits", *(f"mean {m}" for m in metrics), "nearest"), rows)
    if kept:
        print(f"{kept} of {len(fits)} fits were there already")


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
