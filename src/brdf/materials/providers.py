"""Where shipped materials come from: each provider registers itself and is asked by name."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ..errors import UnknownNameError
from ..reflectance import Reflectance


@dataclass(frozen=True)
class Provider:
    """A source of materials: their names, the variants of each (the preferred one first), and how one is made."""

    names: Callable[[], list[str]]
    fits: Callable[[str], list[str]]
    get: Callable[[str, str | None], Reflectance]


REGISTRY: list[Provider] = []


def register(
    names: Callable[[], list[str]], fits: Callable[[str], list[str]], get: Callable[[str, str | None], Reflectance]
) -> None:
    """Enter a provider. `get` takes a name of its own and one of its variants or None."""
    REGISTRY.append(Provider(names, fits, get))


def names() -> list[str]:
    """The names of the shipped materials, sorted."""
    return sorted(name for provider in REGISTRY for name in provider.names())


def fits(name: str) -> list[str]:
    """The published fits or the variants of a material, the preferred one first. Raises UnknownNameError."""
    return _provider(name).fits(name)


def get(name: str, fit: str | None = None) -> Reflectance:
    """A material by name; a particular fit as `NAME@FIT` or by `fit`, else the preferred one.

    Its `name` is the material's, with `@FIT` where one was asked for; its `source` tells where it comes from. Raises
    UnknownNameError.
    """
    name, at, after = name.partition("@")
    wanted = after if at else fit
    made = _provider(name).get(name, wanted)
    return made if wanted is None else made.named(f"{name}@{wanted}")


def _provider(name: str) -> Provider:
    for provider in REGISTRY:
        if name in provider.names():
            return provider
    raise UnknownNameError("material", name, names(), "see `brdf list materials`")
