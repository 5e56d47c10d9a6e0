"""UTIA's `.bin` files: anisotropic BRDFs at every 15 degrees of elevation and 7.5 degrees of azimuth [Filip2014].

Three planes (red, green, blue) of 288 x 288 float64, little endian, without a header. The row of a plane is the
incident direction, theta_i / 15 times 48 plus phi_i / 7.5; the column is the viewer, likewise. The values are read as
they are, linear and in 1/sr; negative ones, which some files have, count as not measured. (Other programs scale them:
dj_brdf divides by 140, decodes sRGB and multiplies by 100.)
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..container import replacing
from ..errors import CorruptFileError
from ..geometry.directions import from_spherical
from ..geometry.warps import Circle, TwoSided, listed
from ..reflectance import Reflectance
from ..representations.baking.bake import require_storable, require_values
from ..representations.tables.anisotropic import AnisotropicNormalBasis
from ..representations.tables.encoding import Encoding
from ..representations.tables.layout import Layout
from ..representations.tables.table import Table
from .filling import fill
from .registry import Format

ELEVATIONS, AZIMUTHS = 6, 48
STEP = math.radians(15), math.radians(7.5)
"""Of elevation and azimuth [rad]."""

_DIRECTIONS = ELEVATIONS * AZIMUTHS
_VALUE = np.dtype("<f8")
_BYTES = 3 * _DIRECTIONS**2 * _VALUE.itemsize
_LARGEST = 1e6
"""1/sr; larger values are no BRDF but a file of another kind of the same size."""

_ELEVATION = listed(np.arange(ELEVATIONS) * STEP[0])
LAYOUT = Layout(
    AnisotropicNormalBasis(),
    (Circle(), _ELEVATION, _ELEVATION, TwoSided()),
    (AZIMUTHS, ELEVATIONS, ELEVATIONS, AZIMUTHS + 1),
    Encoding(),
)


def recognises(head: bytes, size: int) -> bool:
    """There is no signature: by the size, and by what the first values are."""
    if size != _BYTES:
        return False
    first = np.frombuffer(head[: len(head) // 8 * 8], _VALUE)
    return bool(np.all(np.abs(first) < _LARGEST))


def read(path: Path) -> Reflectance:
    """The file as a `Table` over its own angles. Raises CorruptFileError."""
    size = path.stat().st_size
    if size != _BYTES:
        raise CorruptFileError(path, f"has {size} bytes; a UTIA file has {_BYTES}.")
    planes = np.fromfile(path, _VALUE).reshape(3, ELEVATIONS, AZIMUTHS, ELEVATIONS, AZIMUTHS)
    if not np.all(np.abs(planes) < _LARGEST):
        raise CorruptFileError(path, "holds NaN, infinity or values that are no BRDF; fetch it again.")
    # (channel, theta_i, phi_i, theta_o, phi_o) -> (phi_i, theta_i, theta_o, phi_o - phi_i, channel)
    difference = _from_light(planes.transpose(2, 1, 3, 4, 0).astype(np.float32))
    grid = np.concatenate([difference, difference[..., :1, :]], axis=3)
    measured = np.asarray((grid >= 0).all(axis=-1))
    if not measured.any():
        raise CorruptFileError(path, "holds no value above zero.")
    fill(grid, measured, (2, 1, 3, 0))
    return Table(LAYOUT, grid, measured=measured).named(path.stem, f"UTIA file {path.name}")


def write(reflectance: Reflectance, path: Path) -> None:
    """The reflectance at UTIA's directions.

    Raises ReflectanceError for what transmits, mirrors or reaches values that `read` refuses, FileError.
    """
    require_values(reflectance)
    nodes = (np.arange(count) * step for count, step in zip((ELEVATIONS, AZIMUTHS), STEP, strict=True))
    w = from_spherical(*np.meshgrid(*nodes, indexing="ij")).reshape(-1, 3)
    planes = np.moveaxis(np.asarray(reflectance(w[:, None], w[None])), -1, 0)
    require_storable(reflectance, planes, "a UTIA file", _LARGEST)
    with replacing(path) as temporary, temporary.open("wb") as file:
        file.write(planes.astype(_VALUE).tobytes())


def _from_light(grid: NDArray[np.float32]) -> NDArray[np.float32]:
    """(phi_i, theta_i, theta_o, phi, C): phi counted from phi_i on."""
    return np.stack([np.roll(grid[i], -i, axis=2) for i in range(len(grid))])


FORMAT = Format(
    "UTIA",
    (".bin",),
    "anisotropic measured table, 6 x 48 x 6 x 48 directions, RGB",
    recognises,
    read,
    write,
    has_signature=False,
)
