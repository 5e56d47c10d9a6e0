"""From what a person writes to a reflectance: a material's name, a file, or a model with its parameters."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

from . import io, materials, models, profiles
from .combinators import add, scaled
from .errors import FileError, ParameterError, UnknownNameError
from .profiles import Profile
from .reflectance import Reflectance

NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_SCALED = re.compile(rf"\s*({NUMBER}(?:/{NUMBER}/{NUMBER})?)\s*\*\s*(.*)", re.DOTALL)
_PLUS = re.compile(r"(?<![\d.][eE])(?<![=/])\+")
"""A plus between lobes, not the one in 1e+3 or in eta=+1.5."""


def load(spec: str | os.PathLike[str]) -> Reflectance:
    """A reflectance from its description.

    `spec` is one of
      - the name of a shipped material, `gold-metallic-paint`, or one published fit of it, `NAME@FIT`;
      - a path to a file of any format of `brdf.io.formats()`, recognised by its content, or, of a file that holds
        several materials, `PATH@NAME`;
      - a model with parameters, `GGX:alpha=0.2,F0=1/.78/.34` (colours with slashes, choices by name);
      - a sum of those with `+`, each with a factor if wanted: `Lambertian:albedo=.3 + 0.5*GGX:alpha=.1`.
    A name wins over a file that is called the same; write `./NAME` for the file. Raises UnknownNameError, FileError,
    UnknownFormatError, CorruptFileError, ParameterError.
    """
    if isinstance(spec, os.PathLike):
        return io.read(spec)
    if os.path.isfile(spec) and not _is_name(spec):
        return io.read(spec)
    first, *others = [_term(term, spec) for term in _PLUS.split(spec)]
    for lobe in others:
        first = add(first, lobe)
    return first.named(spec.strip()) if others else first


def is_file(spec: str) -> bool:
    """Whether `load` takes the description for a file or a folder: names win."""
    return os.path.exists(spec) and not _is_name(spec.strip())


class Term(NamedTuple):
    """One term of a description, in the three pieces of its text."""

    before: str
    """A factor."""
    file: str
    """The file or folder that is read; empty where there is none."""
    after: str
    """`@NAME`, which of its materials; the whole term where there is no file."""


def terms(spec: str) -> list[Term]:
    """The terms that `load` takes a description for, between pluses."""
    return [Term("", spec, "")] if is_file(spec) else [_pieces(term) for term in _PLUS.split(spec)]


def _pieces(term: str) -> Term:
    match = _SCALED.fullmatch(term)
    text = (match[2] if match else term).lstrip()
    candidates = (text.rstrip(), text.rpartition("@")[0])
    file = next((candidate for candidate in candidates if is_file(candidate)), "")
    return Term(term[: len(term) - len(text)], file, text[len(file) :])


def with_files(spec: str, change: Callable[[str], str]) -> str:
    """The description with other words for its files."""
    return "+".join(f"{t.before}{change(t.file) if t.file else ''}{t.after}" for t in terms(spec))


def files_of(spec: str | os.PathLike[str]) -> list[Path]:
    """The files that `load` reads for a description: of a sum all, with those beside one that are read with it; of
    pictures that a file names their folder.
    """
    found = [Path(spec)] if isinstance(spec, os.PathLike) else [Path(t.file) for t in terms(spec) if t.file]
    return [file for path in found for file in io.files_with(path)]


def names_profile(spec: str) -> bool:
    """Whether the description is one of a profile of subsurface scattering."""
    return spec.partition(":")[0].strip().lower() in profiles.names()


def load_profile(spec: str) -> Profile:
    """A profile of subsurface scattering, `burley:A=.8,length=2` or `dipole`.

    Raises UnknownNameError, ParameterError.
    """
    name, _, parameters = spec.partition(":")
    made: Profile = profiles.get(name.strip())(**_parameters(name.strip(), parameters))
    made.name = spec.strip()
    return made


def _model_names() -> list[str]:
    return [*models.names(), *models.WRAPPERS]


def _is_name(spec: str) -> bool:
    return spec in materials.names() or spec in _model_names()


def _term(term: str, spec: str) -> Reflectance:
    """One lobe: `[FACTOR*]ATOM`."""
    if not term.strip():
        raise ParameterError(f"{spec!r} has an empty term; write lobes as GGX:alpha=0.2 + Lambertian:albedo=0.5")
    match = _SCALED.fullmatch(term)
    if match is None:
        return _atom(term.strip())
    factor = _value(match[1])
    return scaled(_atom(match[2].strip()), factor).named(term.strip())


def _atom(text: str) -> Reflectance:
    """A name, a path, or `MODEL:parameters`."""
    model_names = {name.lower() for name in _model_names()}
    head, _, parameters = text.partition(":")
    if head.strip().lower() in model_names:
        return _model(head.strip(), parameters)
    name, at, fit = text.partition("@")
    if name in materials.names():
        return materials.get(name, fit) if at else materials.get(name)
    if os.path.exists(text):
        return io.read(text)
    file, at_member, member = text.rpartition("@")
    if at_member and os.path.isfile(file):
        return io.read(file, member)
    if head.strip() in materials.names() and parameters:
        raise ParameterError(f"{head.strip()} is a published fit and takes no parameters; models do, as GGX:alpha=0.2")
    if at and name.strip().lower() in model_names:
        raise ParameterError(f"{text!r}: a model has no published fits; give its parameters, as in GGX:alpha=0.2")
    if "*" in text:
        raise ParameterError(f"{text!r}: a factor is a number or three with slashes, as in 0.5*GGX or 1/.8/.3*GGX")
    if names_profile(text):
        raise ParameterError(f"{text!r} is a profile of subsurface scattering, no reflectance; `brdf show` draws it")
    if "=" in parameters:
        raise UnknownNameError("model", head.strip(), [*_model_names(), *profiles.names()])
    if Path(text).suffix or os.sep in text or "/" in text:
        raise FileError(text, "no such file; check the path.")
    raise UnknownNameError("material", name, [*materials.names(), *_model_names()], "see `brdf list materials`")


def _model(name: str, parameters: str) -> Reflectance:
    given = _parameters(name, parameters)
    try:
        made = models.make(name, **given)
    except ParameterError as error:
        raise ParameterError(f"{name}: {error}") from None
    return made.named(f"{type(made).__name__}:{parameters.strip()}") if given else made


def _parameters(name: str, parameters: str) -> dict[str, Any]:
    given: dict[str, Any] = {}
    for item in parameters.split(",") if parameters.strip() else []:
        key, equals, value = (part.strip() for part in item.partition("="))
        if not equals or not key or not value:
            raise ParameterError(
                f"{name}: {item.strip()!r} is not PARAMETER=VALUE, as in {name}:alpha=0.2,F0=1/.78/.34"
            )
        if key in given:
            raise ParameterError(f"{name}: {key} is given twice")
        given[key] = _value(value)
    return given


def _value(text: str) -> Any:
    """A number, numbers between slashes, or, when it is neither, the text itself (the name of a choice)."""
    try:
        numbers = tuple(float(part) for part in text.split("/"))
    except ValueError:
        return text
    return numbers[0] if len(numbers) == 1 else numbers
