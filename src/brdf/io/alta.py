"""Text data of the ALTA library: scattered measurements over one of its parameterisations.

Lines that start with "#" are the header, `#KEY values`: DIM, the numbers of inputs and outputs; PARAM_IN, what the
inputs are; PARAM_OUT, what the outputs are; VS, whether confidence intervals follow them, which are left out. Then one
line a measurement. Angles are in radians. Source: github.com/belcour/alta at 7c54015, sources/core/params.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..container import replacing
from ..errors import CorruptFileError
from ..geometry.directions import from_half_difference, from_spherical
from ..reflectance import Reflectance
from ..representations.baking.bake import require_storable
from ..representations.scattered import Scattered
from .angles import goniometer_pairs
from .registry import Format
from .rows import measured_rgb
from .text import Rows, lines, numbers

Array = NDArray[np.floating[Any]]
Directions = tuple[Array, Array]
"""`wi` and `wo`, (N, 3) each."""

LEAST_COSINE = 1e-3
"""Measurements closer to the horizon are left out: values with a cosine in them say nothing there."""


def _disc(x: Array, y: Array) -> Array:
    """A direction from its polar angle times cosine and sine of its azimuth."""
    return from_spherical(np.hypot(x, y), np.arctan2(y, x))


def _half(theta_h: Array, phi_h: Array | float, theta_d: Array, phi_d: Array | float) -> Directions:
    """ALTA's difference vector is the viewer in the frame of the half vector."""
    wo, wi = from_half_difference(theta_h, phi_h, theta_d, phi_d)
    return wi, wo


def _light(theta: Array) -> Array:
    return from_spherical(theta, 0 * theta)


INPUTS: dict[str, tuple[int, Callable[..., Directions]]] = {
    "CARTESIAN": (6, lambda vx, vy, vz, lx, ly, lz: (np.stack([lx, ly, lz], -1), np.stack([vx, vy, vz], -1))),
    "COS_TH_TD": (2, lambda h, d: _half(np.arccos(h.clip(-1, 1)), 0.0, np.arccos(d.clip(-1, 1)), 0.0)),
    "ISOTROPIC_TL_TV_PROJ_DPHI": (3, lambda light, x, y: (_light(light), _disc(x, y))),
    "ISOTROPIC_TV_PROJ_DPHI": (2, lambda x, y: (_light(0 * x), _disc(x, y))),
    "ISOTROPIC_TV_TL_DPHI": (3, lambda view, light, phi: (from_spherical(light, phi), _light(view))),
    "RUSIN_TH_PH_TD_PD": (4, _half),
    "RUSIN_TH_TD": (2, lambda h, d: _half(h, 0.0, d, math.pi / 2)),
    "RUSIN_TH_TD_PD": (3, lambda h, d, phi: _half(h, 0.0, d, phi)),
    "SPHERICAL_TL_PL_TV_PV": (4, lambda tl, pl, tv, pv: (from_spherical(tl, pl), from_spherical(tv, pv))),
}
"""How many numbers a parameterisation has, and the directions they stand for."""

OUTPUTS: dict[str, tuple[int, ...]] = {
    "INV_STERADIAN": (1, 3),
    "INV_STERADIAN_COSINE_FACTOR": (1, 3),
    "RGB_COLOR": (3,),
    "XYZ_COLOR": (3,),
}
"""How many numbers the outputs may have: the BRDF, the BRDF times the cosine of the viewer's angle, or colours."""


def recognises(head: bytes, size: int) -> bool:
    """By the header's keys."""
    return head.startswith(b"#") and b"#DIM" in head and b"#PARAM_IN" in head


def read(path: Path) -> Reflectance:
    """The file as a `Scattered`, read as isotropic. Raises CorruptFileError."""
    wi, wo, values = read_samples(path)
    try:
        made = Scattered.from_samples(wi, wo, values)
    except ValueError as error:
        raise CorruptFileError(path, f"{error}.") from None
    return made.named(path.stem, f"ALTA file {path.name}, {len(values)} measurements")


def read_samples(path: Path) -> tuple[Array, Array, Array]:
    """`wi`, `wo` (N, 3) and values (N, 3) in 1/sr, RGB, above the horizon; negative ones as they are.

    Raises CorruptFileError.
    """
    header = _header(path)
    kind = (header.get("PARAM_IN") or [""])[0]
    if header.get("FORMAT", ["text"])[0] != "text":
        raise CorruptFileError(path, "is ALTA's binary data; convert it to text with its data2data first.")
    if kind not in INPUTS:
        raise CorruptFileError(path, f"its parameters are {kind!r}; read are {', '.join(INPUTS)}.")
    output = (header.get("PARAM_OUT") or ["INV_STERADIAN"])[0]
    if output not in OUTPUTS:
        raise CorruptFileError(path, f"its values are {output!r}; read are {', '.join(OUTPUTS)}.")
    inputs, directions = INPUTS[kind]
    dimensions = header.get("DIM", [])
    if len(dimensions) != 2 or dimensions[0] != str(inputs) or dimensions[1] not in map(str, OUTPUTS[output]):
        outputs = " or ".join(map(str, OUTPUTS[output]))
        given = " ".join(dimensions)[:40]
        raise CorruptFileError(path, f"#DIM must be {inputs} {outputs} for {kind} and {output}, got {given!r}.")
    table = _rows(path, inputs, int(dimensions[1]))
    wi, wo = directions(*table[:, :inputs].T)
    values = table[:, inputs:]
    kept = (wi[:, 2] > LEAST_COSINE) & (wo[:, 2] > LEAST_COSINE)
    kept &= (np.abs(np.linalg.norm(wi, axis=1) - 1) < 1e-3) & (np.abs(np.linalg.norm(wo, axis=1) - 1) < 1e-3)
    if not kept.any():
        raise CorruptFileError(path, "holds no measurement above the horizon.")
    wi, wo, values = wi[kept], wo[kept], values[kept]
    if output == "INV_STERADIAN_COSINE_FACTOR":
        values = values / wo[:, 2:]
    rgb = measured_rgb(values) if output == "XYZ_COLOR" else np.broadcast_to(values, (len(values), 3))
    return wi, wo, np.asarray(rgb, np.float64)


def _header(path: Path) -> dict[str, list[str]]:
    header = {}
    for _, line in lines(path, comment="\0"):
        if not line.startswith("#"):
            break
        key, *words = line[1:].split() or [""]
        header[key] = words
    return header


def _rows(path: Path, inputs: int, outputs: int) -> Array:
    rows = Rows(path, inputs + outputs, f"{inputs} inputs and {outputs} values")
    intervals = (0, 1, 2, outputs, 2 * outputs)
    for number, line in lines(path):
        row = numbers(path, number, line.split())
        rows.add(number, row[: inputs + outputs] if len(row) - inputs - outputs in intervals else row)
    return rows.table()


def write(reflectance: Reflectance, path: Path) -> None:
    """RGB at the pairs of `goniometer_pairs`. Raises ReflectanceError for what is anisotropic, transmits or mirrors."""
    angles, wi, wo = goniometer_pairs(reflectance)
    values = reflectance(wi, wo)
    require_storable(reflectance, values, "ALTA text")
    columns: Any = np.concatenate([angles, values], axis=1)
    header = "#DIM 4 3\n#PARAM_IN SPHERICAL_TL_PL_TV_PV\n#PARAM_OUT RGB_COLOR\n#VS 0\n"
    with replacing(path) as temporary, temporary.open("w", encoding="ascii") as file:
        file.write(header)
        np.savetxt(file, columns, fmt="%.9g")


FORMAT = Format(
    "ALTA text",
    (".alta", ".dat"),
    "scattered measurements over any of its common parameterisations; read as isotropic",
    recognises,
    read,
    write,
)
