"""Tables of fits of the BSDF benchmark library, `.fit`: one material a line.

    NAME = Aggregate(Lambertian(albedo = [r, g, b]), Model(parameter = value, ...))

"#" starts a comment. Read are the models of the published fits to the MERL materials, by what their parameters mean
there (`bbm_conventions`), and Lambertian alone. Source: github.com/bsdfbenchmark/bbm at 9807fb3, folder fits.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from ..errors import BrdfError, CorruptFileError
from ..models import get as model
from ..reflectance import Reflectance
from . import bbm_conventions as conventions
from .registry import Format
from .text import lines

MODELS: dict[str, Callable[[conventions.Row], Reflectance]] = {
    "Bagher": conventions.sgd,
    "LowAshikhminShirley": conventions.low_ashikhmin_shirley,
    "LowCookTorrance": conventions.low_cook_torrance,
    "LowMicrofacetFit": conventions.low_microfacet,
    "LowSmooth": conventions.low_smooth,
    "NganAshikhminShirley": conventions.ngan_ashikhmin_shirley,
    "NganBlinnPhong": conventions.ngan_blinn_phong,
    "NganCookTorrance": conventions.ngan_cook_torrance,
    "NganHe": conventions.ngan_he,
    "NganLafortune": conventions.ngan_lafortune,
    "NganWard": conventions.ngan_ward,
    "NganWardDuer": conventions.ngan_ward_duer,
}
"""The reflectance of a row, by the lobe's name in the file."""

LONGEST = 4096
"""Characters of a row."""

_TOKEN = re.compile(r"\s*(?:([A-Za-z_]\w*)|([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)|([()\[\],=]))")
_ROW = re.compile(r"([^\s=]+)\s*=\s*(.*)")
_DEEPEST = 4
"""Brackets within brackets."""


def recognises(head: bytes, size: int) -> bool:
    """The first line beside comments names a material and calls a model."""
    contents = (line.partition(b"#")[0].strip() for line in head.splitlines())
    first = next((line for line in contents if line), b"")
    return re.match(rb"[^\s=]+ *= *(Aggregate|Lambertian)\(", first) is not None


def members(path: Path) -> dict[str, Callable[[], Reflectance]]:
    """How each material of the file is made, by name. Raises CorruptFileError, which names the line."""
    rows: dict[str, Callable[[], Reflectance]] = {}
    for number, line in lines(path):
        match = _ROW.fullmatch(line)
        if match is None or len(line) > LONGEST:
            raise CorruptFileError(path, f"line {number} is no NAME = Model(...): {line[:40]!r}.")
        rows[match[1]] = functools.partial(_made, path, number, match[1], match[2])
    if not rows:
        raise CorruptFileError(path, "holds no material.")
    return rows


def _made(path: Path, number: int, name: str, text: str) -> Reflectance:
    """One row as a reflectance. Raises CorruptFileError."""
    try:
        diffuse, lobe = _lobes(parsed(text))
        if lobe is None:
            made: Reflectance = model("Lambertian")(albedo=diffuse["albedo"])
        else:
            kind, row = lobe
            if kind not in MODELS:
                raise ValueError(f"the model {kind} is not read; read are {', '.join(MODELS)}")
            made = MODELS[kind]({**row, "kd": diffuse["albedo"]})
    except KeyError as missing:
        raise CorruptFileError(path, f"line {number}: parameter {missing} is missing.") from None
    except (BrdfError, ValueError, TypeError, IndexError, OverflowError, ZeroDivisionError) as error:
        raise CorruptFileError(path, f"line {number}: {error}.") from None
    return made.named(name, f"{path.name}, line {number}")


Call = tuple[str, dict[str, Any], list[Any]]
"""A model: its name, its parameters, and the models it is made of."""


def _lobes(call: Any) -> tuple[dict[str, Any], tuple[str, dict[str, Any]] | None]:
    """Parameters of the diffuse part; name and parameters of the other."""
    name, row, parts = call if isinstance(call, tuple) else ("", {}, [])
    if name == "Lambertian":
        return row, None
    if name != "Aggregate" or [p[0] for p in parts if isinstance(p, tuple)][:1] != ["Lambertian"] or len(parts) != 2:
        raise ValueError("a row must be Aggregate(Lambertian(...), Model(...)) or Lambertian(...)")
    kind, parameters, _ = parts[1] if isinstance(parts[1], tuple) else ("", {}, [])
    return parts[0][1], (kind, parameters)


def parsed(text: str) -> Any:
    """A call, a list or a number. Raises ValueError."""
    tokens = _tokens(text)
    value = _value(tokens, next(tokens), 0)
    if next(tokens) != "":
        raise ValueError("something follows the last bracket")
    return value


def _tokens(text: str) -> Iterator[str]:
    place = 0
    text = text.rstrip()
    while place < len(text):
        match = _TOKEN.match(text, place)
        if match is None:
            raise ValueError(f"{text[place : place + 20]!r} is not understood")
        yield match[0].strip()
        place = match.end()
    while True:
        yield ""


def _value(tokens: Iterator[str], token: str, depth: int) -> Any:
    if depth > _DEEPEST:
        raise ValueError(f"brackets are nested more than {_DEEPEST} deep")
    if token == "[":
        return _listed(tokens, depth)
    if token.isidentifier():
        if next(tokens) != "(":
            raise ValueError(f"{token} must be followed by a bracket")
        return _call(tokens, token, depth)
    if not token or token in "()],=":
        raise ValueError("a number, a list or a model is missing")
    return float(token)


def _listed(tokens: Iterator[str], depth: int) -> list[Any]:
    values = [_value(tokens, next(tokens), depth + 1)]
    while (token := next(tokens)) == ",":
        values.append(_value(tokens, next(tokens), depth + 1))
    if token != "]":
        raise ValueError("a list is not closed")
    return values


def _call(tokens: Iterator[str], name: str, depth: int) -> Call:
    row: dict[str, Any] = {}
    parts: list[Any] = []
    separator = ","
    while separator == ",":
        key = next(tokens)
        after = next(tokens)
        if after == "=":
            row[key] = _value(tokens, next(tokens), depth + 1)
        elif after == "(" and key.isidentifier():
            parts.append(_call(tokens, key, depth + 1) if depth < _DEEPEST else _value(tokens, key, depth + 1))
        else:
            raise ValueError(f"{name}(...) must hold parameters and models")
        separator = next(tokens)
    if separator != ")":
        raise ValueError(f"{name}(...) is not closed")
    return name, row, parts


FORMAT = Format(
    "BSDF benchmark fits",
    (".fit",),
    "published fits, one material a line; take one with PATH@NAME",
    recognises,
    members=members,
)
