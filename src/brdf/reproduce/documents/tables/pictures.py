"""Pictures of several reflectances by the same light paths, so that they differ by their values alone."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ....color import srgb_encode
from ....errors import ReflectanceError
from ....formula.engine import SMALL
from ....geometry.sampling import Sampler
from ....reflectance import Floats, Reflectance
from ....render import Image, render
from ....threads import in_ranges
from ...pictures import error_picture
from ...report import Panel

Array = NDArray[np.floating[Any]]


class Likeness(Reflectance):
    """The values of one reflectance, sampled as another one is.

    It is evaluated without compiling, which would take longer than one picture of a table whose like is not seen again.
    """

    has_formula = False

    def __init__(self, m: Reflectance, like: Reflectance) -> None:
        self._m, self._like = m, like
        self.asked: list[tuple[Floats, Floats]] = []
        """All directions that it was evaluated at."""

    @property
    def isotropic(self) -> bool:
        return self._m.isotropic

    def _evaluate_arrays(self, wi: Floats, wo: Floats, clamp: bool) -> Floats:
        value = np.empty_like(wi)

        def fill(start: int, stop: int) -> None:
            value[start:stop] = self._m(wi[start:stop], wo[start:stop])

        in_ranges(fill, len(wi), SMALL // 2)
        self.asked.append((wi, wo))
        return value

    def _make_sampler(self) -> Sampler:
        return self._like.sampler

    def _state(self) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
        raise ReflectanceError("a likeness is made for one picture and is not saved; save what it shows")


class Picture(NamedTuple):
    """One picture and how far it is from the truth."""

    image: Image
    rms: float
    """RMS error of the radiance, in parts of the RMS radiance, over the pixels of the shape"""
    display: float
    """RMS error of sRGB values, over the same"""
    error: Array
    """(H, W) largest difference of the sRGB channels"""

    def quantile(self, share: float) -> float:
        """Of those errors, over the pixels of the shape."""
        assert self.image.alpha is not None
        return float(np.quantile(self.error[self.image.alpha > 0], share))


@dataclass(frozen=True)
class View:
    """What is seen: the arguments of `render` but for the material."""

    scene: Mapping[str, Any]

    def image(self, m: Reflectance, like: Reflectance | None = None) -> Image:
        """A picture of `m`; the light paths are those of `like`, by default its own."""
        return self._render(Likeness(m, like or m))

    def pairs(self, m: Reflectance) -> tuple[Floats, Floats]:
        """(N, 3), (N, 3): all pairs at which a picture of `m` evaluates it, in their order."""
        shown = Likeness(m, m)
        self._render(shown)
        wi, wo = zip(*shown.asked, strict=True)
        return np.concatenate(wi), np.concatenate(wo)

    def _render(self, shown: Reflectance) -> Image:
        return render(shown, background="transparent", progress=False, **self.scene)

    def of(self, m: Reflectance, truth: Reflectance, true: Image) -> Picture:
        """A picture of `m` compared with `true`, that of `truth`."""
        return compared(self.image(m, truth), true)


def compared(image: Image, true: Image) -> Picture:
    """An image and its errors, where the shape is."""
    assert true.alpha is not None
    seen = true.alpha > 0
    a, b = true.pixels[seen].astype(np.float64), image.pixels[seen].astype(np.float64)
    shown = np.abs(srgb_encode(true.pixels) - srgb_encode(image.pixels))
    return Picture(
        image,
        float(np.sqrt(np.mean((a - b) ** 2) / np.mean(a**2))),
        float(np.sqrt(np.mean(shown[seen].astype(np.float64) ** 2))),
        np.asarray(shown.max(-1)),
    )


def panel(picture: Picture, words: str) -> Panel:
    """The picture with its error below."""
    return Panel(picture.image.developed("clip"), f"{words}: RMS {picture.rms:.2g}")


def error_panel(picture: Picture, words: str, highest: float) -> Panel:
    """Where the error is."""
    alpha = picture.image.alpha
    return Panel(error_picture(picture.error, highest, alpha), words)
