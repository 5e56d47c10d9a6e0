"""Light from all around: an equirectangular picture of radiance, sampled by its brightness.

Orientation: +y is up, row 0 the top. The middle column is the direction -z, which the default camera looks along; seen
from inside, columns run to the right, so the column at 3/4 of the width is +x and the outer columns meet at +z.
"""

from __future__ import annotations

import copy
import os
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import inputs
from ..errors import CorruptFileError, FileError, SceneError, UnknownNameError
from . import radiance_file
from .compiled import in_parallel

Floats = NDArray[np.float32]

LUMINANCE = np.array([0.2126, 0.7152, 0.0722], np.float32)
BUILT_IN = ("studio",)
MAXIMUM_WIDTH = 4096
"""Pictures wider than this are averaged down when they are loaded: nothing rendered here resolves more."""


class Environment:
    """Distant light, (H, W, 3) radiance over the sphere of directions, times `scale`, turned by `rotation` degrees.

    A positive rotation carries the light from +z towards +x, as `phi` of a light does. `radiance(directions)` and
    `sample(u)` agree with each other: both mean the bilinear interpolation of the picture.
    Raises SceneError for a picture that is no light (negative, not finite, black, wrong shape).
    """

    def __init__(self, pixels: ArrayLike, scale: float = 1.0, rotation: float = 0.0, name: str = "environment") -> None:
        with np.errstate(over="ignore"):  # what does not fit becomes infinite, and is refused below
            pixels = np.asarray(pixels, np.float32)
        if pixels.ndim != 3 or pixels.shape[2] != 3 or not pixels.size:
            raise SceneError(f"{name}: an environment must have shape (height, width, 3), got {pixels.shape}")
        if not np.isfinite(pixels).all():
            raise SceneError(f"{name}: has pixels that are not finite; repair the picture first")
        if (pixels < 0).any():
            raise SceneError(f"{name}: has pixels below zero, which no light has; clip the picture first")
        if not (np.isfinite(scale) and scale > 0):
            raise SceneError(f"{name}: scale must be a positive number, got {scale!r}")
        if not np.isfinite(rotation):
            raise SceneError(f"{name}: rotation must be a finite number of degrees, got {rotation!r}")
        while pixels.shape[1] > MAXIMUM_WIDTH and pixels.shape[0] % 2 == 0 and pixels.shape[1] % 2 == 0:
            pixels = reduced(pixels, 2)
        if not pixels.any():
            raise SceneError(f"{name}: is all black; there is no light in it")
        self.pixels = np.ascontiguousarray(pixels * np.float32(scale))
        self.name = name
        turn = np.radians(rotation)
        self.turn = (np.float32(np.cos(turn)), np.float32(np.sin(turn)))
        self.density, self._rows, self._columns = _distribution(self.pixels)

    def radiance(self, directions: Floats) -> tuple[Floats, Floats]:
        """World directions (N, 3) -> radiance (N, 3) and the density of `sample` there (N,) [1/sr]."""
        from . import environment_kernels as kernels

        count = len(directions)
        radiance, density = np.empty((count, 3), np.float32), np.empty(count, np.float32)
        in_parallel(kernels.look_up, count, directions, self.pixels, self.density, *self.turn, radiance, density)
        return radiance, density

    def sample(self, u: Floats) -> tuple[Floats, Floats, Floats]:
        """Numbers (N, 2) in [0, 1) -> world directions (N, 3), radiance (N, 3), density (N,) [1/sr]."""
        from . import environment_kernels as kernels

        directions = np.empty((len(u), 3), np.float32)
        in_parallel(kernels.sample, len(u), u, self._rows, self._columns, *self.turn, directions)
        return directions, *self.radiance(directions)

    def unturned(self) -> Environment:
        """The same light with a rotation of 0."""
        same = copy.copy(self)
        same.turn = (np.float32(1), np.float32(0))
        return same

    def blurred(self, height: int = 32) -> Environment:
        """The same light, averaged down to about `height` rows and smoothed: what stands out of focus behind."""
        factor = max(1, self.pixels.shape[0] // height)
        rows, columns = (size // factor * factor for size in self.pixels.shape[:2])
        small: NDArray[np.floating[Any]] = reduced(self.pixels[:rows, :columns], factor)
        for _ in range(2):
            small = (np.roll(small, 1, 1) + 2 * small + np.roll(small, -1, 1)) / 4
            padded = np.concatenate([small[:1], small, small[-1:]])
            small = (padded[:-2] + 2 * padded[1:-1] + padded[2:]) / 4
        cos, sin = self.turn
        return Environment(small, rotation=float(np.degrees(np.arctan2(sin, cos))), name=self.name)

    def irradiance(self, normal: ArrayLike) -> NDArray[np.float64]:
        """(3,): the integral of radiance times cosine over the hemisphere about `normal`, pixel by pixel."""
        height, width = self.pixels.shape[:2]
        theta = (np.arange(height) + 0.5) * np.pi / height
        phi = ((np.arange(width) + 0.5) / width - 0.5) * 2 * np.pi
        cos, sin = (float(value) for value in self.turn)
        x, z = np.sin(theta)[:, None] * np.sin(phi), -np.sin(theta)[:, None] * np.cos(phi)
        directions = np.stack(
            [cos * x + sin * z, np.broadcast_to(np.cos(theta)[:, None], x.shape), cos * z - sin * x], -1
        )
        cosine = np.maximum(directions @ np.asarray(normal, np.float64), 0)
        edges = np.cos(np.arange(height + 1) * np.pi / height)
        solid_angle = ((edges[:-1] - edges[1:]) * 2 * np.pi / width)[:, None]
        total: NDArray[np.float64] = np.einsum("ijc,ij->c", self.pixels, cosine * solid_angle)
        return total


def _distribution(pixels: Floats) -> tuple[Floats, Floats, Floats]:
    """Density of each cell over solid angle (H, W) [1/sr], and the running sums over rows (H,) and columns (H, W).

    A cell's brightness is the mean of the bilinear interpolation over it, so that light which leaks into a dark cell
    from its neighbours is found, too.
    """
    luminance = (pixels @ LUMINANCE).astype(np.float64)
    luminance = (np.roll(luminance, 1, 1) + 6 * luminance + np.roll(luminance, -1, 1)) / 8
    padded = np.concatenate([luminance[:1], luminance, luminance[-1:]])
    luminance = (padded[:-2] + 6 * padded[1:-1] + padded[2:]) / 8
    height, width = luminance.shape
    edges = np.cos(np.arange(height + 1) * np.pi / height)
    solid_angle = ((edges[:-1] - edges[1:]) * 2 * np.pi / width)[:, None]
    share = luminance * solid_angle
    share /= share.sum()
    rows = np.cumsum(share.sum(1))
    columns = np.cumsum(share, 1)
    columns /= np.maximum(columns[:, -1:], 1e-300)
    rows[-1] = columns[:, -1] = 1
    density = (share / solid_angle).astype(np.float32)
    return density, rows.astype(np.float32), columns.astype(np.float32)


def reduced(pixels: Floats, factor: int) -> Floats:
    """The mean over `factor` x `factor` pixels, weighted by solid angle, so that no light is lost."""
    height, width = pixels.shape[:2]
    weight = np.sin((np.arange(height) + 0.5) * np.pi / height)[:, None, None]
    shape = (height // factor, factor, width // factor, factor, 3)
    total = (pixels * weight).reshape(shape).sum((1, 3))
    weights = np.broadcast_to(weight, pixels.shape).reshape(shape).sum((1, 3))
    return np.asarray(total / weights, np.float32)


def load(environment: str | os.PathLike[str] | float | Environment, rotation: float = 0.0) -> Environment:
    """An environment by name ("studio"), from an .hdr or .exr file, of one radiance everywhere (a number), or as it is.

    Raises UnknownNameError, FileError, CorruptFileError or SceneError.
    """
    if isinstance(environment, Environment):
        return environment
    if isinstance(environment, (int, float)):
        return Environment(np.full((16, 32, 3), float(environment)), name=f"constant {environment:g}")
    if str(environment) in BUILT_IN:
        folder = Path(__file__).parent / "data"
        return Environment(radiance_file.read(folder / f"{environment}.hdr"), 1.0, rotation, str(environment))
    path = Path(environment)
    inputs.note(path)
    if not path.exists():
        if isinstance(environment, str) and not path.suffix and path.parent == Path():
            raise UnknownNameError("environment", environment, BUILT_IN)
        raise FileError(environment, f"no such file; give an .hdr or .exr picture or one of {', '.join(BUILT_IN)}.")
    if path.is_dir():
        raise FileError(path, "is a folder; give an .hdr or .exr picture.")
    try:
        with path.open("rb") as file:
            start = file.read(8)
    except OSError as error:
        raise FileError(path, f"cannot be read ({error.strerror}).") from None
    if start.startswith((b"\x89PNG", b"\xff\xd8\xff", b"BM", b"GIF8")):
        raise FileError(path, "is an 8-bit picture without the range of light; give a linear .hdr or .exr environment.")
    if start.startswith(b"\x76\x2f\x31\x01"):
        from .image import read_exr

        return Environment(read_exr(path), 1.0, rotation, path.name)
    if start.startswith(b"#?"):
        return Environment(radiance_file.read(path), 1.0, rotation, path.name)
    raise CorruptFileError(path, "is neither a Radiance .hdr nor an OpenEXR picture.")
