"""Many fits: one process or several, or a Dask cluster; finished fits are kept, an interrupted run goes on.

Every fit is two files in the folder, the material and its numbers, written when it is done: whoever is stopped, only
what was under way is lost.
"""

from __future__ import annotations

import functools
import hashlib
import json
import os
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import __version__, container
from ..errors import BrdfError, CorruptFileError, FileError, ParameterError
from ..reflectance import Reflectance
from ..threads import cores
from .data import Data, data_of
from .fitting import fit
from .samples import GRAZING
from .workers import outcomes


@dataclass(frozen=True)
class Task:
    """One fit to make."""

    data: str
    """As `brdf.load` takes it."""
    model: str
    options: tuple[tuple[str, Any], ...]
    content: str
    """A digest of the data's file: a changed file is fitted again."""
    key: str = ""
    """The stem of its files."""

    def identity(self) -> dict[str, Any]:
        """What a finished fit must agree in to be kept."""
        options = {name: list(v) if isinstance(v, (list, tuple)) else v for name, v in self.options}
        return {
            "data": self.data,
            "model": self.model,
            "options": options,
            "content": self.content,
            "brdf": __version__,
        }


@dataclass(frozen=True, eq=False)
class Done:
    """One finished fit, as it travels between processes."""

    numbers: dict[str, Any]
    header: dict[str, Any]
    arrays: dict[str, NDArray[Any]]


@dataclass(frozen=True, eq=False)
class Batch:
    """What `fit_many` made."""

    folder: Path
    fits: list[dict[str, Any]]
    """`FitResult.numbers()` of every fit, with `file`, in the order of data and models."""
    kept: int
    """How many of them an earlier run had made."""
    failures: dict[str, str]
    """What went wrong, by data and model."""


def fit_many(
    data: Sequence[str],
    models: Sequence[str],
    folder: str | os.PathLike[str],
    *,
    jobs: int = 1,
    scheduler: str | None = None,
    progress: Callable[[int, int, str], None] = lambda done, total, what: None,
    **options: Any,
) -> Batch:
    """Every model fitted to all data, in a folder: KEY.safetensors and KEY.json a fit.

    `jobs` processes share the cores; with `scheduler`, the address of a Dask scheduler, its workers fit (they must see
    the files of `data`). Fits that the folder holds already, of the same data and options, are kept. `options` are
    those of `fit`, and `grazing`. `progress` is told how many fits of how many are done, and which was last.

    Fits that fail are in `failures`; the others go on. Raises FileError for a folder that cannot be written or holds
    something else, ParameterError, MissingExtraError.
    """
    if jobs < 1:
        raise ParameterError(f"jobs must be at least 1, got {jobs}")
    folder = Path(folder)
    tasks = _tasks(data, models, options)
    _prepare(folder)
    finished = {task.key: found for task in tasks if (found := _finished(folder, task)) is not None}
    kept, failures = len(finished), dict[str, str]()
    progress(len(finished), len(tasks), "")
    waiting = [task for task in tasks if task.key not in finished]
    for task, outcome in _run(waiting, jobs, scheduler):
        if isinstance(outcome, Done):
            finished[task.key] = _keep(folder, task, outcome)
        else:
            failures[f"{task.data}, {task.model}"] = outcome
        progress(len(finished) + len(failures), len(tasks), task.key)
    return Batch(folder, [finished[t.key] for t in tasks if t.key in finished], kept, failures)


def _run(tasks: list[Task], jobs: int, scheduler: str | None) -> Iterator[tuple[Task, Done | str]]:
    yield from outcomes(make, tasks, jobs, scheduler, max(1, cores() // jobs))


def make(task: Task) -> Done | str:
    """Carry out one task; what is wrong with it as one line."""
    try:
        options = dict(task.options)
        result = fit(_data(task.data, options.pop("grazing", GRAZING), task.content), task.model, **options)
    except BrdfError as error:
        return " ".join(str(error).split())
    return Done(result.numbers(), *result.reflectance.state())


@functools.lru_cache(maxsize=1)
def _data(spec: str, grazing: float, content: str) -> Data:
    """Read once for all models that are fitted to it one after the other."""
    return data_of(spec, grazing)


def _tasks(data: Sequence[str], models: Sequence[str], options: Mapping[str, Any]) -> list[Task]:
    given = tuple(sorted((name, tuple(v) if isinstance(v, list) else v) for name, v in options.items()))
    found: dict[str, Task] = {}
    for spec in data:
        content = _digest(spec)
        for model in models:
            key = f"{_slug(Path(spec).stem if os.path.isfile(spec) else spec)}--{_slug(model)}"
            if key in found and (found[key].data, found[key].model) != (spec, model):
                key += "-" + hashlib.sha256(f"{spec}\n{model}".encode()).hexdigest()[:8]
            found[key] = Task(spec, model, given, content, key)
    return list(found.values())


def _slug(text: str) -> str:
    return re.sub(r"[^A-Za-z0-9._@-]+", "-", text).strip("-.")[:80] or "data"


def _digest(spec: str) -> str:
    if not os.path.isfile(spec):
        return ""
    try:
        with open(spec, "rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError as error:
        raise FileError(spec, f"cannot be read ({error.strerror or error}).") from None


def _prepare(folder: Path) -> None:
    if folder.exists() and not folder.is_dir():
        raise FileError(folder, "is a file; give a folder for the fits with -o.")
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileError(folder, f"cannot be made ({error.strerror or error}).") from None
    with container.replacing(folder / "probe.json") as probe:
        probe.touch()
    (folder / "probe.json").unlink()


def _finished(folder: Path, task: Task) -> dict[str, Any] | None:
    """The numbers of a fit that is there already and is of this task."""
    try:
        known = json.loads((folder / f"{task.key}.json").read_text("utf-8"))
        if known["task"] != json.loads(json.dumps(task.identity())):
            return None
        Reflectance.restore(folder / f"{task.key}.safetensors")
        return dict(known["fit"])
    except (OSError, ValueError, KeyError, TypeError, CorruptFileError, FileError):
        return None


def _keep(folder: Path, task: Task, done: Done) -> dict[str, Any]:
    """Write a fit: its numbers last, which say that it is whole."""
    material = folder / f"{task.key}.safetensors"
    container.save(material, done.header, done.arrays)
    numbers: dict[str, Any] = _without_infinities(done.numbers) | {"file": material.name}
    with container.replacing(folder / f"{task.key}.json") as temporary:
        text = json.dumps({"task": task.identity(), "fit": numbers}, indent=1, ensure_ascii=False, allow_nan=False)
        temporary.write_text(text + "\n", "utf-8")
    return numbers


def _without_infinities(data: Any) -> Any:
    """JSON has none: null stands for what is not determined."""
    if isinstance(data, dict):
        return {name: _without_infinities(value) for name, value in data.items()}
    if isinstance(data, list):
        return [_without_infinities(value) for value in data]
    return None if isinstance(data, float) and not np.isfinite(data) else data
