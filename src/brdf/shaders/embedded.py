"""The shader inside a saved file, so that a page without Python can draw it.

The header's entry "shader" is JSON, compressed by gzip and in base64: `text` (what `stages.material` gives, GLSL),
`description`, and what a viewer says about the material, `nbytes` and `isotropic`. Texels are not stored twice: each
texture of the description says under "stored" which of the file's tensors holds its numbers,

    tensor            its name; float64 becomes float32
    first, channels   those of its channels (all axes behind the texture's own) that are taken; 3 become 4, the last 1
    packing           of a tensor without channels: "words", 10 bits a channel, red in the lowest; "rgb9e5", 9 bits a
                      channel and 5 of an exponent above
    levels            name of a tensor (256, channels): the number that each byte stands for, in its channel

Tensors that are there for the shader alone are called `shader.…`; readers of the reflectance ignore them.
"""

from __future__ import annotations

import base64
import gzip
import json
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..errors import BrdfError
from .shader import shader_of
from .stages import material

if TYPE_CHECKING:
    from ..reflectance import Reflectance

Arrays = Mapping[str, NDArray[Any]]

PREFIX = "shader."
"""Of the tensors that are there for the shader alone."""

_MOST_ADDED = 1 << 16
"""Bytes that such tensors may have in a file however small; else no more than the file's own."""

_CHANNELS = {"RED": 1, "RG": 2, "RGBA": 4}
_FLOATS = {"<f2": ("16F", "HALF_FLOAT"), "<f4": ("32F", "FLOAT"), "<f8": ("32F", "FLOAT")}
"""Bits and type of the texture that holds a tensor of floats."""
_NAMES = {1: ("R", "RED"), 2: ("RG", "RG"), 3: ("RGBA", "RGBA"), 4: ("RGBA", "RGBA")}


def embedded(m: Reflectance, arrays: Arrays) -> tuple[str, dict[str, NDArray[Any]]] | None:
    """The header's entry for a file of `arrays`, and the tensors to add to it; None for what cannot be printed, or
    would make the file more than twice as large."""
    try:
        shader = shader_of(m)
    except BrdfError:
        return None
    added: dict[str, NDArray[Any]] = {}
    textures = []
    for texture in shader.description["textures"]:
        numbers = _numbers(texture, shader.texels)
        found = next(_sources(numbers, arrays, texture["uniform"]), None)
        source, extra = found or _alone(numbers, texture["uniform"])
        added |= extra
        kept = {key: texture[key] for key in ("uniform", "target", "size")}
        textures.append(kept | source)
    if sum(a.nbytes for a in added.values()) > max(_MOST_ADDED, sum(a.nbytes for a in arrays.values())):
        return None
    described = shader.description | {"textures": textures}
    entry = {"text": material(shader), "description": described, "nbytes": m.nbytes, "isotropic": m.isotropic}
    packed = gzip.compress(json.dumps(entry, separators=(",", ":")).encode(), 9, mtime=0)
    return base64.b64encode(packed).decode(), added


def _numbers(texture: Mapping[str, Any], texels: bytes) -> NDArray[np.float32]:
    """(P, channels) what a texture's texels stand for; a fourth channel of ones left out."""
    part = texels[texture["offset"] : texture["offset"] + texture["bytes"]]
    match texture["type"]:
        case "UNSIGNED_INT_2_10_10_10_REV":
            return _words(np.frombuffer(part, "<u4"))
        case "UNSIGNED_BYTE":
            flat = np.asarray(np.frombuffer(part, np.uint8) / np.float32(255), np.float32)
        case kind:
            flat = np.frombuffer(part, "<f2" if kind == "HALF_FLOAT" else "<f4").astype(np.float32)
    numbers = flat.reshape(-1, _CHANNELS[texture["format"]])
    return numbers[:, :3] if numbers.shape[1] == 4 and (numbers[:, 3] == 1).all() else numbers


def _words(words: NDArray[np.uint32]) -> NDArray[np.float32]:
    levels: NDArray[Any] = np.stack([words >> shift & 1023 for shift in (0, 10, 20)], -1).astype(np.float32)
    return np.asarray(levels / np.float32(1023), np.float32)


def _shared_exponent(words: NDArray[np.uint32]) -> NDArray[np.float32]:
    levels = np.stack([words >> shift & 511 for shift in (0, 9, 18)], -1).astype(np.float32)
    return np.asarray(np.ldexp(levels, ((words >> 27).astype(np.int32) - 24)[:, None]), np.float32)


def _pixels(channels: int, bits: str, kind: str) -> dict[str, str]:
    """The texture's part of a source."""
    name, pixel_format = _NAMES[channels]
    return {"internal_format": name + bits, "format": pixel_format, "type": kind}


_Source = tuple[dict[str, Any], dict[str, NDArray[Any]]]


def _sources(numbers: NDArray[np.float32], arrays: Arrays, uniform: str) -> Iterator[_Source]:
    """Where the numbers (P, c) of a texture stand among the arrays, and tensors to add for that; exactly or not."""
    pixels, channels = numbers.shape
    for name, array in arrays.items():
        if array.dtype == np.uint32 and array.size == pixels and channels == 3:
            words = array.ravel()
            if np.array_equal(_words(words), numbers):
                stored: dict[str, Any] = {"tensor": name, "packing": "words"}
                kind = {"internal_format": "RGB10_A2", "format": "RGBA", "type": "UNSIGNED_INT_2_10_10_10_REV"}
                yield kind | {"stored": stored}, {}
            if np.array_equal(_shared_exponent(words), numbers):
                yield _pixels(3, "32F", "FLOAT") | {"stored": {"tensor": name, "packing": "rgb9e5"}}, {}
            continue
        if not array.size or array.size % pixels or (array.size != pixels and array.ndim < 2):
            continue
        table = array.reshape(pixels, -1)
        for first in range(0, table.shape[1] - channels + 1, channels):
            part = table[:, first : first + channels]
            stored = {"tensor": name, "first": first, "channels": channels}
            if array.dtype.str in _FLOATS:
                if np.array_equal(part.astype(np.float32), numbers):
                    yield _pixels(channels, *_FLOATS[array.dtype.str]) | {"stored": stored}, {}
            elif array.dtype == np.uint8:
                if np.array_equal(part / np.float32(255), numbers):
                    yield _pixels(channels, "8", "UNSIGNED_BYTE") | {"stored": stored}, {}
                levels = np.zeros((256, channels), np.float32)
                each = np.arange(channels)
                levels[part, each] = numbers
                if np.array_equal(levels[part, each], numbers) and levels.nbytes < numbers.nbytes:
                    extra = f"{PREFIX}{uniform}.levels"
                    source = _pixels(channels, "32F", "FLOAT") | {"stored": stored | {"levels": extra}}
                    yield source, {extra: levels}


def _alone(numbers: NDArray[np.float32], uniform: str) -> _Source:
    """The numbers as a tensor of their own."""
    with np.errstate(over="ignore"):
        halves = numbers.astype(np.float16)
    tensor = halves if np.array_equal(halves, numbers) else numbers
    name = PREFIX + uniform
    channels = numbers.shape[1]
    stored = {"tensor": name, "first": 0, "channels": channels}
    return _pixels(channels, *_FLOATS[tensor.dtype.str]) | {"stored": stored}, {name: tensor}
