"""Goniometer tables in the layout of ASTM E1392, as the Cornell reflectance measurements have them.

A header of lines `KEY value`, the last of which is VARS with the names of the columns; then one line a measurement,
numbers between commas. Columns are theta_i, phi_i (or without it), theta_s, phi_s, then R,G,B, or X,Y,Z, or
wavelengths (`550nm`), or one integrated value. Angles are radians; a file with a zenith angle above 3.2 has degrees.
Source: github.com/KimuraRyo/libbsdf, AstmReader; github.com/belcour/alta, data_io/astm.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..container import replacing
from ..errors import CorruptFileError
from ..reflectance import Reflectance
from ..representations.adaptive import Adaptive
from ..representations.baking.bake import require_storable
from ..representations.scattered import Scattered
from .angles import goniometer_pairs
from .registry import Format
from .rows import measured_rgb, scattered
from .text import Rows, lines, numbers

Array = NDArray[np.float64]

ANGLES = ("theta_i", "phi_i", "theta_s", "phi_s")
MOST_COLUMNS = 2000
_WAVELENGTH = re.compile(r"(\d+\.?\d*)\s*nm")
_LONGEST_HEADER = 1000
"""Lines."""
_TOLERANCE = 1e-3
"""By how much a zenith angle may exceed a right angle, radians."""
_DEGREES = 3.2
"""From this largest zenith angle on a file has degrees: no measurement keeps all its directions so near the normal."""


def recognises(head: bytes, size: int) -> bool:
    """A line VARS that names theta_i."""
    return re.search(rb"^VARS[ \t]+theta_i", head, re.MULTILINE) is not None


def read(path: Path) -> Reflectance:
    """The file as a `Scattered`, read as isotropic. Raises CorruptFileError, which names the line."""
    wavelengths, angles, values = read_rows(path)
    made = scattered(path, wavelengths, angles, values)
    return made.named(path.stem, f"ASTM E1392 file {path.name}, {len(values)} measurements")


def read_rows(path: Path) -> tuple[Array | None, Array, Array]:
    """Wavelengths (W,) in nm or None for RGB, angles (N, 4) in radians (theta_i, phi_i, theta_s, phi_s), values (N, W)
    in 1/sr. Raises CorruptFileError, which names the line.
    """
    content = lines(path, comment="\0")
    names = _columns(path, content)
    angles = [name for name in ANGLES if name in names]
    if names[: len(angles)] != angles or {"theta_i", "theta_s", "phi_s"} - set(angles):
        raise CorruptFileError(path, "VARS must start with theta_i,phi_i,theta_s,phi_s (phi_i may be left out).")
    rows = Rows(path, len(names), f"the {len(names)} that VARS names")
    for number, line in content:
        rows.add(number, numbers(path, number, line.replace(",", " ").split()))
    table = rows.table()
    if not len(table):
        raise CorruptFileError(path, "holds no measurement; fetch the file again.")
    wavelengths, values = _channels(path, names[len(angles) :], table[:, len(angles) :])
    return wavelengths, _spherical(path, angles, table), values


def _columns(path: Path, content: Iterator[tuple[int, str]]) -> list[str]:
    """The names after VARS; the header is used up."""
    for number, line in content:
        key, _, rest = line.replace("\t", " ").partition(" ")
        if key.strip() == "VARS":
            names = [name.strip() for name in rest.split(",")]
            if len(names) > MOST_COLUMNS:
                raise CorruptFileError(path, f"VARS names {len(names)} columns; at most {MOST_COLUMNS} are read.")
            return names
        if number > _LONGEST_HEADER:
            break
    raise CorruptFileError(path, "has no line VARS that names the columns.")


def _spherical(path: Path, names: list[str], table: Array) -> Array:
    columns = {name: table[:, k] for k, name in enumerate(names)}
    angles = np.stack([columns.get(name, np.zeros(len(table))) for name in ANGLES], -1)
    largest = angles[:, ::2].max()
    if math.pi / 2 + _TOLERANCE < largest < _DEGREES:
        neither = "beyond pi/2 in radians, and in degrees too small for the largest of a measurement"
        raise CorruptFileError(path, f"has a zenith angle of {largest:.6g}, {neither}.")
    if largest >= _DEGREES:
        angles = np.radians(angles)
    zenith = angles[:, ::2]
    if zenith.min() < 0 or zenith.max() > math.pi / 2 + _TOLERANCE:
        raise CorruptFileError(path, "its zenith angles must lie in 0 to pi/2 radians, or 0 to 90 degrees.")
    return angles


def _channels(path: Path, names: list[str], values: Array) -> tuple[Array | None, Array]:
    if names == ["R", "G", "B"]:
        return None, values
    if names == ["X", "Y", "Z"]:
        return None, measured_rgb(values)
    found = [_WAVELENGTH.fullmatch(name) for name in names]
    if names and all(found):
        return np.array([float(match[1]) for match in found if match]), values
    if len(names) == 1:
        return None, np.broadcast_to(values, (len(values), 3))
    listed = ",".join(names)[:60]
    raise CorruptFileError(path, f"its values {listed!r} are neither R,G,B nor X,Y,Z nor wavelengths nor one column.")


def write(reflectance: Reflectance, path: Path) -> None:
    """Spectra, where the reflectance has them, or RGB at the pairs of `goniometer_pairs`.

    Raises ReflectanceError for what is anisotropic, transmits or mirrors, FileError.
    """
    angles, wi, wo = goniometer_pairs(reflectance)
    names, values = ["R", "G", "B"], reflectance(wi, wo)
    if isinstance(reflectance, (Adaptive, Scattered)) and reflectance.wavelengths is not None:
        names = [f"{nm:g}nm" for nm in reflectance.wavelengths]
        values = reflectance.spectrum(wi, wo)
    require_storable(reflectance, values, "ASTM text")
    with replacing(path) as temporary, temporary.open("w", encoding="ascii") as file:
        file.write(f"TYPE BRDF\nNUM_POINTS {len(angles)}\nVARS {','.join([*ANGLES, *names])}\n")
        np.savetxt(file, np.concatenate([angles, values], axis=1), fmt="%.9g", delimiter=",")


FORMAT = Format(
    "ASTM E1392 text",
    (".astm", ".txt"),
    "goniometer measurements, RGB or spectral; read as isotropic",
    recognises,
    read,
    write,
)
