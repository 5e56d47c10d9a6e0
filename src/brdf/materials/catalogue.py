"""The shipped materials by name, and what is known of each published fit.

The numbers are in `data/fits.json`, packed by `tools/pack_fits.py` from the tables of github.com/bsdfbenchmark/bbm
(licence beside the data): for every fit a column a parameter, in the order of its materials. The measurements
themselves (Matusik2003) are not shipped.
"""

from __future__ import annotations

import functools
import json
from collections.abc import Callable
from dataclasses import dataclass
from importlib import resources
from typing import Any

import numpy as np

from ..errors import UnknownNameError
from ..models.sgd import SGD
from ..reflectance import Reflectance

Row = dict[str, Any]
"""One material's parameters as published: numbers and lists of three."""


@dataclass(frozen=True)
class Fit:
    """A published set of fits: who fitted which model to what, and how a row of theirs becomes a reflectance."""

    name: str
    model: str
    citation: str
    """Key into docs/references.bib."""
    title: str
    make: Callable[[Row], Reflectance]

    @property
    def source(self) -> str:
        """One line of provenance."""
        return (
            f"{self.title} ({self.citation}), fitted to the MERL measurements (Matusik2003); "
            "parameters from github.com/bsdfbenchmark/bbm at 9807fb3"
        )


def _sgd(row: Row) -> Reflectance:
    F0, F1 = row["eta"]
    same = {name: row[name] for name in ("kd", "alpha", "p", "K", "Lambda", "k", "theta0")}
    return SGD(**same, ks=row["albedo"], F0=F0, F1=F1, log_c=np.log(row["c"]))


_FITS = {
    fit.name: fit
    for fit in (
        Fit(
            "bagher_sgd",
            "SGD",
            "Bagher2012",
            "Accurate fitting of measured reflectances using a Shifted Gamma micro-facet distribution",
            _sgd,
        ),
    )
}
"""In order of preference: the first that has a material is what its bare name stands for."""


@functools.cache
def _tables() -> dict[str, dict[str, Row]]:
    """Rows by fit and material."""
    packed = json.loads(resources.files(__package__).joinpath("data/fits.json").read_text("utf-8"))
    return {
        fit: {
            material: {name: column[i] for name, column in packed[fit].items() if name != "material"}
            for i, material in enumerate(packed[fit]["material"])
        }
        for fit in _FITS
    }


def names() -> list[str]:
    """The names of the shipped materials, sorted."""
    return sorted(set().union(*_tables().values()))


def fits(name: str) -> list[str]:
    """The published fits of a material, the preferred one first. Raises UnknownNameError."""
    found = [fit for fit, rows in _tables().items() if name in rows]
    if not found:
        raise UnknownNameError("material", name, names(), "see `brdf list materials`")
    return found


def published(fit: str) -> Fit:
    """What is known of a fit. Raises UnknownNameError."""
    if fit not in _FITS:
        raise UnknownNameError("fit", fit, _FITS)
    return _FITS[fit]


def get(name: str, fit: str | None = None) -> Reflectance:
    """A material by name; a particular fit as `NAME@FIT` or by `fit`, else the preferred one.

    Its `name` is the material's, its `source` tells who fitted it to what. Raises UnknownNameError.
    """
    name, at, after = name.partition("@")
    wanted = after if at else fit
    available = fits(name)
    if wanted is None:
        wanted = available[0]
    elif wanted not in available:
        raise UnknownNameError(f"fit of {name}", wanted, available)
    made = _FITS[wanted].make(_tables()[wanted][name])
    return made.named(name, f"{wanted}: {_FITS[wanted].source}")
