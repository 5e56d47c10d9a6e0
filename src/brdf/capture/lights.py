"""Directions and intensities of the lights of a capture, from text files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import CorruptFileError, FileError

Array = NDArray[np.floating[Any]]

DIRECTIONS = ("light_directions.txt", "lights.txt")
"""Names under which directions are looked for."""
INTENSITIES = "light_intensities.txt"


def read_directions(folder: Path, given: Path | None, count: int) -> Array:
    """(count, 3) unit directions to the lights: x to the right, y up, z to the camera.

    The file has a line x y z a photograph, with or without a first line that counts them; lengths do not matter.
    Raises FileError, CorruptFileError.
    """
    path = given or next((folder / name for name in DIRECTIONS if (folder / name).is_file()), None)
    if path is None:
        names = " or ".join(DIRECTIONS)
        raise FileError(folder, f"has no {names}; write a line x y z a photograph there, or name a file with --lights.")
    rows = _rows(path)
    if rows and len(rows[0]) == 1:
        counted, rows = rows[0][0], rows[1:]
        if counted != len(rows):
            raise CorruptFileError(path, f"counts {counted:g} lights in its first line but lists {len(rows)}.")
    if any(len(row) != 3 for row in rows):
        raise CorruptFileError(path, "must have three numbers, x y z, in each line.")
    if len(rows) != count:
        raise CorruptFileError(
            path, f"has {len(rows)} lights for {count} photographs; give one a photograph, in the order of the files."
        )
    directions = np.array(rows, np.float64)
    length = np.linalg.norm(directions, axis=1)
    if not length.min() > 0:
        raise CorruptFileError(path, f"light {int(length.argmin()) + 1} has no direction (0 0 0).")
    directions /= length[:, None]
    behind = np.flatnonzero(directions[:, 2] <= 0)
    if len(behind):
        raise CorruptFileError(
            path, f"light {behind[0] + 1} is behind the ball (z = {directions[behind[0], 2]:.3g}); z must point to the "
            "camera and be above 0; leave that photograph out or turn the signs."
        )  # fmt: skip
    return directions


def read_intensities(folder: Path, given: Path | None, count: int) -> Array:
    """(count, 3) intensities of the lights: a line r g b, or one number, a photograph; 1 where there is no file.

    Raises FileError, CorruptFileError.
    """
    path = given or (folder / INTENSITIES)
    if given is None and not path.is_file():
        return np.ones((count, 3))
    rows = _rows(path)
    if len(rows) != count or len({len(row) for row in rows}) != 1 or len(rows[0]) not in (1, 3):
        raise CorruptFileError(path, f"must have a line r g b (or one number) for each of the {count} photographs.")
    values = np.broadcast_to(np.array(rows, np.float64), (count, 3))
    if not values.min() > 0:
        raise CorruptFileError(path, "light intensities must be above 0.")
    return values


def _rows(path: Path) -> list[list[float]]:
    """The numbers of each line that is neither empty nor a comment (#). Raises FileError, CorruptFileError."""
    if not path.is_file():
        raise FileError(path, "no such file; check the path.")
    rows = []
    for number, line in enumerate(path.read_text("utf-8", errors="replace").splitlines(), 1):
        content = line.partition("#")[0].replace(",", " ").split()
        if not content:
            continue
        try:
            rows.append([float(word) for word in content])
        except ValueError:
            raise CorruptFileError(path, f"line {number} is not made of numbers: {line.strip()[:40]!r}.") from None
        if not np.isfinite(rows[-1]).all():
            raise CorruptFileError(path, f"line {number} holds a number that is not finite.")
    return rows
