"""The container of bytes that carries everything a page shows: one JSON text, and a blob that it points into."""

from __future__ import annotations

import json
import math
import struct
import zlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

HIGHEST_ORDER = 3
"""Of differences: smooth surfaces leave nothing behind the third."""


class Blob:
    """Bytes, to which parts are added; each starts at a multiple of 4."""

    def __init__(self) -> None:
        self._parts: list[bytes] = []
        self._size = 0

    def add(self, data: bytes) -> dict[str, int]:
        """Where the part lies: {"offset", "bytes"}."""
        place = {"offset": self._size, "bytes": len(data)}
        self._parts.append(data + b"\0" * (-len(data) % 4))
        self._size += len(self._parts[-1])
        return place

    def add_numbers(self, numbers: NDArray[np.integer[Any]], bits: int) -> dict[str, int]:
        """Rows of whole numbers (N, C) in [0, 2^bits), written so that they compress well; `bits`: 8, 16 or 32.

        Each column is replaced by its differences, `order` times over, modulo 2^bits, with the sign in the lowest bit
        (0, -1, 1, -2, … become 0, 1, 2, 3, …). Of these the lowest bytes of all rows stand first, column by column,
        then the next higher bytes. The order is the one that compresses best.
        """
        rows, columns = numbers.shape
        difference = numbers.astype(np.int64)
        candidates = [_planes(difference, bits)]
        for _ in range(HIGHEST_ORDER):
            difference = np.diff(difference, axis=0, prepend=0)
            candidates.append(_planes(difference, bits))
        sizes = [len(zlib.compress(planes, 1)) for planes in candidates]
        order = sizes.index(min(sizes))
        return self.add(candidates[order]) | {"rows": rows, "columns": columns, "bits": bits, "order": order}

    def joined(self) -> bytes:
        return b"".join(self._parts)


def _planes(difference: NDArray[np.int64], bits: int) -> bytes:
    half = 1 << (bits - 1)
    signed = (difference + half) % (2 * half) - half
    folded = np.where(signed < 0, -2 * signed - 1, 2 * signed).T
    return b"".join((folded >> shift & 255).astype(np.uint8).tobytes() for shift in range(0, bits, 8))


def container(description: dict[str, Any], blob: Blob) -> bytes:
    """Length of the JSON (uint32, little endian), the JSON, padding to 4 bytes, the blob."""
    text = json.dumps(_plain(description), ensure_ascii=False, allow_nan=False, separators=(",", ":")).encode()
    return struct.pack("<I", len(text)) + text + b"\0" * (-len(text) % 4) + blob.joined()


def _plain(data: Any) -> Any:
    """Without infinities, which JSON has none of: they become null."""
    if isinstance(data, dict):
        return {key: _plain(value) for key, value in data.items()}
    if isinstance(data, (list, tuple)):
        return [_plain(value) for value in data]
    return None if isinstance(data, float) and not math.isfinite(data) else data
