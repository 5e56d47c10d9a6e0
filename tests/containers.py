"""The container of a page, read again: what the browser's reader does, in NumPy."""

from __future__ import annotations

import json
import struct
from typing import Any

import numpy as np
from numpy.typing import NDArray


def read(data: bytes) -> tuple[dict[str, Any], bytes]:
    """The description and the blob."""
    (size,) = struct.unpack_from("<I", data)
    assert len(data) % 4 == 0
    return json.loads(data[4 : 4 + size]), data[4 + size + -size % 4 :]


def numbers(place: dict[str, int], blob: bytes) -> NDArray[np.int64]:
    """(rows, columns) whole numbers."""
    rows, columns, bits = place["rows"], place["columns"], place["bits"]
    part = blob[place["offset"] : place["offset"] + place["bytes"]]
    planes = np.frombuffer(part, np.uint8).reshape(bits // 8, columns, rows).astype(np.int64)
    folded = sum(plane << 8 * k for k, plane in enumerate(planes))
    value = np.where(folded & 1, -(folded + 1 >> 1), folded >> 1).T
    for _ in range(place["order"]):
        value = np.cumsum(value, 0)
    return value % (1 << bits)
