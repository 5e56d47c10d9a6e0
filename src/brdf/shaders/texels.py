"""A formula's textures as a graphics card takes them: the fewest bits that hold the numbers exactly."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ReflectanceError

LARGEST = {2: 16384, 3: 2048}
"""Texels along an axis of a texture of two or three axes that common cards take."""


@dataclass(frozen=True)
class Image:
    """One texture: `size` in texels, x first; `texels` in the order of memory, x fastest."""

    name: str
    size: tuple[int, ...]
    kind: str
    """"8-bit", "10-bit", "half" or "float"."""
    channels: int
    """1, 2 or 4, in which three are kept."""
    texels: bytes

    @property
    def internal_format(self) -> str:
        """In OpenGL and WebGL2, without the prefix `GL_`."""
        names = {1: "R", 2: "RG", 4: "RGBA"}
        bits = {"8-bit": "8", "half": "16F", "float": "32F"}
        return "RGB10_A2" if self.kind == "10-bit" else names[self.channels] + bits[self.kind]

    @property
    def pixel_format(self) -> tuple[str, str]:
        """Format and type of the data in OpenGL and WebGL2."""
        types = {"8-bit": "UNSIGNED_BYTE", "10-bit": "UNSIGNED_INT_2_10_10_10_REV", "half": "HALF_FLOAT"}
        return {1: "RED", 2: "RG", 4: "RGBA"}[self.channels], types.get(self.kind, "FLOAT")

    @property
    def web_format(self) -> str:
        """In WebGPU."""
        names = {1: "r", 2: "rg", 4: "rgba"}
        bits = {"8-bit": "8unorm", "half": "16float", "float": "32float"}
        return "rgb10a2unorm" if self.kind == "10-bit" else names[self.channels] + bits[self.kind]


def images(data: NDArray[np.float32], names: Mapping[int, str], group: int) -> Iterator[Image]:
    """The textures that hold `group` channels each of (n1, …, nk, C) samples; `names` by number of the group.

    The last axis is x. Raises ReflectanceError for more texels along an axis than common cards take.
    """
    *axes, _ = data.shape
    size = (*reversed(axes), 1)[:2] if len(axes) < 3 else tuple(reversed(axes))
    if max(size) > LARGEST[len(size)]:
        raise ReflectanceError(
            f"a texture of {' x '.join(map(str, size))} texels does not fit graphics cards, which take "
            f"{LARGEST[len(size)]} along an axis; bake it smaller"
        )
    for number, name in names.items():
        part = data[..., number * group : (number + 1) * group]
        kind, numbers = _packed(part)
        yield Image(name, size, kind, 4 if part.shape[-1] == 3 else part.shape[-1], numbers.tobytes())


def _packed(part: NDArray[np.float32]) -> tuple[str, NDArray[Any]]:
    """Kind and numbers of samples of 1 to 4 channels, of which 3 become 4."""
    if part.shape[-1] == 3:
        part = np.concatenate([part, np.ones_like(part[..., :1])], -1)
        tens = _levels(part, 1023)
        if tens is not None and _levels(part, 255) is None:
            return "10-bit", tens[..., 0] | tens[..., 1] << 10 | tens[..., 2] << 20 | np.uint32(3 << 30)
    bytes_ = _levels(part, 255)
    if bytes_ is not None:
        return "8-bit", bytes_.astype(np.uint8)
    with np.errstate(over="ignore"):
        halves = part.astype(np.float16)
    return ("half", halves) if np.array_equal(halves, part) else ("float", part)


def _levels(part: NDArray[np.float32], most: int) -> NDArray[np.uint32] | None:
    """Whole numbers up to `most` that divided by it are the samples, if there are."""
    if part.min() < 0 or part.max() > 1:
        return None
    levels = np.rint(part * np.float32(most)).astype(np.uint32)
    return levels if np.array_equal(levels.astype(np.float32) / np.float32(most), part) else None
