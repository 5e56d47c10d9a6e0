"""From exposures of one view to its light: the camera's response, and pictures merged beyond a single one's range."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import CorruptFileError, FileError, MissingExtraError, ParameterError
from ..photographs import Photograph, Response, read_photograph
from .arrangement import Lamp

Array = NDArray[np.floating[Any]]

SMOOTHNESS = 50.0
"""Weight of the recovered curve's second derivative (lambda of Debevec1997): 1 % from true curves with 4 exposures."""
SAMPLES = 300
"""Pixels from which the curve is recovered; Debevec1997 asks for more than 255 / (exposures - 1)."""
GRID = 24
"""Rows and columns of each photograph that it may be recovered from."""
EXPOSURE_TIME = 0x829A
EXIF = 0x8769


@dataclass(frozen=True)
class RecoveredResponse:
    """A camera's response as a table: light for each of the 256 numbers, one curve a channel."""

    light: NDArray[np.float32]
    """(256, 3), 1 for the green channel's largest number"""
    name: str = "recovered from the brackets"

    def linear(self, pixels: Array) -> Array:
        """Numbers in [0, 1] (..., 3) as light."""
        place = np.clip(np.rint(pixels * 255), 0, 255).astype(np.uint8)
        return np.stack([self.light[place[..., c], c] for c in range(3)], -1)


Curve = Response | RecoveredResponse


@dataclass(frozen=True)
class Dark:
    """What the camera sees with the lamp off: stray light, which grows with the exposure."""

    light: Array
    seconds: float | None
    """its exposure; None where that is not known, or where all photographs count as equally exposed"""

    def during(self, seconds: float | None) -> Array:
        """The light of another exposure; of the same where either is not known."""
        return self.light if self.seconds is None or seconds is None else self.light * (seconds / self.seconds)


def recover_response(brackets: Sequence[Sequence[tuple[Path, float]]]) -> RecoveredResponse:
    """The response curve from photographs (8 bits) of several views with their exposures [s]. Reference: Debevec1997.

    Of the brackets, all with the exposures of the longest count: a sample under one lamp may be too even. Raises
    MissingExtraError without OpenCV, ParameterError for fewer than two different exposures.
    """
    times = _times(max(brackets, key=lambda bracket: len(_times(bracket))))
    if len(times) < 2:
        raise ParameterError("a response is recovered from at least two different exposures of one lamp's place")
    try:
        import cv2
    except ImportError:
        raise MissingExtraError("recovering a camera's response from brackets", "capture") from None
    same = [sorted(bracket, key=lambda shot: shot[1]) for bracket in brackets if _times(bracket) == times]
    pictures = [np.concatenate([_grid(bracket[k][0]) for bracket in same]) for k in range(len(times))]
    calibration = cv2.createCalibrateDebevec(SAMPLES, SMOOTHNESS, False)
    curve = np.asarray(calibration.process(pictures, np.array(times, np.float32)), np.float32).reshape(256, 3)
    if not np.isfinite(curve).all() or not curve[255, 1] > 0:
        raise CorruptFileError(same[0][0][0], "no response can be recovered from its bracket; give --response.")
    # noise may make the fitted curve dip; light never falls as numbers rise
    return RecoveredResponse(np.maximum.accumulate(curve / curve[255, 1], 0))


def _times(bracket: Sequence[tuple[Path, float]]) -> tuple[float, ...]:
    return tuple(sorted({seconds for _, seconds in bracket}))


def _grid(path: Path) -> NDArray[np.uint8]:
    """Some rows and columns of a photograph of 8 bits. Raises ParameterError for more bits."""
    picture = read_photograph(path)
    if picture.deep:
        raise ParameterError(f"{path}: has more than 8 bits a channel; a response is recovered from 8 (use linear)")
    rows, columns = (np.linspace(0, extent - 1, min(GRID, extent)).astype(int) for extent in picture.pixels.shape[:2])
    return np.ascontiguousarray(np.rint(picture.pixels[np.ix_(rows, columns)] * 255), np.uint8)


def merged(
    shots: Sequence[tuple[Path, float]], curve: Curve, dark: Dark | None, first: Photograph
) -> tuple[Array, float]:
    """Light of one view (H, W, 3) per second of exposure, and the share of its pixels that no exposure holds.

    A single shot is taken as it is. Of several, each pixel is the mean of light / seconds, weighted by seconds times a
    hat over the numbers (Debevec1997, equation 6, in light instead of its logarithm): noise counts the less, the longer
    the exposure. Raises as `read_photograph`, and ParameterError for pictures of different size or depth.
    """
    total: Any = 0.0
    weight: Any = 0.0
    shortest = min(shots, key=lambda shot: shot[1])
    fallback: Any = None
    lost: Any = True
    for path, seconds in shots:
        picture = read_photograph(path)
        require_like(first, picture, path)
        light = curve.linear(picture.pixels)
        if dark is not None:
            light = light - dark.during(seconds)
        saturated = picture.saturated()
        lost = lost & saturated
        if len(shots) == 1:
            return light / np.float32(seconds), float(saturated.mean())
        if path == shortest[0]:
            fallback = light / np.float32(seconds)
        z = np.clip(picture.pixels, 0, 1)
        w = np.float32(seconds) * (np.minimum(z, 1 - z) + np.float32(1e-4)) * ~saturated[..., None]
        total, weight = total + w * (light / np.float32(seconds)), weight + w
    usable = weight > 0
    return np.where(usable, total / np.where(usable, weight, 1), fallback), float(np.mean(lost))


def require_like(first: Photograph, picture: Photograph, path: Path) -> None:
    """Raises ParameterError, naming `path`, when the picture has another size or depth than the first."""
    if picture.pixels.shape != first.pixels.shape:
        here, there = (f"{p.pixels.shape[1]} x {p.pixels.shape[0]}" for p in (picture, first))
        raise ParameterError(
            f"{path}: is {here}, but the first photograph {there}; all must be of one size, from a camera that stays"
        )
    if picture.largest != first.largest:
        raise ParameterError(
            f"{path}: holds numbers up to {picture.largest:g}, but the first photograph up to {first.largest:g}; save "
            "all with the same depth"
        )


def exposure_of(path: Path) -> float | None:
    """Seconds of exposure that the camera wrote into the file; None where it did not."""
    from PIL import Image

    try:
        with Image.open(path) as picture:
            seconds = float(picture.getexif().get_ifd(EXIF)[EXPOSURE_TIME])
    except (KeyError, OSError, TypeError, ValueError, ZeroDivisionError):
        return None
    return seconds if seconds > 0 else None


def with_exposures(lamps: Sequence[Lamp]) -> tuple[list[list[tuple[Path, float]]], bool]:
    """The photographs of each lamp with their exposures [s], and whether those are known: listed, or in the files.

    Where no photograph tells its exposure all count as equal. Raises FileError when only some do, or in a bracket.
    """
    known = [[(shot.path, shot.seconds or exposure_of(shot.path)) for shot in lamp.shots] for lamp in lamps]
    silent = [path for shots in known for path, seconds in shots if seconds is None]
    told = {seconds for shots in known for _, seconds in shots if seconds is not None}
    bracketed = max(len(shots) for shots in known) > 1
    if silent and (bracketed or len(told) > 1):
        why = "is one of several photographs under the same lamp" if bracketed else "tells no exposure, but others do"
        raise FileError(silent[0], f"{why}; write lines FILE ANGLE SECONDS in the list of angles.")
    if silent:
        return [[(path, 1.0) for path, _ in shots] for shots in known], False
    return [[(path, float(seconds)) for path, seconds in shots if seconds] for shots in known], True
