"""The analytic models, one file each. The folder is the list: every model in it registers itself."""

from __future__ import annotations

import importlib
import pkgutil
from typing import Any

from ..errors import UnknownNameError
from ..reflectance import Reflectance
from .energy_compensated import EnergyCompensated
from .microfacet import Microfacet
from .model import REGISTRY, Model

for _module in pkgutil.iter_modules(__path__):
    importlib.import_module(f"{__name__}.{_module.name}")


WRAPPERS: dict[str, type[Reflectance]] = {"EnergyCompensated": EnergyCompensated}
"""What is put around a `Microfacet` model, by name."""


def names() -> list[str]:
    """The names of all models."""
    return sorted(REGISTRY)


def make(name: str, **given: Any) -> Reflectance:
    """The model of that name, in any case, or the wrapper around a `Microfacet`, with these parameters.

    Raises UnknownNameError, ParameterError.
    """
    for wrapper_name, wrapper in WRAPPERS.items():
        if name.lower() == wrapper_name.lower():
            return wrapper(Microfacet(**given))  # type: ignore[call-arg]
    return get(name)(**given)


def get(name: str) -> type[Model]:
    """The model of that name, in any case. Raises UnknownNameError."""
    by_lower = {known.lower(): model for known, model in REGISTRY.items()}
    if name.lower() not in by_lower:
        raise UnknownNameError("model", name, REGISTRY)
    return by_lower[name.lower()]


def __getattr__(name: str) -> Any:
    if name in REGISTRY:
        return REGISTRY[name]
    raise AttributeError(f"no model {name!r}; known: {', '.join(names())}")


__all__ = ["WRAPPERS", "EnergyCompensated", "Model", "get", "make", "names"]
