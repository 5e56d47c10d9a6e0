"""How the numbers of tables and pictures lie in memory and in files: plain, half precision, or packed in a few bits.

`pack` makes codes from values; the codes are what is saved and what the table costs. `texels` makes from codes the
float32 texture that a formula samples, `value` (a formula) from a texel the encoded value.
"""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ..color import srgb_decode, srgb_encode
from ..errors import ParameterError, UnknownNameError
from ..formula import Vec

Constants = dict[str, NDArray[np.float64]]


class Storage(Protocol):
    """A way to store (..., 3) values."""

    constants: tuple[str, ...]
    """Names of the constants it needs."""

    def pack(self, values: NDArray[Any]) -> tuple[NDArray[Any], Constants]:
        """(..., 3) values -> codes, and (3,) constants by name that unpacking needs."""
        ...

    def texels(self, codes: NDArray[Any]) -> NDArray[np.float32]:
        """Codes -> (..., 3) texels. Raises ValueError for codes of another storage."""
        ...

    def value(self, texel: Vec, constants: Any) -> Vec:
        """The formula: the stored value of a texel; `constants` has the constants as attributes."""
        ...


class Floats:
    """Floating-point numbers of one type, as they are."""

    constants: tuple[str, ...] = ()

    def __init__(self, dtype: type[np.floating[Any]]) -> None:
        self._dtype = np.dtype(dtype)

    def pack(self, values: NDArray[Any]) -> tuple[NDArray[Any], Constants]:
        largest = float(np.finfo(self._dtype).max)
        if self._dtype.itemsize < values.dtype.itemsize:
            values = np.clip(values, -largest, largest)
        return np.ascontiguousarray(values, self._dtype), {}

    def texels(self, codes: NDArray[Any]) -> NDArray[np.float32]:
        if codes.dtype != self._dtype or codes.shape[-1] != 3:
            raise ValueError(f"expected (..., 3) {self._dtype} codes, got {codes.shape} {codes.dtype}")
        return np.asarray(codes, np.float32)

    def value(self, texel: Vec, constants: Any) -> Vec:
        return texel


class Packed10:
    """Three channels of 10 bits in one 32-bit word (red in the lowest bits), spread over each channel's range.

    The word is OpenGL's UNSIGNED_INT_2_10_10_10_REV, so that codes upload as an RGB10_A2 texture.
    """

    constants: tuple[str, ...] = ("low", "span")
    LEVELS = 1023

    def pack(self, values: NDArray[Any]) -> tuple[NDArray[Any], Constants]:
        levels, constants = _spread(values, self.LEVELS)
        return levels[..., 0] | levels[..., 1] << 10 | levels[..., 2] << 20, constants

    def texels(self, codes: NDArray[Any]) -> NDArray[np.float32]:
        _require_words(codes)
        levels = np.stack([codes >> shift & self.LEVELS for shift in (0, 10, 20)], -1)
        return levels.astype(np.float32) / np.float32(self.LEVELS)

    def value(self, texel: Vec, constants: Any) -> Vec:
        value: Vec = constants.low + constants.span * texel
        return value


class Bytes:
    """8 bits a channel, spread over each channel's range."""

    constants: tuple[str, ...] = ("low", "span")
    LEVELS = 255

    def pack(self, values: NDArray[Any]) -> tuple[NDArray[Any], Constants]:
        levels, constants = _spread(values, self.LEVELS)
        return levels.astype(np.uint8), constants

    def texels(self, codes: NDArray[Any]) -> NDArray[np.float32]:
        _require_bytes(codes)
        return codes.astype(np.float32) / np.float32(self.LEVELS)

    def value(self, texel: Vec, constants: Any) -> Vec:
        value: Vec = constants.low + constants.span * texel
        return value


class SharedExponent:
    """Three channels of 9 bits and the exponent of the largest, 5 bits, in one 32-bit word (red in the lowest bits).

    For values from 0 to 65408; larger ones become that. Off by at most 2^-9 of the largest channel, or 2^-25. The
    word is OpenGL's UNSIGNED_INT_5_9_9_9_REV, an RGB9_E5 texture (EXT_texture_shared_exponent).
    """

    constants: tuple[str, ...] = ()
    BITS, BIAS, LARGEST = 9, 15, 65408.0

    def pack(self, values: NDArray[Any]) -> tuple[NDArray[Any], Constants]:
        _refuse_negative(values, "rgb9e5")
        channels = np.minimum(np.asarray(values, np.float64), self.LARGEST)
        largest = channels.max(-1)
        exponent = np.where(
            largest > 0, np.maximum(np.frexp(largest)[1], -self.BIAS), -self.BIAS
        )  # largest < 2^exponent
        mantissa = np.rint(np.ldexp(largest, self.BITS - exponent))
        exponent += mantissa >= 1 << self.BITS  # it rounded up to the next power of two
        levels = np.rint(np.ldexp(channels, (self.BITS - exponent)[..., None])).astype(np.uint32)
        shared = (exponent + self.BIAS).astype(np.uint32)
        return levels[..., 0] | levels[..., 1] << 9 | levels[..., 2] << 18 | shared << 27, {}

    def texels(self, codes: NDArray[Any]) -> NDArray[np.float32]:
        _require_words(codes)
        levels = np.stack([codes >> shift & 511 for shift in (0, 9, 18)], -1).astype(np.float32)
        exponent = (codes >> 27).astype(np.int32) - (self.BIAS + self.BITS)
        return np.asarray(np.ldexp(levels, exponent[..., None]), np.float32)

    def value(self, texel: Vec, constants: Any) -> Vec:
        return texel


class StandardBytes:
    """8 bits a channel on the sRGB curve, for values from 0 to 1; larger ones become 1. As an sRGB texture is filtered,
    texels are decoded before they are interpolated."""

    constants: tuple[str, ...] = ()

    def pack(self, values: NDArray[Any]) -> tuple[NDArray[Any], Constants]:
        _refuse_negative(values, "srgb8")
        return np.rint(srgb_encode(values) * 255).astype(np.uint8), {}

    def texels(self, codes: NDArray[Any]) -> NDArray[np.float32]:
        _require_bytes(codes)
        decoded: NDArray[np.float32] = np.asarray(srgb_decode(np.arange(256) / 255), np.float32)[codes]
        return decoded

    def value(self, texel: Vec, constants: Any) -> Vec:
        return texel


def _spread(values: NDArray[Any], levels: int) -> tuple[NDArray[np.uint32], Constants]:
    """(..., 3) values as whole numbers up to `levels` over each channel's range, with its low end and its span."""
    channels = values.reshape(-1, 3)
    low = channels.min(0).astype(np.float32).astype(np.float64)
    span = (channels.max(0) - low).astype(np.float32).astype(np.float64)
    share = (values - low) / np.where(span > 0, span, 1)
    return np.rint(np.clip(share, 0, 1) * levels).astype(np.uint32), {"low": low, "span": span}


def _refuse_negative(values: NDArray[Any], name: str) -> None:
    if not np.all(values >= 0):
        raise ParameterError(
            f"storage {name!r} holds no negative numbers, and the least here is {np.min(values):.3g}; "
            "choose half, 10-10-10 or 8-8-8"
        )


def _require_words(codes: NDArray[Any]) -> None:
    if codes.dtype != np.uint32:
        raise ValueError(f"expected 32-bit words, got {codes.dtype}")


def _require_bytes(codes: NDArray[Any]) -> None:
    if codes.dtype != np.uint8 or codes.shape[-1:] != (3,):
        raise ValueError(f"expected (..., 3) bytes, got {codes.shape} {codes.dtype}")


STORAGES: dict[str, Storage] = {
    "float32": Floats(np.float32),
    "half": Floats(np.float16),
    "10-10-10": Packed10(),
    "8-8-8": Bytes(),
    "rgb9e5": SharedExponent(),
    "srgb8": StandardBytes(),
}
"""Every storage by name."""

UNSIGNED = ("rgb9e5", "srgb8")
"""Storages that refuse negative numbers."""


def storage(name: str) -> Storage:
    """The storage of that name. Raises UnknownNameError."""
    if name not in STORAGES:
        raise UnknownNameError("storage", name, STORAGES)
    return STORAGES[name]
