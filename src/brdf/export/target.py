"""Files of renderers: a module of this folder enters one by defining `TARGET`."""

from __future__ import annotations

import copy
import functools
import importlib
import pkgutil
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from ..reflectance import Reflectance

Say = Callable[[str], None]


class Written(NamedTuple):
    """What a target wrote."""

    files: tuple[Path, ...]
    stands_for: Reflectance
    """What the file describes, as this package evaluates it: how far that is from what was given is the error."""


@dataclass(frozen=True)
class Target:
    """One kind of file for a renderer."""

    name: str
    extension: str
    doc: str
    """One line."""
    write: Callable[[Reflectance, Path], Written]


@functools.cache
def targets() -> dict[str, Target]:
    """Every target by extension."""
    package = importlib.import_module(__package__)
    modules = [importlib.import_module(f"{__package__}.{m.name}") for m in pkgutil.iter_modules(package.__path__)]
    found = {module.TARGET.extension: module.TARGET for module in modules if hasattr(module, "TARGET")}
    return dict(sorted(found.items()))


def stand_in(written: Reflectance, m: Reflectance, source: str) -> Reflectance:
    """What was written of `m`, under its name; a copy, for it may be `m` itself."""
    return copy.copy(written).named(m.name, source)


def title(m: Reflectance) -> str:
    """The name for comments and strings in files of all targets: one printable line."""
    return one_line(m.name) or type(m).__name__


def one_line(text: str) -> str:
    """The text with blanks and ends of lines as single spaces, and `?` for what cannot be printed."""
    return "".join(c if c.isprintable() else "?" for c in " ".join(text.split()))


def identifier(m: Reflectance) -> str:
    """A name that files of all targets take: letters, digits and underscores, no digit first."""
    plain = re.sub(r"\W+", "_", m.name or type(m).__name__, flags=re.ASCII).strip("_") or "material"
    return plain if not plain[0].isdigit() else f"_{plain}"
