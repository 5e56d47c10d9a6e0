"""MIT CSAIL's anisotropic measurements [Ngan2005]: bins over theta_in, theta_out, phi_diff and phi_in.

Sixteen int32 (little endian), then the red, green and blue plane of float32; phi_in runs fastest. Of the header count
the four numbers of bins (theta_in, theta_out, phi_diff, phi_in), the parameterisation (index 6, must be 1), the binning
(7, must be 0), whether phi_diff runs over half a turn (9) and the number of channels (10, must be 3). theta runs to 90
degrees, phi_in around the circle. A value belongs to the middle of its bin; azimuth 0 is the middle of the first bin of
phi_in. Negative values mark bins without a measurement. Source: github.com/wdas/brdf, BRDFMeasuredAniso.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..container import replacing
from ..errors import BrdfError, CorruptFileError
from ..geometry.warps import Circle, listed
from ..reflectance import Reflectance
from ..representations.baking.bake import require_storable, require_values
from ..representations.tables.anisotropic import AnisotropicNormalBasis
from ..representations.tables.encoding import Encoding
from ..representations.tables.layout import Layout
from ..representations.tables.table import Table
from .filling import fill
from .registry import Format

_HEADER = np.dtype("<i4")
_VALUE = np.dtype("<f4")
_HEADER_BYTES = 16 * _HEADER.itemsize
MOST_BINS = 4096
"""Along one axis."""


def recognises(head: bytes, size: int) -> bool:
    """By the four numbers of bins, which give the size of the file."""
    if len(head) < _HEADER_BYTES:
        return False
    header = np.frombuffer(head[:_HEADER_BYTES], _HEADER).tolist()
    return header[6] == 1 and header[10] == 3 and _size(header) == size


def _size(header: list[int]) -> int:
    return _HEADER_BYTES + 3 * _VALUE.itemsize * math.prod(header[:4]) if min(header[:4]) > 0 else 0


def read(path: Path) -> Reflectance:
    """The file as a `Table` over its own bins. Raises CorruptFileError."""
    with path.open("rb") as file:
        head = file.read(_HEADER_BYTES)
        if len(head) < _HEADER_BYTES:
            raise CorruptFileError(path, f"has {len(head)} bytes, too few for a header ({_HEADER_BYTES}).")
        header = np.frombuffer(head, _HEADER).tolist()
        bins = header[:4]
        if min(bins) < 2 or max(bins) > MOST_BINS:
            given = " x ".join(map(str, bins))
            raise CorruptFileError(path, f"its header says {given} bins; 2 to {MOST_BINS} an axis are read.")
        if header[6] != 1 or header[7] != 0 or header[9] not in (0, 1) or header[10] != 3:
            raise CorruptFileError(path, "has another parameterisation, binning or number of channels than is read.")
        size = path.stat().st_size
        if size != _size(header):
            raise CorruptFileError(path, f"expected {_size(header)} bytes, found {size}; fetch it again.")
        theta_i, theta_o, phi_diff, phi_in = bins
        layout = _layout((theta_i, theta_o, phi_diff, phi_in), is_half=header[9] == 1)
        inner = slice(None) if header[9] == 1 else slice(1, -1)
        grid = np.empty((*layout.shape, 3), np.float32)
        for channel in range(3):
            plane = np.frombuffer(file.read(math.prod(bins) * _VALUE.itemsize), _VALUE).reshape(bins)
            if not np.isfinite(plane).all():
                raise CorruptFileError(path, f"its {('red', 'green', 'blue')[channel]} plane holds NaN or infinity.")
            grid[:, :, :, inner, channel] = np.moveaxis(plane, 3, 0)
    if header[9] == 0:
        _close(grid)
    measured = np.asarray((grid >= 0).all(axis=-1))
    if not measured.any():
        raise CorruptFileError(path, "holds no measured bin; fetch it again.")
    fill(grid, measured, (3, 2, 1, 0))
    try:
        return Table(layout, grid, measured=measured).named(path.stem, f"MIT CSAIL file {path.name}")
    except (BrdfError, ValueError) as error:
        raise CorruptFileError(path, f"{error}.") from None


def _close(grid: NDArray[np.float32]) -> None:
    """Nodes at 0 and 360 degrees of phi_diff, between the last and the first bin."""
    first, last = grid[:, :, :, 1], grid[:, :, :, -2]
    between = np.where((first >= 0) & (last >= 0), (first + last) / 2, np.maximum(first, last))
    grid[:, :, :, 0] = grid[:, :, :, -1] = between


def _layout(bins: tuple[int, int, int, int], is_half: bool) -> Layout:
    theta_i, theta_o, phi_diff, phi_in = bins
    polar = [listed(_middles(count, math.pi / 2)) for count in (theta_i, theta_o)]
    around = _middles(phi_diff, math.pi if is_half else 2 * math.pi)
    if not is_half:
        around = np.concatenate([[0.0], around, [2 * math.pi]])
    basis = AnisotropicNormalBasis("half-turn" if is_half else "none")
    return Layout(basis, (Circle(), *polar, listed(around)), (phi_in, theta_i, theta_o, len(around)), Encoding())


def _middles(count: int, extent: float) -> NDArray[np.float64]:
    return np.asarray((np.arange(count) + 0.5) * (extent / count), np.float64)


def write(reflectance: Reflectance, path: Path) -> None:
    """The reflectance at the middles of bins of 3, 3, 4 and 8 degrees, a file of 33 MB; a table that came from such a
    file gives its own bins back. Raises ReflectanceError for what transmits or mirrors, FileError.
    """
    require_values(reflectance)
    own = isinstance(reflectance, Table) and reflectance.layout.basis == AnisotropicNormalBasis()
    bins = (30, 30, 90, 45)
    if own and isinstance(reflectance, Table):
        phi_in, theta_i, theta_o, around = reflectance.layout.shape
        if reflectance.layout == _layout((theta_i, theta_o, around - 2, phi_in), is_half=False):
            bins = (theta_i, theta_o, around - 2, phi_in)
    header = np.zeros(16, _HEADER)
    header[:4], header[6], header[10] = bins, 1, 3
    theta_i_nodes, theta_o_nodes = _middles(bins[0], math.pi / 2), _middles(bins[1], math.pi / 2)
    around_nodes = _middles(bins[2], 2 * math.pi)
    turns = np.arange(bins[3]) * (2 * math.pi / bins[3])
    planes = np.empty((3, *bins), _VALUE)
    for i, theta in enumerate(theta_i_nodes):
        nodes = np.meshgrid(turns, [theta], theta_o_nodes, around_nodes, indexing="ij")
        wi, wo = AnisotropicNormalBasis().directions(*nodes)
        with np.errstate(over="ignore"):  # what does not fit becomes infinite, and is refused below
            planes[:, i] = np.asarray(reflectance(wi, wo))[:, 0].transpose(3, 1, 2, 0)
    require_storable(reflectance, planes, "an MIT CSAIL file")
    with replacing(path) as temporary, temporary.open("wb") as file:
        file.write(header.tobytes())
        file.write(planes.tobytes())


FORMAT = Format(
    "MIT CSAIL",
    (".csail", ".dat"),
    "anisotropic measured table over theta_in, theta_out, phi_diff and phi_in, RGB",
    recognises,
    read,
    write,
    has_signature=False,
)
