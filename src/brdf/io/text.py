"""Reading text files of numbers: by line, with errors that name it, and no more memory than the numbers need."""

from __future__ import annotations

import math
from array import array
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import CorruptFileError

LONGEST_LINE = 1 << 20
"""Characters; what is longer is no line of a measurement."""


def lines(path: Path, comment: str = "#") -> Iterator[tuple[int, str]]:
    """Line number and content of the lines that hold more than a comment. Raises CorruptFileError."""
    with path.open(encoding="ascii", errors="replace") as file:
        number = 0
        while line := file.readline(LONGEST_LINE):
            number += 1
            if len(line) == LONGEST_LINE:
                raise CorruptFileError(path, f"line {number} is longer than any of this format.")
            content = line.partition(comment)[0].strip()
            if content:
                yield number, content


def numbers(path: Path, line: int, tokens: list[str]) -> list[float]:
    """The numbers of a line. Raises CorruptFileError for anything else, NaN and infinity."""
    try:
        values = [float(token) for token in tokens]
    except ValueError:
        raise CorruptFileError(path, f"line {line} must hold numbers, got {' '.join(tokens)[:40]!r}.") from None
    if not all(map(math.isfinite, values)):
        raise CorruptFileError(path, f"line {line} holds NaN or infinity.")
    return values


class Rows:
    """Rows of equally many numbers, packed as they come."""

    def __init__(self, path: Path, columns: int, what: str) -> None:
        """`what` a row must hold, for the message: "4 angles and 31 values"."""
        self.path, self.columns, self.what = path, columns, what
        self._numbers = array("d")

    def add(self, line: int, row: list[float]) -> None:
        """Raises CorruptFileError, which names the line, for a row of another length."""
        if len(row) != self.columns:
            wrong = f"line {line} holds {len(row)} numbers, not {self.what}; fetch the file again."
            raise CorruptFileError(self.path, wrong)
        self._numbers.extend(row)

    def table(self) -> NDArray[np.float64]:
        """(rows, columns)."""
        return np.frombuffer(self._numbers, np.float64).reshape(-1, self.columns) if self._numbers else self._empty

    @property
    def _empty(self) -> NDArray[np.float64]:
        return np.zeros((0, self.columns))
