"""From what a user gives to what is fitted: samples, and where there is one the reflectance to make pictures of."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, NamedTuple

from ..geometry.directions import pairs_from_spherical
from ..io import alta, astm, gonio
from ..io.registry import format_of
from ..loading import is_file, load
from ..reflectance import Reflectance
from .samples import GRAZING, Samples, from_rows, samples_of


class Data(NamedTuple):
    """What a model is fitted to."""

    samples: Samples
    reflectance: Reflectance | None
    """The same as a whole; None for samples alone."""


def data_of(given: Any, grazing: float = GRAZING) -> Data:
    """The data of a reflectance, `Samples`, or the description of a material as `brdf.load` takes it.

    Of a file of scattered measurements the rows are fitted as they were measured, not the interpolation between them.
    Raises as `brdf.load` and `samples_of`.
    """
    if not isinstance(given, (str, os.PathLike)):
        return Data(samples_of(given, grazing), given if isinstance(given, Reflectance) else None)
    m = load(given)
    text = os.fspath(given)
    rows = _rows(Path(given), grazing, m) if is_file(text) or isinstance(given, os.PathLike) else None
    return Data(samples_of(m, grazing) if rows is None else rows, m)


def _rows(path: Path, grazing: float, m: Reflectance) -> Samples | None:
    """What a file of scattered measurements holds, row by row; None of any other file."""
    kind = format_of(path)
    if kind is alta.FORMAT:
        wi, wo, values = alta.read_samples(path)
    elif kind in (astm.FORMAT, gonio.FORMAT):
        wavelengths, angles, values = astm.read_rows(path) if kind is astm.FORMAT else gonio.read_rows(path)
        if wavelengths is not None:
            return from_rows(angles, values, wavelengths, grazing, m.name, m.source)
        wi, wo = pairs_from_spherical(angles)
    else:
        return None
    return Samples.of(wi, wo, values, 1.0, grazing, m.name, m.source)
