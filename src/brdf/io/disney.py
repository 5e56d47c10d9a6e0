"""Parameter blocks of the Disney BRDF Explorer: the head of an analytic `.brdf`.

    analytic
    ::begin parameters
    float roughness 0 1 .5         # type, name, least, largest, default
    color baseColor .82 .67 .16
    ::end parameters

The shader that follows is not read: the model is told by the names of its parameters, and made with their defaults.
Source: github.com/wdas/brdf, src/brdfs.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from ..combinators import add, scaled
from ..errors import BrdfError, CorruptFileError
from ..models import get as model
from ..reflectance import Reflectance
from .registry import Format
from .text import lines, numbers

COUNTS = {"float": 3, "color": 3, "bool": 1}
"""How many numbers follow a name."""

MOST_PARAMETERS = 200


def recognises(head: bytes, size: int) -> bool:
    """By its first word and the block of parameters."""
    return head.lstrip()[:8] == b"analytic" and b"::begin parameters" in head


def read(path: Path) -> Reflectance:
    """The model with the file's defaults. Raises CorruptFileError."""
    given = read_parameters(path)
    for names, make in MODELS.items():
        if given.keys() == set(names.split()):
            try:
                return make(given).named(path.stem, f"parameters of {path.name}")
            except BrdfError as error:
                raise CorruptFileError(path, f"{error}.") from None
    known = "; ".join(MODELS)
    listed = " ".join(given)[:80]
    raise CorruptFileError(path, f"is a model of its own, with {listed or 'no parameters'}; known are {known}.")


def read_parameters(path: Path) -> dict[str, Any]:
    """Defaults by name: numbers, or three for a colour. Raises CorruptFileError, which names the line."""
    content = lines(path)
    given: dict[str, Any] = {}
    inside = False
    for number, line in content:
        if line.startswith("::"):
            inside = line == "::begin parameters"
            if line == "::end parameters":
                return given
        elif inside:
            kind, *words = line.split()
            name = words.pop(0) if words else ""
            if kind not in COUNTS or not name.isidentifier() or len(words) != COUNTS[kind]:
                raise CorruptFileError(path, f"line {number} is no parameter: {line[:40]!r}.")
            values = numbers(path, number, words)
            given[name] = tuple(values) if kind == "color" else values[-1]
            if len(given) > MOST_PARAMETERS:
                raise CorruptFileError(path, f"has more than {MOST_PARAMETERS} parameters.")
    raise CorruptFileError(path, "its block of parameters does not end.")


def _disney(given: dict[str, Any]) -> Reflectance:
    """As published from 2014 on; colours are stored as shown on a screen of gamma 2.2."""
    row = {_snake(name): value for name, value in given.items()}
    row["base_color"] = np.clip(row["base_color"], 0, None) ** 2.2
    return model("Disney")(**row, masking="2014")


def _walter(given: dict[str, Any]) -> Reflectance:
    lobe = {"alpha": given["alphaG"], "masking": "smith-separable"}
    if given["useFresnel"]:
        lobe |= {"fresnel": "dielectric", "eta": given["ior"]}
    else:
        lobe |= {"fresnel": "schlick", "F0": 1.0}
    return add(model("Lambertian")(albedo=given["Kd"]), scaled(model("Microfacet")(**lobe), given["Ks"]))


def _snake(name: str) -> str:
    return "".join(f"_{c.lower()}" if c.isupper() else c for c in name)


MODELS: dict[str, Callable[[dict[str, Any]], Reflectance]] = {
    "baseColor metallic subsurface specular roughness specularTint anisotropic sheen sheenTint clearcoat "
    "clearcoatGloss": _disney,
    "reflectance": lambda given: model("Lambertian")(albedo=given["reflectance"]),
    "k": lambda given: model("Minnaert")(k=given["k"], albedo=(given["k"] + 1) / 2),
    "rho sigma": lambda given: model("OrenNayarFull")(albedo=given["rho"], sigma=math.radians(given["sigma"])),
    "Kd Ks alphaG ior useFresnel": _walter,
}
"""How a model is made, by the names of its parameters."""


FORMAT = Format(
    "Disney BRDF Explorer",
    (".brdf",),
    "parameters of an analytic model: principled, Lambert, Minnaert, Oren-Nayar, Walter",
    recognises,
    read,
)
