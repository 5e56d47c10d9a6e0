"""A folder of photographs of a ball -> radiance on known normals."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import CorruptFileError, FileError, ParameterError
from ..lights import read_directions, read_intensities
from ..photographs import EXTENSIONS, Photograph, Response, pictures_in, read_photograph, response_of
from .outline import Ball, ball_of_mask, ball_of_pictures
from .photographs import BallPhotographs
from .response_choice import CANDIDATES, chosen_response

Array = NDArray[np.floating[Any]]

MOST_PIXELS = 512
"""Across the ball: larger photographs are averaged down by whole numbers, which takes out noise."""
MARGIN = 2
"""Pixels kept around the ball."""
BLACK = 1e-3
"""Share of the brightest photograph's mean below which a photograph counts as black."""
CLIPPED = 1e-4
"""Share of saturated pixels from which a warning is due."""
SHADOW = 0.02
"""Share of the ball's typical brightness that its shadow may have before a warning is due."""

Progress = Callable[[str], None]


def read_ball(
    folder: Path,
    *,
    lights: Path | None = None,
    intensities: Path | None = None,
    mask: Path | None = None,
    dark: Path | None = None,
    response: str | float | None = None,
    progress: Progress = lambda text: None,
) -> tuple[BallPhotographs, list[str], list[str]]:
    """The photographs of a folder in units of their files (1 is the largest number), the warnings, and facts to report.

    Without a response, files of 8 bits get the one that suits them (`response_choice`). See `brdf.capture.sphere` for
    the arguments. Raises FileError, CorruptFileError, ParameterError.
    """
    paths, masks = pictures_in(folder, [p for p in (mask, dark) if p is not None])
    if len(paths) < 2:
        raise FileError(
            folder, f"holds {len(paths)} photograph(s) ({' '.join(EXTENSIONS)}); at least 2 of the ball are needed."
        )
    directions = read_directions(folder, lights, len(paths))
    strength = read_intensities(folder, intensities, len(paths))
    first = read_photograph(paths[0])

    def reader_for(curve: Response) -> _Reader:
        return _Reader(paths, curve, first, _dark_frame(folder, dark, first, curve), progress)

    curve, why = response_of(response, first.deep), ""
    reader = reader_for(curve)
    warnings: list[str] = []
    ball, how = _find_ball(folder, mask, masks, reader)
    made, clipped = _cropped(reader, ball, directions, strength)
    if response is None and not first.deep:
        other = _cropped(reader_for(Response("linear")), ball, directions, strength)[0]
        progress("choosing the camera's response")
        readings = dict(zip(CANDIDATES, (made, other), strict=True))
        name, why = chosen_response(readings, strength)
        curve, made = Response(name), readings[name]
    if clipped > CLIPPED:
        warnings.append(
            f"{clipped:.2%} of the ball's pixels are saturated; they are filled from other photographs: expose "
            "shorter, or save more than 8 bits"
        )
    shadow = _shadow(made)
    if shadow > SHADOW:
        warnings.append(
            f"the ball's shadow shows {shadow:.1%} of its typical brightness: stray light or a lifted black; take a "
            "dark frame with the lights off, and darken the room"
        )
    facts = [
        f"{len(paths)} photographs of {first.pixels.shape[1]} x {first.pixels.shape[0]} pixels, response {curve.name}"
        + (f" (chosen: {why}; --response says otherwise)" if why else ""),
        f"ball ({how}): centre {ball.x:.1f}, {ball.y:.1f} from the top left, radius {ball.radius:.1f} pixels",
        f"lights {np.degrees(made.angles).min():.1f} to {np.degrees(made.angles).max():.1f} degrees from the camera",
    ]
    return made, warnings, facts


class _Reader:
    """Photographs one after the other, linear, checked against the first."""

    def __init__(
        self, paths: list[Path], response: Response, first: Photograph, dark: Array | None, progress: Progress
    ) -> None:
        self.paths, self._response, self._dark, self._progress = paths, response, dark, progress
        self.shape, self._largest, self._first = first.pixels.shape, first.largest, paths[0]

    def read(self, number: int) -> tuple[Array, NDArray[np.bool_]]:
        """(H, W, 3) linear values, and (H, W) where they are saturated."""
        path = self.paths[number]
        self._progress(f"reading photograph {number + 1} of {len(self.paths)}")
        picture = read_photograph(path)
        if picture.pixels.shape != self.shape:
            raise ParameterError(f"{path}: is {_size(picture)}, but {self._first.name} {_named(self.shape)}; all "
                                 "photographs must be of one size, from a camera that does not move")  # fmt: skip
        if picture.largest != self._largest:
            raise ParameterError(f"{path}: holds numbers up to {picture.largest:g}, but {self._first.name} up to "
                                 f"{self._largest:g}; save all with the same depth")  # fmt: skip
        linear = self._response.linear(picture.pixels)
        if self._dark is not None:
            linear = linear - self._dark
        return linear, picture.saturated()


def _size(picture: Photograph) -> str:
    return _named(picture.pixels.shape)


def _named(shape: tuple[int, ...]) -> str:
    return f"{shape[1]} x {shape[0]}"


def _dark_frame(folder: Path, given: Path | None, first: Photograph, response: Response) -> Array | None:
    if given is None:
        named = [p for p in sorted(folder.iterdir()) if "dark" in p.stem.lower() and p.suffix.lower() in EXTENSIONS]
        if not named:
            return None
        given = named[0]
    picture = read_photograph(given)
    if picture.pixels.shape != first.pixels.shape:
        raise ParameterError(
            f"{given}: the dark frame is {_size(picture)}, the photographs are {_size(first)}; take it "
            "with the same camera and settings"
        )
    return np.asarray(response.linear(picture.pixels))


def _find_ball(folder: Path, given: Path | None, found: list[Path], reader: _Reader) -> tuple[Ball, str]:
    """The ball in whole photographs, and where it was found."""
    if given is None and len(found) > 1:
        names = ", ".join(path.name for path in found[:3])
        raise FileError(folder, f"holds {len(found)} masks ({names}); say which with --mask.")
    path = given or (found[0] if found else None)
    if path is not None:
        picture = read_photograph(path)
        if picture.pixels.shape != reader.shape:
            raise ParameterError(f"{path}: the mask is {_size(picture)}, the photographs are {_named(reader.shape)}")
        try:
            return ball_of_mask(picture.pixels.mean(-1) > 0.5), f"from {path.name}"
        except ParameterError as error:
            raise ParameterError(f"{path}: {error}") from None
    brightest: Array = np.zeros(reader.shape[:2], np.float32)
    for number in range(len(reader.paths)):
        brightest = np.maximum(brightest, reader.read(number)[0].mean(-1))
    return ball_of_pictures(brightest), "circle fitted to the photographs"


def _cropped(reader: _Reader, ball: Ball, directions: Array, strength: Array) -> tuple[BallPhotographs, float]:
    """The photographs around the ball, over the lights' intensities, and the share of saturated pixels on the ball."""
    height, width = reader.shape[:2]
    reduce = max(1, math.ceil(2 * ball.radius / MOST_PIXELS))
    left, top = (max(0, math.floor(c - ball.radius) - MARGIN * reduce) for c in (ball.x, ball.y))
    right = min(width, math.ceil(ball.x + ball.radius) + MARGIN * reduce)
    bottom = min(height, math.ceil(ball.y + ball.radius) + MARGIN * reduce)
    right -= (right - left) % reduce
    bottom -= (bottom - top) % reduce
    box = np.s_[top:bottom, left:right]
    disc = ball.normals(height, width)[1][box] < 1
    kept, usable, clipped = [], [], []
    for number in range(len(reader.paths)):
        linear, saturated = reader.read(number)
        clipped.append(float(saturated[box][disc].mean()))
        kept.append(_averaged(linear[box] / strength[number], reduce).astype(np.float32))
        usable.append(_averaged(saturated[box][..., None].astype(np.float32), reduce)[..., 0] == 0)
    pictures = np.stack(kept)
    means = pictures.mean(axis=(1, 2, 3))
    dark = np.flatnonzero(means <= BLACK * means.max())
    if len(dark):
        raise CorruptFileError(
            reader.paths[dark[0]], "is black; take it again, or remove it and its line from the lists of lights."
        )
    small = Ball((ball.x - left) / reduce, (ball.y - top) / reduce, ball.radius / reduce)
    names = tuple(path.name for path in reader.paths)
    return BallPhotographs(names, pictures, np.stack(usable), directions, small), float(np.mean(clipped))


def _averaged(picture: Array, reduce: int) -> Array:
    if reduce == 1:
        return picture
    height, width, channels = picture.shape
    blocks = picture.reshape(height // reduce, reduce, width // reduce, reduce, channels)
    return np.asarray(blocks.mean((1, 3), dtype=np.float32))


def _shadow(photographs: BallPhotographs) -> float:
    """Median brightness of pixels turned well away from the light over that of lit ones; 0 where there are none."""
    normals = photographs.ball.normals(*photographs.pictures.shape[1:3])[0][photographs.seen]
    facing = normals @ photographs.lights.T
    values = photographs.pictures[:, photographs.seen].mean(-1).T
    away, lit = values[facing < -0.1], values[facing > 0.5]
    return float(np.median(away) / np.median(lit)) if len(away) > 100 and len(lit) else 0.0
