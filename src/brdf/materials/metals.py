"""Metals by their measured refractive index: `metal/gold`, `metal/silver`, …

`data/metals.json`, packed by `tools/pack_metals.py` from the refractiveindex.info database (CC0, licence beside the
data), holds for each metal the published spectrum n + i k and a three-channel index with the same RGB reflectance at
normal incidence and on the average over the hemisphere. Light is taken as in `brdf.color.spectrum_to_rgb`.
"""

from __future__ import annotations

import functools
import json
from importlib import resources
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import UnknownNameError
from ..geometry.quadrature import gauss_legendre
from ..models.microfacet import Microfacet
from ..models.smooth_conductor import SmoothConductor
from ..models.terms.fresnel import conductor
from ..reflectance import Reflectance
from . import providers

PREFIX = "metal/"
ALPHA = 0.1
"""GGX width of the finely ground surface that a bare name stands for; `replaced(alpha=...)` gives another."""

VARIANTS = {"ground": f"GGX facets of width {ALPHA}", "polished": "a smooth mirror"}
"""The first is what a bare name stands for: a mirror shows nothing under a light without extent."""


class Spectrum(NamedTuple):
    """The refractive index as published."""

    nm: NDArray[np.float64]
    """(W,) wavelengths [nm]"""
    n: NDArray[np.float64]
    """(W,) real part"""
    k: NDArray[np.float64]
    """(W,) extinction coefficient"""


@functools.cache
def _table() -> dict[str, Any]:
    table: dict[str, Any] = json.loads(resources.files(__package__).joinpath("data/metals.json").read_text("utf-8"))
    return table


def names() -> list[str]:
    """The names of the metals."""
    return [PREFIX + metal for metal in _table()]


def variants(name: str) -> list[str]:
    """The surfaces a metal comes with, the preferred one first."""
    _row(name)
    return list(VARIANTS)


def get(name: str, variant: str | None = None) -> Reflectance:
    """A metal by name, `ground` (the default) or `polished`. Raises UnknownNameError."""
    row = _row(name)
    if variant is not None and variant not in VARIANTS:
        raise UnknownNameError(f"surface of {name}", variant, VARIANTS)
    wanted = variant or next(iter(VARIANTS))
    made: Reflectance
    if wanted == "polished":
        made = SmoothConductor(eta=row["eta"], k=row["k"])
    else:
        made = Microfacet(ndf="ggx", alpha=ALPHA, fresnel="conductor", eta=row["eta"], k=row["k"])
    index = f"refractive index as measured ({row['source']}), from refractiveindex.info (Polyanskiy2024), CC0"
    return made.named(name, f"{wanted}: {VARIANTS[wanted]}; {index}")


def spectrum(name: str) -> Spectrum:
    """The refractive index of a metal against wavelength. Raises UnknownNameError."""
    values = _row(name)["spectrum"]
    return Spectrum(*(np.array(values[key]) for key in Spectrum._fields))


def _row(name: str) -> dict[str, Any]:
    metal = name.removeprefix(PREFIX)
    if metal not in _table():
        raise UnknownNameError("metal", name, names())
    row: dict[str, Any] = _table()[metal]
    return row


def mean_reflectance(n: ArrayLike, k: ArrayLike) -> NDArray[np.float64]:
    """Fresnel reflectance averaged over the hemisphere, weighed with the cosine, for indices n + i k of any shape."""
    cosine, weight = gauss_legendre(32)
    n, k = (np.asarray(values, np.float64)[..., None] for values in (n, k))
    mean: NDArray[np.float64] = (conductor(cosine, n, k) * 2 * cosine * weight).sum(-1)
    return mean


providers.register(names, variants, get)
