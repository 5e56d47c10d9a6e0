"""From what a user gives to what is fitted: samples, and where there is one the reflectance to make pictures of."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, NamedTuple

from ..io import gonio
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

    Of a goniometer's file the rows are fitted as they were measured, not the interpolation between them. Raises as
    `brdf.load` and `samples_of`.
    """
    if not isinstance(given, (str, os.PathLike)):
        return Data(samples_of(given, grazing), given if isinstance(given, Reflectance) else None)
    m = load(given)
    text = os.fspath(given)
    if (is_file(text) or isinstance(given, os.PathLike)) and format_of(text) is gonio.FORMAT:
        wavelengths, angles, spectra = gonio.read_rows(Path(given))
        return Data(from_rows(angles, spectra, wavelengths, grazing, m.name, m.source), m)
    return Data(samples_of(m, grazing), m)
