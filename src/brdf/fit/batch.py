"""Many fits: one process or several, or a Dask cluster; finished fits are kept, an interrupted run goes on.

Every fit is two files in the folder, the material and its numbers, written when it is done: whoever is stopped, only
what was under way is lost.
"""

from __future__ import annotations

import contextlib
import functools
import hashlib
import json
import os
import re
import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import __version__, container
from ..errors import BrdfError, CorruptFileError, FileError, ParameterError, UnknownNameError
from ..loading import files_of, terms, with_files
from ..reflectance import Reflectance
from ..threads import cores
from .data import Data, data_of
from .fitting import fit
from .options import Options
from .parameters import components
from .samples import GRAZING
from .template import template_of
from .workers import outcomes

Read = Callable[[str, float], Data]
"""From what names data, and the grazing angle, to the data."""

_FIT = re.compile(r".+--.+-[0-9a-f]{8}\.safetensors")
"""A material of a fit: what is written first into a folder of fits."""


@dataclass(frozen=True)
class Task:
    """One fit to make."""

    data: str
    """As it was given."""
    path: str
    """The same wherever one stands: with the absolute paths of files and folders."""
    name: str
    """What its files are called after."""
    model: str
    options: tuple[tuple[str, Any], ...]
    content: str
    """A digest of the data's files and folders: what has changed is fitted again."""
    model_content: str
    """The same of the model's."""

    @property
    def key(self) -> str:
        """The stem of its files: of this path and model alone, whatever else is fitted."""
        digest = hashlib.sha256(f"{self.path}\n{self.model}".encode()).hexdigest()[:8]
        return f"{_slug(self.name)}--{_slug(self.model)}-{digest}"

    def identity(self) -> dict[str, Any]:
        """What a finished fit must agree in to be kept."""
        options = {name: list(v) if isinstance(v, (list, tuple)) else v for name, v in self.options}
        return {
            "data": self.path,
            "model": self.model,
            "options": options,
            "content": _of_all([self.content, self.model_content]),
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
    """`FitResult.numbers()` of every fit, with `path`, of its data, and `file`, in the order of data and models."""
    kept: int
    """How many of them an earlier run had made."""
    failures: dict[str, str]
    """What went wrong, by data and model, in their order."""


def fit_many(
    data: Sequence[str],
    models: Sequence[str],
    folder: str | os.PathLike[str],
    *,
    jobs: int = 1,
    scheduler: str | None = None,
    read: Read = data_of,
    progress: Callable[[int, int, str], None] = lambda done, total, what: None,
    **options: Any,
) -> Batch:
    """Every model fitted to all data, in a folder: KEY.safetensors and KEY.json a fit.

    `jobs` processes share the cores; with `scheduler`, the address of a Dask scheduler, its workers fit (they must see
    the files of `data`). Fits that the folder holds already, of the same data and options, are kept. `options` are
    those of `fit`. `read` makes data of each of `data`, in every process: a function that is found by its name.
    `progress` is told how many fits of how many are done, and which was last.

    Fits that fail are in `failures`; the others go on. Raises FileError for a folder that cannot be written or holds
    other files and no fit, ParameterError, UnknownNameError, MissingExtraError.
    """
    if jobs < 1:
        raise ParameterError(f"jobs must be at least 1, got {jobs}")
    checked = Options(**options)
    _require(models, checked)
    folder = Path(folder)
    tasks = _tasks(data, models, {name: getattr(checked, name) for name in options})
    is_new = _prepare(folder)
    finished = {task.key: found for task in tasks if (found := _finished(folder, task)) is not None}
    kept, failures = len(finished), dict[str, str]()
    progress(len(finished), len(tasks), "")
    waiting = [task for task in tasks if task.key not in finished]
    try:
        for task, outcome in outcomes(
            functools.partial(make, read=read), waiting, jobs, scheduler, max(1, cores() // jobs)
        ):
            if isinstance(outcome, Done):
                finished[task.key] = _keep(folder, task, outcome)
            else:
                failures[task.key] = outcome
            progress(len(finished) + len(failures), len(tasks), task.key)
    finally:
        if is_new and not finished:
            with contextlib.suppress(OSError):  # something may have been written
                folder.rmdir()
    return Batch(
        folder,
        [finished[task.key] for task in tasks if task.key in finished],
        kept,
        {f"{task.data}, {task.model}": failures[task.key] for task in tasks if task.key in failures},
    )


def _require(models: Sequence[str], options: Options) -> None:
    """What is wrong whatever the data are is said once, before anything is read or made."""
    if not models:
        raise ParameterError("no model is named; name one or more, as GGX,Ward; `brdf list models` has them all")
    lobes = 1 if isinstance(options.lobes, str) else options.lobes
    for model in models:
        # those of anisotropic data have more parameters
        either = [template_of(model, lobes, options.diffuse, given) for given in (True, False)]
        known = {c.parameter for template in either for c in components(template)} if options.fixed else {}
        for name in options.fixed:
            if name not in known:
                raise UnknownNameError(f"parameter of {model}", name, known)


def make(task: Task, read: Read = data_of) -> Done | str:
    """Carry out one task; what is wrong with it as one line."""
    try:
        options = dict(task.options)
        data = _data(task.data, options.pop("grazing", GRAZING), task.content, read)
        result = fit(data, task.model, **options)
    except BrdfError as error:
        return " ".join(str(error).split())
    except Exception as error:  # a mistake of ours costs this fit, not those that wait behind it
        what = " ".join(f"{type(error).__name__}: {error}".split())
        return f"unexpected {what}; please report it with the traceback of this fit alone, with BRDF_DEBUG=1"
    return Done(result.numbers(), *result.reflectance.state())


@functools.lru_cache(maxsize=1)
def _data(spec: str, grazing: float, content: str, read: Read) -> Data:
    """Read once for all models that are fitted to it one after the other."""
    return read(spec, grazing)


def _tasks(data: Sequence[str], models: Sequence[str], options: Mapping[str, Any]) -> list[Task]:
    given = tuple(sorted((name, tuple(v) if isinstance(v, list) else v) for name, v in options.items()))
    contents = {model: _digest(model) for model in models}
    found: dict[str, Task] = {}
    for spec in data:
        path, content = _absolute(spec), _digest(spec)
        for model in models:
            task = Task(spec, path, _name(spec, path), model, given, content, contents[model])
            found.setdefault(task.key, task)
    return list(found.values())


def _absolute(spec: str) -> str:
    """With absolute paths, except where a plus in the name of a folder would be taken for one of a sum."""
    path = with_files(spec, os.path.abspath)
    return path if len(terms(path)) == len(terms(spec)) else spec


def _name(spec: str, path: str) -> str:
    """Of one file its stem, of a sum the text, without folders."""
    first, *others = terms(spec)
    if not others and not first.before:
        return Path(path).stem if os.path.isabs(path) else path
    return with_files(spec, os.path.basename)


def _slug(text: str) -> str:
    return re.sub(r"[^A-Za-z0-9._@-]+", "-", text).strip("-.")[:80] or "data"


def _digest(spec: str) -> str:
    """Of all files that are read for a description; empty where there are none."""
    return _of_all([_digest_of(place) for place in files_of(spec)])


def _of_all(digests: Sequence[str]) -> str:
    """One for several, and one alone as it is; empty ones are of what has no content."""
    found = [digest for digest in digests if digest]
    return hashlib.sha256("\n".join(found).encode()).hexdigest() if len(found) > 1 else "".join(found)


def _digest_of(place: Path) -> str:
    """Of a file's content; of a folder the names and the contents of its files; none of a pipe, read only once."""
    try:
        if place.is_file():
            return _content(place)
        if not place.is_dir():
            return ""
        files = sorted(path for path in place.iterdir() if path.is_file())
        return hashlib.sha256("\n".join(f"{_content(path)} {path.name}" for path in files).encode()).hexdigest()
    except OSError as error:
        raise FileError(place, f"cannot be read ({error.strerror or error}).") from None


def _content(path: Path) -> str:
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _prepare(folder: Path) -> bool:
    """Make the folder, or see that it can be written and is one of fits: a page and a table in it are replaced.

    Whether it was made.
    """
    if folder.exists() and not folder.is_dir():
        raise FileError(folder, "is a file; give a folder for the fits with -o.")
    is_new = not folder.exists()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
        names = [path.name for path in folder.iterdir() if not path.name.startswith(".")]
    except OSError as error:
        problem = f"cannot be written ({error.strerror or error}); choose another place with -o."
        raise FileError(folder, problem) from None
    if names and not any(map(_FIT.fullmatch, names)):
        raise FileError(folder, f"holds other files ({min(names)}) and no fit; give a new or an empty folder with -o.")
    return is_new


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
    numbers: dict[str, Any] = _without_infinities(done.numbers) | {"path": task.path, "file": material.name}
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
