"""How the numbers of a table lie in memory and in files: plain, half precision, or packed 10 bits a channel.

`pack` makes codes from values; the codes are what is saved and what the table costs. `texels` makes from codes the
float32 texture that a formula samples, `value` (a formula) from a texel the encoded value.
"""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ..errors import UnknownNameError
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
        channels = values.reshape(-1, 3)
        low = channels.min(0).astype(np.float32).astype(np.float64)
        span = (channels.max(0) - low).astype(np.float32).astype(np.float64)
        share = (values - low) / np.where(span > 0, span, 1)
        levels = np.rint(np.clip(share, 0, 1) * self.LEVELS).astype(np.uint32)
        return levels[..., 0] | levels[..., 1] << 10 | levels[..., 2] << 20, {"low": low, "span": span}

    def texels(self, codes: NDArray[Any]) -> NDArray[np.float32]:
        if codes.dtype != np.uint32:
            raise ValueError(f"expected 32-bit words, got {codes.dtype}")
        levels = np.stack([codes >> shift & self.LEVELS for shift in (0, 10, 20)], -1)
        return levels.astype(np.float32) / np.float32(self.LEVELS)

    def value(self, texel: Vec, constants: Any) -> Vec:
        value: Vec = constants.low + constants.span * texel
        return value


STORAGES: dict[str, Storage] = {"float32": Floats(np.float32), "half": Floats(np.float16), "10-10-10": Packed10()}
"""Every storage by name."""


def storage(name: str) -> Storage:
    """The storage of that name. Raises UnknownNameError."""
    if name not in STORAGES:
        raise UnknownNameError("table storage", name, STORAGES)
    return STORAGES[name]
