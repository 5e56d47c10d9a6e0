"""Subsurface scattering as a function of distance: reflectance profiles R(r). One file each; each registers itself.

The bidirectional scattering-surface reflectance distribution function tells how light that enters a surface at one
point leaves it at another,

    S(x_i, wi; x_o, wo) = dL_o(x_o, wo) / dPhi_i(x_i, wi)      [1/(m2 sr)]

A profile is its radial part where light is scattered many times,

    S = 1/pi F_t(wi) R(|x_o - x_i|) F_t(wo),      R(r) = dM_o / dPhi_i      [1/mm2]

radiant exitance at a distance r per flux that enters at one point. The integral of R over the plane is the albedo of
the surface under even light, without its Fresnel boundary. The package draws profiles and does not render with them.
References: Jensen2001, Christensen2015.
"""

from __future__ import annotations

import importlib
import pkgutil

from ..errors import UnknownNameError
from .profile import REGISTRY, Profile

for _module in pkgutil.iter_modules(__path__):
    importlib.import_module(f"{__name__}.{_module.name}")


def names() -> list[str]:
    """The names of all profiles."""
    return sorted(REGISTRY)


def get(name: str) -> type[Profile]:
    """The profile of that name, in any case. Raises UnknownNameError."""
    if name.lower() not in REGISTRY:
        raise UnknownNameError("profile", name, REGISTRY)
    return REGISTRY[name.lower()]


__all__ = ["Profile", "get", "names"]
