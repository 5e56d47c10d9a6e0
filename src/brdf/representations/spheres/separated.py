"""The blend that tells the diffuse light in the pictures from the rest.

The rule k = 1/2 keeps highlights in place, but bends diffuse shades, because the pictures hold f cos(theta_i), and
blends highlights badly where they grow fast, towards grazing angles. Both can be said beforehand:

    I = floor cos_i + g R,   g = F(phi / 2) cos_i / ((cos_i + c) (cos_o + c))

floor is the least pi f in the pictures, F Schlick's curve [Schlick1994], and R what is left to interpolate: mostly the
distribution of facets, which belongs to the half vector. The same two texels are read; floor and F0 are two colours,
found in the pictures themselves.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...formula import Scalar, Vec, clip, cos, maximum, minimum
from ...formula.backends import backend_of
from ...formula.textures import lookup
from .bake import disc

Array = NDArray[np.floating[Any]]

SHADOWING = 0.1
"""c: the cosine at which half the light is lost to shadowing; found by trial, see docs/sphere-images.md."""

STEEPEST = 0.06
"""Least cosine that shadowing is formed with: below, it would extrapolate to more light than there is."""

FADE = 0.1
"""Cosine below which a picture counts less: in it the turned normal nears the limb or the shadow's edge."""

LEAST_COSINE = 0.01
"""Of a turned normal: what remains of a picture's light is divided by no less."""

FLOOR_QUANTILE = 0.02
"""The quantile of pi f in the pictures that counts as diffuse: the least value of a photograph is noise."""

HIGHLIGHT = np.radians(np.linspace(-15, 15, 31))
"""Angles from the half vector over which the growth of highlights is measured; less where the lit part is narrow."""

LAST_HIGHLIGHT = np.radians(150.5)
"""Angle up to which a highlight is measured: later it fills the crescent that is lit, and is shadowing more than F."""

LEAST_GROWTH = 0.01
"""Difference of Schlick's curve between the last two pictures below which they say nothing of F0."""

Angles = tuple[Scalar, Scalar]


class View(NamedTuple):
    """A normal as the viewer sees it."""

    a: Scalar
    """azimuth in the plane of light and viewer [rad]"""
    rho: Scalar
    """length of its part in that plane"""
    phi: Scalar
    """angle between light and viewer [rad]"""


def combined(
    radiances: tuple[Vec, Vec], azimuths: Angles, nodes: Angles, t: Scalar, view: View, floor: Vec, F0: Vec
) -> Vec:
    """The formula: the radiance of `view`, from that of pictures at angles `nodes` where the normal, turned, has
    `azimuths`; `t` is the share of the second."""
    cos_i, cos_o = maximum(view.rho * cos(view.a - view.phi), 0.0), view.rho * cos(view.a)
    cosines = [(view.rho * cos(a - node), view.rho * cos(a)) for a, node in zip(azimuths, nodes, strict=True)]
    second = t * clip(minimum(*cosines[1]) * (1 / FADE), 0.0, 1.0)
    left = []
    for value, pair, node in zip(radiances, cosines, nodes, strict=True):
        toward_light, toward_viewer = (maximum(cosine, LEAST_COSINE) for cosine in pair)
        glossy = maximum(value - floor * toward_light, 0.0)
        left.append(glossy / (schlick(F0, node) * shadowing(toward_light, toward_viewer)))
    rest = left[0] * (1.0 - second) + left[1] * second
    radiance: Vec = floor * cos_i + schlick(F0, view.phi) * shadowing(cos_i, cos_o) * rest
    return radiance


def shadowing(cos_i: Any, cos_o: Any) -> Any:
    return cos_i / ((maximum(cos_i, STEEPEST) + SHADOWING) * (maximum(cos_o, STEEPEST) + SHADOWING))


def grazing(phi: Any) -> Any:
    """Schlick's (1 - cos(phi / 2))^5 for light and viewer an angle `phi` apart."""
    return (1.0 - cos(0.5 * phi)) ** 5


def schlick(F0: Any, phi: Any) -> Any:
    return F0 + (1.0 - F0) * grazing(phi)


def measured_constants(images: Array, nodes: tuple[float, ...]) -> dict[str, Array]:
    """`floor` and `F0`, (3,) each, of pictures (N, size, size, 3) at angles `nodes` [rad].

    F0 is what makes Schlick's curve grow as the highlight does between the last two pictures that show it well.
    """
    x, y = disc(images.shape[1])
    radius = np.hypot(x, y)
    z = np.sqrt(np.maximum(1 - radius**2, 0))
    reflectances = []
    for image, phi in zip(images, nodes, strict=True):
        cos_i = x * np.sin(phi) + z * np.cos(phi)
        clear = (radius < 0.99) & (cos_i > 0.1)
        reflectances.append(image[clear] / cos_i[clear][:, None])
    floor = np.maximum(np.quantile(np.concatenate(reflectances), FLOOR_QUANTILE, axis=0), 0)
    clear_ones = [i for i, phi in enumerate(nodes) if phi <= LAST_HIGHLIGHT]
    pair = clear_ones[-2:] if len(clear_ones) > 1 else (0, 1)
    before, last = (_highlight(images[i], nodes[i], floor) for i in pair)
    growth = np.maximum((last + 1e-6) / (before + 1e-6), 1)
    s_before, s_last = (float(grazing(np.float64(nodes[i]))) for i in pair)
    F0 = (s_last - growth * s_before) / np.maximum(growth * (1 - s_before) - (1 - s_last), 1e-6)
    is_known = s_last - s_before > LEAST_GROWTH
    return {"floor": floor, "F0": np.clip(F0, 1e-3, 1) if is_known else np.ones(3)}


def _highlight(image: Array, phi: float, floor: Array) -> Array:
    """(3,) the mean of what is not diffuse over a few degrees about the half vector, without its shadowing."""
    azimuth = phi / 2 + HIGHLIGHT * min(1.0, 0.375 * (np.pi - phi) / HIGHLIGHT[-1])
    cos_i, cos_o = np.cos(azimuth - phi)[:, None], np.cos(azimuth)[:, None]
    place = (np.full_like(azimuth, 0.5), 0.5 + 0.5 * np.sin(azimuth))
    radiance = np.stack(lookup(image, place, backend_of(azimuth)).components, -1)
    return np.asarray(np.mean(np.maximum(radiance - floor * cos_i, 0) / shadowing(cos_i, cos_o), axis=0))
