"""Zemax's tabular `.bsdf` text: scatter about the specular direction, from imaging spheres and goniometers.

After comments ("#") come pairs of a key and a value, four of them with a list of angles in degrees on the next line:
SampleRotation, AngleOfIncidence, ScatterAzimuth, ScatterRadial. Then, for each spectral channel, DataBegin, and for
each rotation and each angle of incidence a line TIS and one line of values [1/sr] an azimuth; DataEnd closes. Azimuth 0
points from the specular direction to the normal. Zero stands for no measurement. Source: Zemax, Tabular BSDF data file
format (support.zemax.com, article 1500005486801).
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..color import XYZ_TO_RGB, rgb_to_xyz
from ..container import replacing
from ..errors import BrdfError, CorruptFileError, ReflectanceError
from ..geometry.warps import Circle, listed
from ..reflectance import Reflectance
from ..representations.baking.bake import require_storable, require_values
from ..representations.tables.encoding import Encoding
from ..representations.tables.layout import Layout
from ..representations.tables.specular import AnisotropicSpecularBasis, SpecularBasis
from ..representations.tables.table import Table
from .filling import fill
from .registry import Format
from .text import lines, numbers

Array = NDArray[np.float64]

AXES = {"SampleRotation": 360.0, "AngleOfIncidence": 90.0, "ScatterAzimuth": 360.0, "ScatterRadial": 180.0}
"""The lists of angles and the largest that each may hold, degrees."""

SYMMETRIES = {"planesymmetrical": 180.0, "asymmetrical": 360.0, "asymmetrical4d": 360.0}
"""How far the azimuth runs, degrees."""

CHANNELS = {"monochrome": ("monochrome",), "xyz": ("tristimulusx", "tristimulusy", "tristimulusz")}

MOST_ANGLES = 2000
LARGEST = 1e30
"""1/sr; larger values are refused."""
_KEYS = re.compile(rb"^(Source|Symmetry|SpectralContent|ScatterType|SampleRotation)[ \t]", re.MULTILINE)


class Contents(NamedTuple):
    """What a file says."""

    symmetry: str
    angles: dict[str, Array]
    """Degrees, by the name of the axis."""
    values: NDArray[np.float32]
    """(channels, rotations, angles of incidence, azimuths, radials) in 1/sr."""


def recognises(head: bytes, size: int) -> bool:
    """By two of the first keys; comments may be longer than what is looked at."""
    text = b"\n".join(line for line in head.splitlines() if not line.startswith(b"#"))
    if len(_KEYS.findall(text)) >= 2:
        return True
    return not text.strip() and head.startswith(b"#") and b"bsdf" in head.lower()


def read(path: Path) -> Reflectance:
    """The file as a `Table` over the very angles of the file. Raises CorruptFileError, which names the line."""
    contents = read_values(path)
    grid = np.moveaxis(contents.values, 0, -1).swapaxes(2, 3)  # rotation, incidence, radial, azimuth, channel
    rgb = np.repeat(grid, 3, axis=-1) if grid.shape[-1] == 1 else np.asarray(grid @ XYZ_TO_RGB.T, np.float32)
    try:
        table = _table(contents, rgb)
    except (BrdfError, ValueError) as error:
        raise CorruptFileError(path, f"{error}.") from None
    return table.named(path.stem, f"Zemax file {path.name}")


def _table(contents: Contents, rgb: NDArray[np.float32]) -> Table:
    rotations, incidence, azimuth, radial = (np.radians(contents.angles[name]) for name in AXES)
    is_folded = contents.symmetry == "planesymmetrical"
    if not is_folded and azimuth[-1] < 2 * math.pi - 1e-6:  # the circle is closed by its first azimuth
        azimuth = np.append(azimuth, 2 * math.pi)
        rgb = np.concatenate([rgb, rgb[:, :, :, :1]], axis=3)
    if not is_folded:
        azimuth[-1] = 2 * math.pi
    if len(incidence) == 1:  # an axis needs two nodes; one angle of incidence stands for all
        incidence, rgb = np.array([0.0, math.pi / 2]), np.repeat(rgb, 2, axis=1)
    polar = (listed(incidence), listed(radial), listed(azimuth))
    measured = np.asarray((rgb > 0).any(axis=-1))
    if not measured.any():
        raise ValueError("holds no value above zero")
    fill(rgb, measured, (2, 3, 1))
    encoding = Encoding()
    if len(rotations) == 1:
        basis = SpecularBasis("half-turn" if is_folded else "none")
        layout = Layout(basis, polar, rgb.shape[1:4], encoding)
        return Table(layout, np.ascontiguousarray(rgb[0]), measured=measured[0])
    rgb, measured = _around(rotations, rgb), _around(rotations, measured[..., None].astype(np.float32))[..., 0] > 0.5
    layout = Layout(AnisotropicSpecularBasis(), (Circle(), *polar), rgb.shape[:4], encoding)
    return Table(layout, rgb, measured=measured)


def _around(rotations: Array, values: NDArray[np.float32]) -> NDArray[np.float32]:
    """Values at evenly spaced azimuths of the light from those at any rotations of the sample."""
    if rotations[-1] - rotations[0] > 2 * math.pi - 1e-6:
        rotations, values = rotations[:-1], values[:-1]
    step = float(np.diff(rotations, append=rotations[0] + 2 * math.pi).min())
    count = min(max(2, round(2 * math.pi / step)), 4 * len(rotations))  # a tiny step makes no table of its own size
    wanted = -np.arange(count) * (2 * math.pi / count) % (2 * math.pi)  # turning the sample turns the light back
    turned = np.append(rotations, rotations[0] + 2 * math.pi)
    index = np.append(np.arange(len(rotations)), 0)
    place = np.interp(wanted, turned, np.arange(len(turned))).round(9)
    below = np.minimum(place.astype(int), len(turned) - 2)
    if np.all(place == place.round()):  # the rotations of the file themselves, and no copies to mix
        return np.asarray(values[index[place.astype(int)]], np.float32)
    share = (place - below).astype(np.float32).reshape(-1, *[1] * (values.ndim - 1))
    return np.asarray(values[index[below]] * (1 - share) + values[index[below + 1]] * share, np.float32)


def read_values(path: Path) -> Contents:
    """What the file says. Sizes are checked against the file before memory is taken. Raises CorruptFileError."""
    content = lines(path)
    words, angles = _header(path, content)
    symmetry = words.get("Symmetry", "").lower()
    if symmetry not in SYMMETRIES:
        raise CorruptFileError(path, f"its Symmetry is {symmetry!r}; read are {', '.join(SYMMETRIES)}.")
    if words.get("ScatterType", "").upper() != "BRDF":
        raise CorruptFileError(path, f"its ScatterType is {words.get('ScatterType', '')!r}; only BRDF is read.")
    spectral = words.get("SpectralContent", "").lower()
    if spectral not in CHANNELS:
        given = words.get("SpectralContent", "")
        raise CorruptFileError(path, f"its SpectralContent is {given!r}; read are Monochrome and XYZ.")
    for name in AXES:
        if name not in angles:
            raise CorruptFileError(path, f"its list of angles {name} is missing.")
    _check_azimuths(path, symmetry, angles)
    shape = (len(CHANNELS[spectral]), *(len(angles[name]) for name in AXES))
    if 2 * math.prod(shape) > path.stat().st_size:  # a digit and a blank each
        size = " x ".join(map(str, shape))
        raise CorruptFileError(path, f"claims {size} values, more than a file of its size holds; fetch it again.")
    return Contents(symmetry, angles, _values(path, content, CHANNELS[spectral], shape))


def _header(path: Path, content: Iterator[tuple[int, str]]) -> tuple[dict[str, str], dict[str, Array]]:
    """The words by key and the lists of angles, up to DataBegin."""
    words: dict[str, str] = {}
    angles: dict[str, Array] = {}
    for number, line in content:
        key, *rest = line.split()
        if key == "DataBegin":
            return words, angles
        if key not in AXES:
            words[key] = rest[0] if rest else ""
            continue
        if len(rest) != 1 or not rest[0].isdigit() or not 1 <= int(rest[0][:9]) <= MOST_ANGLES:
            raise CorruptFileError(path, f"line {number}: {key} must be followed by a number, 1 to {MOST_ANGLES}.")
        count, listed_ = int(rest[0]), list[float]()
        while len(listed_) < count:
            number, line = next(content, (number, ""))
            listed_ += numbers(path, number, line.split())
            if not line or len(listed_) > count:
                raise CorruptFileError(path, f"line {number}: {len(listed_)} of {count} angles of {key} are there.")
        if listed_[0] < 0 or listed_[-1] > AXES[key] or any(b <= a for a, b in pairwise(listed_)):
            raise CorruptFileError(path, f"line {number}: {key} must increase within 0 to {AXES[key]:g} degrees.")
        angles[key] = np.array(listed_)
    raise CorruptFileError(path, "ends before DataBegin; fetch it again.")


def _check_azimuths(path: Path, symmetry: str, angles: dict[str, Array]) -> None:
    azimuths, radials = angles["ScatterAzimuth"], angles["ScatterRadial"]
    if azimuths[0] != 0 or len(azimuths) < 2 or azimuths[-1] > SYMMETRIES[symmetry]:
        reach = SYMMETRIES[symmetry]
        raise CorruptFileError(path, f"its azimuths must be two or more from 0 to {reach:g} degrees at most.")
    if len(radials) < 2:
        raise CorruptFileError(path, "must hold two or more radial angles.")
    if len(angles["SampleRotation"]) > 1 and symmetry != "asymmetrical4d":
        raise CorruptFileError(path, "turns the sample, which only Asymmetrical4D data may.")


def _values(
    path: Path, content: Iterator[tuple[int, str]], channels: tuple[str, ...], shape: tuple[int, ...]
) -> NDArray[np.float32]:
    values = np.zeros(shape, np.float32)
    blocks = values.reshape(len(channels), -1, *shape[3:])
    channel, block, row = 0, -1, shape[3]
    for number, line in content:
        key, *rest = line.split()
        if key == "DataEnd" or key.lower() in channels or key == "DataBegin":
            if key.lower() in channels:
                channel, block = channels.index(key.lower()), -1
        elif key == "TIS":
            block, row, complete = block + 1, 0, row == shape[3]
            if not complete or block >= blocks.shape[1]:
                raise CorruptFileError(path, f"line {number}: TIS comes too early or too often; fetch it again.")
        else:
            found = numbers(path, number, [key, *rest])
            if block < 0 or row >= shape[3] or len(found) != shape[4] or max(map(abs, found)) > LARGEST:
                wanted = f"{shape[3]} lines of {shape[4]} values"
                raise CorruptFileError(path, f"line {number} is not one of the {wanted} after a line TIS.")
            blocks[channel, block, row] = found
            row += 1
    if block != blocks.shape[1] - 1 or row != shape[3] or channel != len(channels) - 1:
        raise CorruptFileError(path, "ends before all of its values; fetch it again.")
    return values


INCIDENCE = np.arange(0.0, 90, 5)
RADIAL = np.array(
    [*(0, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.75, 1, 1.5, 2, 3, 4, 5, 6, 8, 10, 12.5, 15, 17.5), *range(20, 181, 5)],
    np.float64,
)
STEP = 10.0
"""Angles that are written, degrees; the last of azimuth and rotation."""

HORIZON_MARGIN = 0.02
"""How far above the horizon what is written at it is taken, rad: many reflectances grow without bound towards it, and
readers interpolate from the last direction before it, 5 degrees away. Nearer, that raises the albedo of those."""

_ROUNDING = 1e-6
"""The same for a table's own angles, whose values are bounded: just so far that no direction is rounded below it."""


def write(reflectance: Reflectance, path: Path) -> None:
    """Values about the specular direction: at a table's own angles where it came from such a file, else every 5 degrees
    of incidence and more densely near the specular direction. Colours are written as XYZ.

    Raises ReflectanceError for what transmits, mirrors or is black, FileError.
    """
    require_values(reflectance)
    own = _own_layout(reflectance)
    angles, symmetry = _angles_for(reflectance, own)
    rotation, incidence, azimuth, radial = (np.radians(angles[name]) for name in AXES)
    nodes = np.meshgrid(-rotation, incidence, radial, azimuth, indexing="ij")
    basis, margin = AnisotropicSpecularBasis(), _ROUNDING if own else HORIZON_MARGIN
    wo = basis.directions(*nodes)[1]
    lifted = reflectance(*basis.directions(*basis.above_horizon(*nodes, margin=margin)))
    values = np.where(wo[..., 2:] > -_ROUNDING, lifted, 0.0).swapaxes(2, 3)
    require_storable(reflectance, values, "Zemax text", LARGEST)
    if not (values > 0).any():
        name = reflectance.name or type(reflectance).__name__
        raise ReflectanceError(f"{name} is black, which Zemax text takes for no measurement; write .bin or .csail")
    is_grey = bool(np.allclose(values, values[..., :1], rtol=1e-6, atol=0))
    channels = values[..., :1] if is_grey else np.asarray(rgb_to_xyz(values))
    spectral = "Monochrome" if is_grey else "XYZ"
    names = ["Monochrome"] if is_grey else ["TristimulusX", "TristimulusY", "TristimulusZ"]
    cosine = np.maximum(wo[..., 2].swapaxes(2, 3), 0)
    weight = _solid_angles(radial, azimuth) * cosine * (2 * math.pi / azimuth[-1])
    with replacing(path) as temporary, temporary.open("w", encoding="ascii") as file:
        file.write(f"Source\tMeasured\nSymmetry\t{symmetry}\nSpectralContent\t{spectral}\nScatterType\tBRDF\n")
        for name, listed_ in angles.items():
            file.write(f"{name}\t{len(listed_)}\n" + "\t".join(f"{angle:g}" for angle in listed_) + "\n")
        for channel, name in enumerate(names):
            file.write(f"\n{name}\nDataBegin\n")
            for block in np.ndindex(values.shape[:2]):
                file.write(f"TIS\t{(weight[block] * channels[block][..., channel]).sum():.6g}\n")
                np.savetxt(file, channels[block][..., channel], fmt="%.6e", delimiter="\t")
            file.write("DataEnd\n")


def _own_layout(reflectance: Reflectance) -> Layout | None:
    """Of a table over the angles of such a file."""
    if isinstance(reflectance, Table) and isinstance(
        reflectance.layout.basis, (SpecularBasis, AnisotropicSpecularBasis)
    ):
        return reflectance.layout
    return None


def _angles_for(reflectance: Reflectance, own: Layout | None) -> tuple[dict[str, Array], str]:
    """The lists of angles in degrees, in the order of `AXES`, and the symmetry."""
    turns = np.arange(0, 360 + STEP / 2, STEP)
    if own is not None:
        nodes = [np.degrees(w.nodes(n)) for w, n in zip(own.warps, own.shape, strict=True)]
        incidence, radial, azimuth = nodes[-3:]
        rotation = turns[:1] if reflectance.isotropic else np.append(nodes[0], 360.0)
    else:
        incidence, radial = INCIDENCE, RADIAL
        azimuth = turns[turns <= 180] if reflectance.isotropic else turns
        rotation = turns[:1] if reflectance.isotropic else turns
    angles = dict(zip(AXES, (rotation, incidence, azimuth, radial), strict=True))
    is_folded = azimuth[-1] < 181
    return angles, "PlaneSymmetrical" if is_folded else "Asymmetrical" if reflectance.isotropic else "ASymmetrical4D"


def _solid_angles(radial: Array, azimuth: Array) -> Array:
    """(azimuths, radials) weights of an integral over the sphere, or the half of it that the azimuths cover."""
    edges = np.concatenate([radial[:1], (radial[1:] + radial[:-1]) / 2, radial[-1:]])
    widths = np.gradient(azimuth)
    widths[[0, -1]] /= 2
    return np.asarray(widths[:, None] * -np.diff(np.cos(edges)))


FORMAT = Format(
    "Zemax text",
    (".bsdf",),
    "scatter about the specular direction, isotropic or anisotropic, monochrome or XYZ",
    recognises,
    read,
    write,
)
