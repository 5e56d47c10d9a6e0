"""Matrices of daylighting: the XML that WINDOW writes and Radiance reads, with patches after Klems.

Read is the reflection from the front, or else from the back, in the visible band, or the X, Y and Z of CIE where all
are there, equal ones as grey; transmission is left out. Rows of a matrix are outgoing patches, columns incident ones,
unless the file says `IncidentDataStructure` Rows. Values are in 1/sr. Tensor trees are not read. References: Klems1994.
Source: github.com/LBNL-ETA/Radiance, common/bsdf_m.c.
"""

from __future__ import annotations

import math
import re
import warnings
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..color import rgb_to_xyz, xyz_to_rgb
from ..errors import CorruptFileError
from ..reflectance import Reflectance
from ..representations.patches import Patches
from .registry import Format

Array = NDArray[np.float64]

BASES: dict[str, tuple[tuple[float, ...], tuple[int, ...]]] = {
    "LBNL/Klems Full": ((0, 5, 15, 25, 35, 45, 55, 65, 75, 90), (1, 8, 16, 20, 24, 24, 24, 16, 12)),
    "LBNL/Klems Half": ((0, 6.5, 19.5, 32.5, 45.5, 58.5, 71.5, 90), (1, 8, 12, 16, 20, 12, 8)),
    "LBNL/Klems Quarter": ((0, 9, 27, 45, 63, 90), (1, 8, 12, 12, 8)),
}
"""Polar angles between the bands, degrees, and patches in each band, of the bases that files need not define."""

MOST_PATCHES = 2500
_SIDES = ("reflection front", "reflection back")
_NAMESPACE = re.compile(r"\{[^}]*\}")


def recognises(head: bytes, size: int) -> bool:
    """By the root element."""
    return re.search(rb"<WindowElement\b", head) is not None


def read(path: Path) -> Reflectance:
    """The file as `Patches`. Raises CorruptFileError."""
    root = _parsed(path)
    by_columns = _text(root.find(".//DataDefinition/IncidentDataStructure")).lower() != "rows"
    bases = {name.lower(): basis for name, basis in BASES.items()} | _own_bases(path, root)
    blocks: dict[tuple[str, str], ET.Element] = {}
    for data in root.iter("WavelengthData"):
        band = _band(data)
        for block in data.findall("WavelengthDataBlock"):
            blocks.setdefault((_text(block.find("WavelengthDataDirection")).lower(), band), block)
    side = next((side for side in _SIDES if any(direction == side for direction, _ in blocks)), None)
    if side is None:
        found = ", ".join(sorted({direction for direction, _ in blocks})) or "no data block"
        raise CorruptFileError(path, f"holds {found}, no reflection of a matrix of patches; tensor trees are not read.")
    bands = {band: block for (direction, band), block in blocks.items() if direction == side}
    chosen = [bands[name] for name in ("x", "visible", "z")] if {"x", "visible", "z"} <= bands.keys() else []
    single = bands.get("visible") or next(iter(bands.values()))
    limits, counts = _basis(path, bases, single)
    matrices = [_matrix(path, block, sum(counts), by_columns) for block in chosen or [single]]
    if any(_basis(path, bases, block) != (limits, counts) for block in chosen):
        raise CorruptFileError(path, "its X, Y and Z have different patches.")
    stacked = np.stack(matrices, -1)
    rgb = _rgb(stacked) if chosen else np.repeat(stacked, 3, -1)
    try:
        made = Patches(rgb, np.radians(limits), counts)
    except ValueError as error:
        raise CorruptFileError(path, f"{error}.") from None
    return made.named(path.stem, f"WINDOW file {path.name}, {side}")


def _rgb(xyz: Array) -> Array:
    """RGB of X, Y and Z under light of equal energy, as WINDOW exports and Radiance takes them: equal ones are grey."""
    return np.asarray(xyz_to_rgb(xyz * rgb_to_xyz(np.ones(3))))


def _parsed(path: Path) -> ET.Element:
    data = path.read_bytes()
    if b"<!DOCTYPE" in data or b"<!ENTITY" in data:
        raise CorruptFileError(path, "declares entities, which no measurement needs.")
    try:
        root = ET.fromstring(data)
    except (ET.ParseError, ValueError, LookupError) as error:
        raise CorruptFileError(path, f"is not whole XML ({error}).") from None
    for element in root.iter():
        if isinstance(element.tag, str):
            element.tag = _NAMESPACE.sub("", element.tag)
    return root


def _text(element: ET.Element | None) -> str:
    return (element.text or "").strip() if element is not None else ""


def _band(data: ET.Element) -> str:
    """ "visible" (or Y), "x", "z", or another name."""
    name = _text(data.find("Wavelength")).lower()
    if name in ("cie-x", "cie-y", "cie-z"):
        return {"cie-x": "x", "cie-y": "visible", "cie-z": "z"}[name]
    return name


def _own_bases(path: Path, root: ET.Element) -> dict[str, tuple[tuple[float, ...], tuple[int, ...]]]:
    found = {}
    for element in root.iter("AngleBasis"):
        blocks = element.findall("AngleBasisBlock")
        try:
            counts = tuple(int(_text(block.find("nPhis"))) for block in blocks)
            limits = (0.0, *(float(_text(block.find("ThetaBounds/UpperTheta"))) for block in blocks))
        except ValueError:
            raise CorruptFileError(path, "has an angle basis with something else than numbers.") from None
        if not counts or min(counts) < 1 or sum(counts) > MOST_PATCHES or not all(map(math.isfinite, limits)):
            raise CorruptFileError(path, f"has an angle basis that is not of 1 to {MOST_PATCHES} patches.")
        found[_text(element.find("AngleBasisName")).lower()] = (limits, counts)
    return found


def _basis(
    path: Path, bases: dict[str, tuple[tuple[float, ...], tuple[int, ...]]], block: ET.Element
) -> tuple[tuple[float, ...], tuple[int, ...]]:
    names = [_text(block.find(name)).lower() for name in ("ColumnAngleBasis", "RowAngleBasis")]
    if names[0] != names[1] or names[0] not in bases:
        raise CorruptFileError(path, f"its angle bases {names[0]!r} and {names[1]!r} must be one that is known.")
    return bases[names[0]]


def _matrix(path: Path, block: ET.Element, count: int, by_columns: bool) -> Array:
    """(incident, outgoing) values in 1/sr; negative ones count as zero."""
    text = _text(block.find("ScatteringData")).replace(",", " ")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            values = np.fromstring(text, np.float64, sep=" ")
        except (DeprecationWarning, ValueError):
            raise CorruptFileError(path, "its data holds something else than numbers.") from None
    if values.size != count * count:
        raise CorruptFileError(path, f"expected {count} x {count} values, found {values.size}; fetch it again.")
    if not np.isfinite(values).all():
        raise CorruptFileError(path, "its data holds NaN or infinity.")
    matrix = np.maximum(values.reshape(count, count), 0)
    return matrix.T if by_columns else matrix


FORMAT = Format(
    "WINDOW XML",
    (".xml",),
    "reflection between patches of the hemisphere after Klems, as in daylighting; one band or XYZ",
    recognises,
    read,
)
