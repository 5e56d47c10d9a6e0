"""PNG of 16 bits a channel, which Pillow reads with 8. Reference: the PNG specification (ISO/IEC 15948)."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import CorruptFileError

SIGNATURE = b"\x89PNG\r\n\x1a\n"
CHANNELS = {0: 1, 2: 3, 4: 2, 6: 4}
"""By colour type: gray, RGB, gray and alpha, RGB and alpha."""


def is_deep(path: Path) -> bool:
    """Whether the file is a PNG of 16 bits a channel."""
    with path.open("rb") as file:
        head = file.read(25)
    return head.startswith(SIGNATURE) and len(head) == 25 and head[24] == 16


def read_deep(path: Path) -> NDArray[np.uint16]:
    """(H, W, channels) of a PNG of 16 bits a channel, top row first. Raises CorruptFileError."""
    content = path.read_bytes()
    chunks = list(_chunks(content))
    if not chunks or chunks[0][0] != b"IHDR" or len(chunks[0][1]) != 13:
        raise CorruptFileError(path, "has no PNG header; save it again.")
    width, height, bits, colour, _, _, interlaced = struct.unpack(">IIBBBBB", chunks[0][1])
    if bits != 16 or colour not in CHANNELS:
        raise CorruptFileError(path, f"is no PNG of 16 bits a channel ({bits} bits, colour type {colour}).")
    if interlaced:
        raise CorruptFileError(path, "is interlaced; save it without interlacing.")
    step = 2 * CHANNELS[colour]
    expected = height * (1 + width * step)
    packed = b"".join(data for kind, data in chunks if kind == b"IDAT")
    # deflate packs 1032 to 1 at best: a header that promises more than the data can hold is refused before unpacking
    if not 0 < expected <= 1032 * len(packed) + 1032:
        raise CorruptFileError(path, f"its header promises {width} x {height} pixels, more than the file can hold.")
    try:
        unpacker = zlib.decompressobj()
        raw = unpacker.decompress(packed, expected)
    except zlib.error as error:
        raise CorruptFileError(path, f"its pixels cannot be unpacked ({error}); copy or save it again.") from None
    if len(raw) != expected:
        raise CorruptFileError(path, "ends in the middle of its pixels; copy or save it again.")
    from .png_filters import unfilter

    rows = np.frombuffer(raw, np.uint8).reshape(height, -1)
    filters, pixels = np.ascontiguousarray(rows[:, 0]), np.ascontiguousarray(rows[:, 1:])
    if filters.max() > 4:
        raise CorruptFileError(path, f"uses the unknown row filter {filters.max()}; save it again.")
    unfilter(filters, pixels, step)
    return pixels.view(">u2").reshape(height, width, -1).astype(np.uint16)


def _chunks(content: bytes) -> Iterator[tuple[bytes, bytes]]:
    """(kind, data) of each chunk up to the end or to the first that is cut off."""
    at = len(SIGNATURE)
    while at + 12 <= len(content):
        (size,) = struct.unpack_from(">I", content, at)
        if at + 12 + size > len(content):
            return
        yield content[at + 4 : at + 8], content[at + 8 : at + 8 + size]
        at += 12 + size
