"""Radiance pictures (.hdr, .pic): shared-exponent RGB, run-length coded or flat [Ward1991]."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import CorruptFileError
from .compiled import kernel

PROBLEMS = {
    1: "ends in the middle of its pixels.",
    2: "uses the oldest run-length code; save it anew with a current program.",
    3: "its run-length code does not add up.",
}

MAXIMUM_EXPANSION = 130
"""A run takes two bytes and yields at most 127: no honest file grows more than this when it is decoded."""


def read(path: str | os.PathLike[str]) -> NDArray[np.float32]:
    """(H, W, 3) linear RGB, top row first. Raises CorruptFileError."""
    content = Path(path).read_bytes()
    header, width, height, start = _header(path, content)
    if b"FORMAT=32-bit_rle_xyze" in header:
        raise CorruptFileError(path, "holds XYZ, not RGB; convert it with Radiance's ra_xyze -r.")
    body = np.frombuffer(bytearray(content[start:]), np.uint8)
    if width * height * 4 > max(len(body), 1) * MAXIMUM_EXPANSION:
        raise CorruptFileError(path, f"its header promises {width} x {height} pixels, more than the file can hold.")
    if len(body) == width * height * 4 and not _coded(body, width):
        rgbe = body.reshape(height, width, 4)
    else:
        rgbe = np.empty((height, width, 4), np.uint8)
        problem = _decode(body, rgbe)
        if problem:
            raise CorruptFileError(path, PROBLEMS[problem])
    scale = np.ldexp(np.float32(1), rgbe[..., 3].astype(np.int32) - 136)
    return np.where(rgbe[..., 3:] > 0, rgbe[..., :3] * scale[..., None], 0).astype(np.float32)


def _header(path: Any, content: bytes) -> tuple[bytes, int, int, int]:
    """Header lines, width, height, and where the pixels start."""
    end = content.find(b"\n\n", 0, 65536)
    if not content.startswith(b"#?") or end < 0:
        raise CorruptFileError(path, "is not a Radiance picture (#? and an empty line are missing).")
    size = re.match(rb"-Y (\d{1,9}) \+X (\d{1,9})\r?\n", content[end + 2 : end + 64])
    if size is None or not int(size[1]) * int(size[2]):
        raise CorruptFileError(path, "its size line is not of the form '-Y height +X width'.")
    return content[:end], int(size[2]), int(size[1]), end + 2 + size.end()


def _coded(body: NDArray[np.uint8], width: int) -> bool:
    """Whether pixels that fill their file exactly are run-length coded all the same."""
    starts_run = bytes(body[:4]) == bytes((2, 2, width >> 8 & 255, width & 255))
    return starts_run or bool((body.reshape(-1, 4)[:, :3] == 1).all(1).any())


@kernel("i8(u1[::1], u1[:,:,::1])")
def _decode(body: Any, rgbe: Any) -> int:
    """Fill the rows; 0, or the number of what is wrong."""
    height, width = rgbe.shape[:2]
    at, end = 0, len(body)
    for i in range(height):
        if at + 4 > end:
            return 1
        coded = 8 <= width < 32768 and body[at] == 2 and body[at + 1] == 2
        if not (coded and body[at + 2] == width >> 8 and body[at + 3] == width & 255):
            if at + 4 * width > end:
                return 1
            for j in range(width):
                if body[at] == 1 and body[at + 1] == 1 and body[at + 2] == 1:
                    return 2
                for c in range(4):
                    rgbe[i, j, c] = body[at + c]
                at += 4
            continue
        at += 4
        for c in range(4):
            filled = 0
            while filled < width:
                if at >= end:
                    return 1
                count = int(body[at])
                run = count > 128
                count -= 128 if run else 0
                step = 0 if run else 1
                if count == 0 or count > width - filled:
                    return 3
                if at + 1 + step * (count - 1) >= end:
                    return 1
                for k in range(count):
                    rgbe[i, filled + k, c] = body[at + 1 + step * k]
                filled += count
                at += 2 if run else 1 + count
    return 0
