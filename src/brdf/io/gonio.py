"""Text tables of a goniometer, as the Cornell set of paints has them.

Comments run from "#" to the end of the line. First the number of wavelengths, then the wavelengths (nm), then
one line a measurement: theta_i phi_i theta_o phi_o in radians and the BRDF [1/sr] at each wavelength.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import CorruptFileError
from ..reflectance import Reflectance
from .registry import Format
from .rows import scattered
from .text import Rows, lines, numbers

MOST_WAVELENGTHS = 2000
"""More than any instrument gives; a larger number is a broken file."""

_TOLERANCE = 1e-3
"""By how much a zenith angle may exceed a right angle, radians (rounding in the file)."""


def recognises(head: bytes, size: int) -> bool:
    """The first line beside comments holds one whole number alone."""
    if b"\0" in head:
        return False
    contents = (line.partition(b"#")[0].split() for line in head.splitlines())
    first = next((tokens for tokens in contents if tokens), [])
    return len(first) == 1 and first[0].isdigit()


def read(path: Path) -> Reflectance:
    """The file as a `Scattered`. Raises CorruptFileError, which names the line."""
    wavelengths, angles, values = read_rows(path)
    made = scattered(path, wavelengths, angles, values)
    return made.named(path.stem, f"goniometer file {path.name}, {len(values)} measurements")


def read_rows(path: Path) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Wavelengths (W,) in nm, angles (N, 4) in radians (theta_i, phi_i, theta_o, phi_o), values (N, W) in 1/sr.

    Raises CorruptFileError, which names the line.
    """
    content = ((number, numbers(path, number, line.split())) for number, line in lines(path))
    number, first = next(content, (1, []))
    if len(first) != 1 or not (first[0].is_integer() and 1 <= first[0] <= MOST_WAVELENGTHS):
        wanted = f"the number of wavelengths, 1 to {MOST_WAVELENGTHS}"
        raise CorruptFileError(path, f"line {number} must hold {wanted}.")
    count = int(first[0])
    wavelengths: list[float] = []
    while len(wavelengths) < count:
        number, more = next(content, (number, []))
        wavelengths += more
        if not more or len(wavelengths) > count:
            found = f"{len(wavelengths)} of {count} wavelengths are there"
            raise CorruptFileError(path, f"line {number}: {found}; fetch the file again.")
    rows = Rows(path, 4 + count, f"4 angles and {count} values")
    last = number
    for number, row in content:
        rows.add(number, row)
        if not all(0 <= theta <= math.pi / 2 + _TOLERANCE for theta in (row[0], row[2])):
            raise CorruptFileError(path, f"line {number}: zenith angles must lie in 0 to pi/2 radians.")
    table = rows.table()
    if not len(table):
        raise CorruptFileError(path, f"holds no measurement after line {last}; fetch the file again.")
    return np.array(wavelengths), table[:, :4], table[:, 4:]


FORMAT = Format(
    "goniometer text",
    (".brdf",),
    "table of measured spectra at pairs of directions, as in the Cornell set; read as isotropic",
    recognises,
    read,
)
