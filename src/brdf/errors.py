"""Everything that can be wrong with what a user gives: one class a cause, one line a message.

A message says what was given, what is allowed, and what to do. The command line prints it and exits with 2.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from os import PathLike


class BrdfError(Exception):
    """Base of every error this package raises on purpose."""


class UnknownNameError(BrdfError, LookupError):
    """A name (material, model, mesh, option value…) that does not exist; the message offers the nearest ones."""

    def __init__(self, kind: str, name: str, known: Iterable[str], hint: str = "") -> None:
        known = sorted(known)
        in_lower = {n.lower(): n for n in known}
        near = [in_lower[n] for n in difflib.get_close_matches(name.lower(), in_lower, n=3, cutoff=0.6)]
        if near:
            advice = "did you mean " + " or ".join(repr(n) for n in near) + "?"
        elif len(known) <= 20:
            advice = "known: " + ", ".join(known) + "."
        else:
            advice = f"{len(known)} are known{'; ' + hint if hint else ''}."
        super().__init__(f"unknown {kind} {name!r}: {advice}")


class ParameterError(BrdfError, ValueError):
    """A parameter out of its bounds, of the wrong shape, or of no effect here."""


class DirectionError(BrdfError, ValueError):
    """Directions of the wrong shape or length."""


class FormulaError(BrdfError, TypeError):
    """A formula does something that cannot be traced (branches on a direction, uses an unknown function)."""


class ReflectanceError(BrdfError, TypeError):
    """A reflectance lacks what was asked of it (no shader of its own, not isotropic, not spectral…)."""


class FileError(BrdfError):
    """A file that cannot be read or written: `PATH: what is wrong. What to do.`"""

    def __init__(self, path: str | PathLike[str], problem: str) -> None:
        super().__init__(f"{path}: {problem}")


class UnknownFormatError(FileError):
    """The content matches no format the package reads, or the extension none it writes."""


class CorruptFileError(FileError):
    """The format is known, the content breaks its rules (truncated, absurd header, NaN table…)."""


class SceneError(BrdfError, ValueError):
    """A scene that cannot be rendered (empty mesh, size of zero, no light…)."""


class DriverError(BrdfError, RuntimeError):
    """No graphics driver, or one that cannot do what is needed; the message says what to install."""


class MissingExtraError(BrdfError, ImportError):
    """An optional dependency is not installed; the message gives the command that installs it."""

    def __init__(self, purpose: str, extra: str) -> None:
        super().__init__(f"{purpose} needs an optional dependency: pip install 'brdf[{extra}]'")
