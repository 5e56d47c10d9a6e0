"""`brdf.capture.flat`: a folder of photographs of a flat sample -> linear pictures of it."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...color import luminance
from ...errors import CorruptFileError, FileError, ParameterError
from ..photographs import EXTENSIONS, Photograph, read_photograph, response_of
from .arrangement import Lamp, read_arrangement
from .exposures import Curve, Dark, exposure_of, merged, recover_response, require_like, with_exposures
from .rectify import Cutter
from .sample import FlatSample

Array = NDArray[np.floating[Any]]

CROP, SIZE = 1024, 512
"""Pixels across the part of the photographs that is kept, and across the pictures made of it (Kautz2004)."""
DEFAULT_ALBEDO = 0.5
"""Albedo that the sample is taken to have where nothing sets the scale."""
WHITE_ALBEDO = 0.99
"""Albedo of the white reference: of pressed PTFE."""
BLACK = 1e-4
"""Share of the brightest photograph's mean below which a photograph counts as black."""
SMOOTHED = 1 / 64
"""Width of the blur of the white reference, in pictures: what it shows of lamp and lens is smooth, its noise is not."""
BRACKETS = "brackets"
"""Name of the response that is recovered from exposures."""


def flat(
    folder: str | os.PathLike[str],
    *,
    angles: str | os.PathLike[str] | None = None,
    dark: str | os.PathLike[str] | None = None,
    white: str | os.PathLike[str] | None = None,
    response: str | float | None = None,
    corners: ArrayLike | None = None,
    crop: int = CROP,
    size: int = SIZE,
    albedo: float | None = None,
    progress: Callable[[str], None] | None = None,
) -> FlatSample:
    """Linear pictures of a flat sample, from photographs by a fixed camera straight above and a lamp on an arc.

    `folder` holds the photographs and `angles.txt`: a line `[FILE] ANGLE [SECONDS]` a photograph, the lamp's angle from
    the normal [degrees] and perhaps the exposure; or an `.lp` file of directions (x right, y up, z to the camera), of
    which the arc nearest to a plane is taken. `angles` names such a file elsewhere. Several photographs under one lamp
    are a bracket and are merged. Exposures come from the list or from the files.

    `response`: "linear", "srgb", a gamma, or "brackets" (recovered from the exposures; needs the extra `capture`); by
    default linear for more than 8 bits, sRGB for 8. `dark`: a picture with the lamp off (`*dark*` in the folder), to
    subtract. `white`: a picture of a white diffuser in the sample's place under the highest lamp (`*white*` in the
    folder), to divide by: it takes out vignetting and the lamp's fall-off, and sets the scale. `corners` (4, 2): pixels
    x, y of four marks, clockwise from the top left, to undo perspective; `crop`: pixels across the part that is kept;
    `size`: across the pictures. `albedo`: what the sample's albedo is, where no white reference says (0.5).

    Raises FileError, CorruptFileError, UnknownFormatError, ParameterError, MissingExtraError: see
    `docs/capture-flat.md`. References: Kautz2004, Debevec1997.
    """
    tell = progress or (lambda text: None)
    if albedo is not None and not 0 < albedo <= 1:
        raise ParameterError(f"albedo must lie in (0, 1], got {albedo:g}")
    place = Path(folder)
    dark_path, white_path = (_reference(place, word, given) for word, given in (("dark", dark), ("white", white)))
    others = [path for path in (dark_path, white_path) if path is not None]
    lamps, facts = read_arrangement(place, None if angles is None else Path(angles), others)
    shots, timed = with_exposures(lamps)
    first = read_photograph(shots[0][0][0])
    curve = _curve(response, first, shots, tell)
    cutter = Cutter(first.pixels.shape[:2], None if corners is None else np.asarray(corners, float), crop, size)
    off = None if dark_path is None else _dark(dark_path, curve, first, timed)
    images = np.empty((len(lamps), *cutter.out, 3), np.float32)
    clipped = []
    for number, bracket in enumerate(shots):
        tell(f"photographs of lamp {number + 1} of {len(lamps)}")
        light, lost = merged(bracket, curve, off, first)
        images[number] = cutter.cut(light)
        clipped.append(lost)
    _require_light(images, lamps)
    height, width = first.pixels.shape[:2]
    count = sum(len(bracket) for bracket in shots)
    said = [f"{count} photographs of {width} x {height} pixels under {len(lamps)} lamps, response {curve.name}", *facts]
    absolute = False
    if white_path is not None:
        seconds = exposure_of(white_path) if timed else None
        field = _field(white_path, curve, off, seconds, first, cutter)
        absolute = albedo is None and (not timed or seconds is not None)
        if absolute:
            level = WHITE_ALBEDO * math.cos(math.radians(lamps[0].elevation)) / math.pi
            images *= np.float32(level * (seconds or 1.0)) / field
            said.append(f"scale: {white_path.name} is a diffuser of albedo {WHITE_ALBEDO:g} under the highest lamp")
        else:
            images /= field / field.mean()
    if not absolute:
        images *= np.float32(_to_albedo(images, lamps, albedo or DEFAULT_ALBEDO))
        assumed = "as given" if albedo else "assumed; photographs have no absolute scale"
        said.append(f"scale: albedo {albedo or DEFAULT_ALBEDO:g} ({assumed})")
    elevations = np.array([lamp.elevation for lamp in lamps])
    source = f"photographs of a flat sample ({len(lamps)} lamps)"
    return FlatSample(images, elevations, place.resolve().name, source, absolute, np.array(clipped), tuple(said))


def _reference(folder: Path, word: str, given: str | os.PathLike[str] | None) -> Path | None:
    """The picture given, or the one in the folder with `word` in its name."""
    if given is not None:
        path = Path(given)
        if not path.is_file():
            raise FileError(path, "no such file; check the path.")
        return path
    if not folder.is_dir():
        raise FileError(folder, "no such folder; give the folder of the photographs.")
    found = [p for p in sorted(folder.iterdir()) if word in p.stem.lower() and p.suffix.lower() in EXTENSIONS]
    if len(found) > 1:
        names = ", ".join(path.name for path in found[:3])
        raise FileError(folder, f"holds several {word} pictures ({names}); say which with --{word}.")
    return found[0] if found else None


def _curve(
    response: str | float | None, first: Photograph, shots: Sequence[Sequence[tuple[Path, float]]],
    tell: Callable[[str], None],
) -> Curve:  # fmt: skip
    if response != BRACKETS:
        return response_of(response, first.deep)
    tell("recovering the response")
    return recover_response(shots)


def _dark(path: Path, curve: Curve, first: Photograph, timed: bool) -> Dark:
    picture = read_photograph(path)
    require_like(first, picture, path)
    return Dark(curve.linear(picture.pixels), exposure_of(path) if timed else None)


def _field(
    path: Path, curve: Curve, dark: Dark | None, seconds: float | None, first: Photograph, cutter: Cutter
) -> Array:
    """(*out, 3) the light of the white reference, smoothed. Raises CorruptFileError."""
    from scipy.ndimage import gaussian_filter

    picture = read_photograph(path)
    require_like(first, picture, path)
    if picture.saturated().mean() > 0.001:
        raise CorruptFileError(
            path, f"{picture.saturated().mean():.1%} of the white reference is saturated; expose shorter."
        )
    light = curve.linear(picture.pixels)
    field = cutter.cut(light if dark is None else light - dark.during(seconds))
    blur = SMOOTHED * max(cutter.out)
    field = gaussian_filter(field, (blur, blur, 0), mode="nearest")
    if not field.min() > BLACK * max(field.max(), 1e-9):
        raise CorruptFileError(path, "the white reference is black in places; take it again.")
    return np.asarray(field)


def _require_light(images: Array, lamps: Sequence[Lamp]) -> None:
    """Raises CorruptFileError for a black picture."""
    means = images.mean((1, 2, 3), dtype=np.float64)
    if not means.max() > 0:
        raise CorruptFileError(lamps[0].shots[0].path, "is black, and so are all others; check lamp and exposure.")
    dark = np.flatnonzero(means <= BLACK * means.max())
    if len(dark):
        path = lamps[dark[0]].shots[0].path
        raise CorruptFileError(path, "is black; take it again, or leave it out of the list of angles.")


def _to_albedo(images: Array, lamps: Sequence[Lamp], albedo: float) -> float:
    """What brings the pictures to that albedo: pi a / cos(theta) of a diffuser, under the highest lamp."""
    average = float(luminance(images[0]).mean(dtype=np.float64))
    return albedo * math.cos(math.radians(lamps[0].elevation)) / (math.pi * average)
