"""The shipped materials by name, and what is known of each published fit.

The numbers are in `data/fits.json`, packed by `tools/pack_fits.py` from the tables of github.com/bsdfbenchmark/bbm
(licence beside the data): for every fit a column a parameter, in the order of its materials; what they mean is in
`io.bbm_conventions`. The measurements themselves (Matusik2003) are not shipped.
"""

from __future__ import annotations

import functools
import json
from collections.abc import Callable
from dataclasses import dataclass
from importlib import resources

from ..errors import UnknownNameError
from ..io import bbm_conventions as conventions
from ..io.bbm_conventions import Row
from ..reflectance import Reflectance
from . import providers


@dataclass(frozen=True)
class Fit:
    """A published set of fits: who fitted which model to what, and how a row of theirs becomes a reflectance."""

    name: str
    model: str
    """The model of its lobe."""
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


_BAGHER = "Accurate fitting of measured reflectances using a Shifted Gamma micro-facet distribution"
_LOW = "BRDF models for accurate and efficient rendering of glossy surfaces"
_NGAN = "Experimental analysis of BRDF models"

_FITS = {
    fit.name: fit
    for fit in (
        Fit("bagher_sgd", "SGD", "Bagher2012", _BAGHER, conventions.sgd),
        Fit("low_lowmicrofacet_E2", "LowMicrofacet", "Low2012", _LOW, conventions.low_microfacet),
        Fit("low_lowsmooth_E2", "LowSmooth", "Low2012", _LOW, conventions.low_smooth),
        Fit("low_cooktorrance_E2", "CookTorrance", "Low2012", _LOW, conventions.low_cook_torrance),
        Fit("low_cooktorrance_E1", "CookTorrance", "Low2012", _LOW, conventions.low_cook_torrance),
        Fit("low_ashikhminshirley_E2", "AshikhminShirley", "Low2012", _LOW, conventions.low_ashikhmin_shirley),
        Fit("low_ashikhminshirley_E1", "AshikhminShirley", "Low2012", _LOW, conventions.low_ashikhmin_shirley),
        Fit("ngan_cooktorrance", "CookTorrance", "Ngan2005", _NGAN, conventions.ngan_cook_torrance),
        Fit("ngan_ashikhminshirley", "AshikhminShirley", "Ngan2005", _NGAN, conventions.ngan_ashikhmin_shirley),
        Fit("ngan_he", "HeTorrance", "Ngan2005", _NGAN, conventions.ngan_he),
        Fit("ngan_lafortune", "Lafortune", "Ngan2005", _NGAN, conventions.ngan_lafortune),
        Fit("ngan_wardduer", "WardDuer", "Ngan2005", _NGAN, conventions.ngan_ward_duer),
        Fit("ngan_ward", "Ward", "Ngan2005", _NGAN, conventions.ngan_ward),
        Fit("ngan_blinnphong", "BlinnPhong", "Ngan2005", _NGAN, conventions.ngan_blinn_phong),
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


providers.register(names, fits, get)
