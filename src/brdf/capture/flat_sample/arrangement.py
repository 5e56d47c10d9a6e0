"""Which photograph was taken under which lamp: from a text file of angles or an .lp file of directions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path, PureWindowsPath
from typing import NamedTuple

import numpy as np

from ...errors import CorruptFileError, FileError
from ...geometry.directions import normalized, to_spherical
from ..photographs import pictures_in
from .arc import choose_arc

ANGLES = ("angles.txt", "elevations.txt")
"""Names under which a file of angles is looked for."""
SAME = 0.25
"""Degrees within which two photographs have the same lamp: exposures of a bracket."""


class Shot(NamedTuple):
    """One photograph."""

    path: Path
    seconds: float | None
    """its exposure, where the file of angles gives it"""


@dataclass(frozen=True)
class Lamp:
    """A place of the lamp, and the photographs taken there."""

    elevation: float
    """angle from the normal [degrees]"""
    shots: tuple[Shot, ...]


def read_arrangement(folder: Path, given: Path | None, others: Sequence[Path]) -> tuple[list[Lamp], list[str]]:
    """The lamps on one arc, from the highest to the lowest, and what there is to say about them.

    `given`: the file of angles or the .lp file, else the one found in `folder`; `others`: pictures that are no
    photographs of the sample. Raises FileError, CorruptFileError.
    """
    path = given or _found(folder)
    if path.suffix.lower() == ".lp":
        lamps, facts = _of_directions(path, folder)
    else:
        lamps, facts = _of_angles(path, folder, others), []
    if len(lamps) < 2:
        count = sum(len(lamp.shots) for lamp in lamps)
        raise FileError(path, f"has one lamp alone ({count} photograph(s) of it); at least 2 angles are needed.")
    return lamps, facts


def _found(folder: Path) -> Path:
    if not folder.is_dir():
        raise FileError(folder, "no such folder; give the folder of the photographs.")
    lists = [folder / name for name in ANGLES if (folder / name).is_file()] + sorted(folder.glob("*.lp"))
    if not lists:
        raise FileError(
            folder, f"has no {ANGLES[0]} and no .lp file; write the lamp's angle from the normal [degrees], a line a "
            "photograph, or name a file with --angles."
        )  # fmt: skip
    if len(lists) > 1:
        names = ", ".join(path.name for path in lists[:3])
        raise FileError(folder, f"has several lists of lamps ({names}); say which with --angles.")
    return lists[0]


def _lines(path: Path) -> list[tuple[int, str]]:
    """Numbered lines that are neither empty nor a comment (#). Raises FileError."""
    if not path.is_file():
        raise FileError(path, "no such file; check the path.")
    text = path.read_text("utf-8", errors="replace").splitlines()
    return [(n, c) for n, line in enumerate(text, 1) if (c := line.partition("#")[0].strip())]


def _number(path: Path, line: int, word: str) -> float:
    try:
        value = float(word)
    except ValueError:
        value = float("nan")
    if not np.isfinite(value):
        raise CorruptFileError(path, f"line {line}: {word[:40]!r} is not a number.")
    return value


# ---- angles --------------------------------------------------------------------------------------------------------


def _of_angles(path: Path, folder: Path, others: Sequence[Path]) -> list[Lamp]:
    """Lines `[FILE] ANGLE [SECONDS]`; without file names they go with the pictures of the folder in order."""
    rows = [(line, content.replace(",", " ").split()) for line, content in _lines(path)]
    named = [_is_name(words[0]) for _, words in rows]
    if any(named) and not all(named):
        line = rows[named.index(False)][0]
        raise CorruptFileError(path, f"line {line} names no file, though others do; name one in every line or in none.")
    if rows and named[0]:
        files = [_existing(path, line, folder / words[0]) for line, words in rows]
        rows = [(line, words[1:]) for line, words in rows]
    else:
        files = pictures_in(folder, others)[0]
        if len(files) != len(rows):
            raise CorruptFileError(
                path, f"has {len(rows)} angles for the {len(files)} photographs in {folder}; give one a photograph, "
                "in the order of the files, or write the file's name first in each line."
            )  # fmt: skip
    shots: list[tuple[float, Shot]] = []
    for (line, words), file in zip(rows, files, strict=True):
        if len(words) not in (1, 2):
            raise CorruptFileError(path, f"line {line} must be [FILE] ANGLE [SECONDS], got {len(words)} numbers.")
        angle, *rest = (_number(path, line, word) for word in words)
        if not 0 <= angle < 90:
            raise CorruptFileError(path, f"line {line}: the angle from the normal must lie in [0, 90), got {angle:g}.")
        if rest and not rest[0] > 0:
            raise CorruptFileError(path, f"line {line}: the exposure must be above 0 seconds, got {rest[0]:g}.")
        shots.append((angle, Shot(file, rest[0] if rest else None)))
    shots.sort(key=lambda shot: shot[0])
    groups: list[list[tuple[float, Shot]]] = []
    for shot in shots:
        if groups and shot[0] - groups[-1][0][0] <= SAME:
            groups[-1].append(shot)
        else:
            groups.append([shot])
    return [Lamp(group[0][0], tuple(shot for _, shot in group)) for group in groups]


def _is_name(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return True
    return False


def _existing(path: Path, line: int, file: Path) -> Path:
    if not file.is_file():
        raise FileError(path, f"line {line} names {file.name}, which is not there; correct the list.")
    return file


# ---- directions ----------------------------------------------------------------------------------------------------


def _of_directions(path: Path, folder: Path) -> tuple[list[Lamp], list[str]]:
    """The format of RTI: a count, then lines `FILE x y z`; z points to the camera."""
    lines = _lines(path)
    if not lines:
        raise CorruptFileError(path, "is empty; it must hold a count and lines FILE x y z.")
    count = _number(path, lines[0][0], lines[0][1])
    if count != len(lines) - 1:
        raise CorruptFileError(path, f"promises {count:g} lamps in its first line but lists {len(lines) - 1}.")
    files, vectors = [], []
    for line, content in lines[1:]:
        *name, x, y, z = content.rsplit(maxsplit=3)
        if len(name) != 1:
            raise CorruptFileError(path, f"line {line} must be FILE x y z.")
        files.append(_beside(path, line, folder, name[0].strip('"')))
        vectors.append([_number(path, line, word) for word in (x, y, z)])
    w = normalized(np.array(vectors, np.float64).reshape(-1, 3))
    nowhere = np.flatnonzero(~w.any(1))
    if len(nowhere):
        raise CorruptFileError(path, f"line {lines[1 + nowhere[0]][0]} has no direction (0 0 0).")
    first: list[int] = []  # of the photographs under each lamp
    members: list[list[int]] = []
    for i in range(len(w)):
        near = [k for k, j in enumerate(first) if np.degrees(np.linalg.norm(w[i] - w[j])) <= SAME]
        if near:
            members[near[0]].append(i)
        else:
            first.append(i)
            members.append([i])
    arc = choose_arc(w[first])
    elevation = np.degrees(to_spherical(w[first])[0])
    lamps = [Lamp(float(elevation[k]), tuple(Shot(files[i], None) for i in members[k])) for k in arc.chosen]
    said = f"arc at azimuth {arc.azimuth:.0f}°, lamps at most {arc.deviation:.1f}° from its plane"
    if len(arc.chosen) < len(first):
        said += f"; {len(arc.chosen)} of {len(first)} lamps lie on it"
    return lamps, [said]


def _beside(path: Path, line: int, folder: Path, name: str) -> Path:
    """The picture that an .lp file names, which may hold the path it had on another machine."""
    parts = PureWindowsPath(name).parts
    for candidate in (path.parent.joinpath(*parts), folder.joinpath(*parts), folder / parts[-1]):
        if not PureWindowsPath(name).is_absolute() and candidate.is_file():
            return candidate
    if (folder / parts[-1]).is_file():
        return folder / parts[-1]
    raise FileError(path, f"line {line} names {parts[-1]}, which is not there; correct the list.")
