"""Simulated photographs, the shading maps made of them, and the errors that every section measures."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....capture import FlatSample, simulate
from ....color import luminance
from ....geometry.directions import from_spherical
from ....models.lambertian import Lambertian
from ....models.modified_phong import ModifiedPhong
from ....render import Directional
from ....render.progress import Progress
from ....representations.shading.compression import white
from ....representations.shading.shading_map import ShadingMap
from ....representations.shading.slices import Slices
from .settings import BETWEEN, DIFFUSE, PHONG, SLICES, Settings, chosen

Floats = NDArray[np.floating[Any]]

EXPOSURE = 0.5
"""Radiance of a surface of a map's own albedo that faces the lamp of the figures."""

NORMAL = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class Sample:
    """A material: ten photographs, and those in between that maps do not see."""

    name: str
    taken: FlatSample
    between: FlatSample

    @cached_property
    def native(self) -> ShadingMap:
        """Each photograph at its own average; under the sample's own average BRDF."""
        return self.taken.shading_map()

    @cached_property
    def even(self) -> ShadingMap:
        """The paper's map."""
        return self.taken.shading_map(mode="paper", slices=SLICES)

    @property
    def white(self) -> float:
        """The value that counts as 1 in errors."""
        return white(slices_of(self.native))

    def under_phong(self, h: ShadingMap | None = None) -> ShadingMap:
        """The native map, or `h`, under the BRDF of figure 7."""
        return under_phong(h or self.native, *PHONG[self.name])


def simulated(settings: Settings) -> list[Sample]:
    """All chosen materials."""
    names, made = chosen(settings), []
    with Progress("simulated photographs", len(names), None) as bar:
        for name in names:
            made.append(Sample(name, simulate(name, size=settings.size), simulate(name, BETWEEN, settings.size)))
            bar.step()
    return made


def named(samples: Sequence[Sample], name: str) -> Sample:
    """The sample of that name, or the first."""
    return next((sample for sample in samples if sample.name == name), samples[0])


def under_phong(h: ShadingMap, highlight: float, exponent: float) -> ShadingMap:
    """The map under the paper's kind of BRDF (Lewis1994), of the albedo that the brightest picture has."""
    m = Lambertian(albedo=DIFFUSE) + ModifiedPhong(ks=highlight, n=exponent)
    return h.replaced(brdf=m, sigma=math.pi * h.stack.highest / (DIFFUSE + highlight))


def sun(h: ShadingMap, colour: tuple[float, float, float] = (1.0, 1.0, 1.0)) -> Directional:
    """A lamp that shows every map equally bright."""
    power = np.array(colour) * (EXPOSURE / (math.pi * h.stack.highest))
    return Directional(theta=40, phi=45, power=power)


def slices_of(h: ShadingMap) -> Slices:
    """The pictures of a map that is not compressed."""
    assert isinstance(h.stack, Slices)
    return h.stack


def predicted(h: ShadingMap, angle: float) -> Floats:
    """The photograph under a lamp at that angle from the normal [degrees], as the map's BRDF predicts it."""
    wi = from_spherical(np.radians(angle), 0.0)
    return h.picture(h.sigma * float(luminance(h.children["brdf"].f_cos(wi, NORMAL))))


def rms(a: Floats, b: Floats) -> float:
    return float(np.sqrt(np.mean((np.asarray(a, np.float64) - b) ** 2)))


def decibels(errors: Iterable[float]) -> float:
    """The PSNR of several pictures together, of their RMS errors as shares of white."""
    return -10 * float(np.log10(np.mean(np.square(list(errors)))))


def geometric(values: Iterable[float]) -> float:
    return float(np.exp(np.mean(np.log(list(values)))))


def over(samples: Sequence[Sample], error: Callable[[Sample], float]) -> float:
    """The geometric mean of an error."""
    return geometric(map(error, samples))


def relative(shown: Floats, truth: Floats) -> tuple[float, float]:
    """RMS error per texel, and that of the sorted luminances (two histograms' distance), over the truth's mean."""
    truth = np.asarray(truth, np.float64)
    first, second = (np.sort(luminance(picture).ravel()) for picture in (np.asarray(shown, np.float64), truth))
    return rms(shown, truth) / float(truth.mean()), rms(first, second) / float(second.mean())
