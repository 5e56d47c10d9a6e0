"""Photographs of a ball -> the few pictures of a sphere that `SphereImages` blends.

Turned about the line of sight by minus its light's azimuth, a photograph shows the ball with the light in the
horizontal plane [Mihalik2015]; mirrored top to bottom it shows the same once more. Each is then moved from
its light's angle to that of the picture by the monotone rule of the blend, and by the ratio of the fitted stack at the
two places, which is near 1: what is averaged is thus in register. Unseen and saturated texels are the stack's.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...reflectance import Reflectance
from ...representations.spheres.bake import disc, sphere_pictures, sphere_radiance
from ...representations.spheres.blends import monotone
from ...representations.spheres.pictures import checked_angles
from ...representations.spheres.sphere_images import SphereImages
from .photographs import SEEN_RADIUS, BallPhotographs

Array = NDArray[np.floating[Any]]

CLUSTER = 5.0
"""Lights whose angles to the camera differ by less [degrees] share a picture."""
REACH = 4.0
"""Standard deviation [degrees] of the Gaussian that weights photographs by their distance from a picture's angle."""
STEP, LAST = 30.0, 165.0
"""Beyond the last light the stack's own pictures go on in such steps, up to such an angle [degrees]."""
PRIOR = 0.02
"""Weight of the stack among photographs of weight 1: it counts where they are missing."""
RATIO = 2.0
"""Largest factor between the stack at the two places."""
SAME_ANGLE = 0.01
"""Degrees by which pictures at one angle are set apart."""
FAINT = 1e-3
"""Radiance added to both sides of the ratio: shadows say nothing."""


def choose_angles(lights: Array) -> tuple[list[float], list[float]]:
    """Angles [degrees] of pictures for lights (N,) at such angles: the first, the last, and means of groups of
    neighbours between them; and those beyond."""
    groups: list[list[float]] = []
    for angle in sorted(float(a) for a in lights):
        if groups and angle - groups[-1][0] <= CLUSTER:
            groups[-1].append(angle)
        else:
            groups.append([angle])
    seen = sorted({groups[0][0], *(float(np.mean(group)) for group in groups[1:-1]), groups[-1][-1]})
    beyond = np.arange(seen[-1] + STEP, LAST - STEP / 2, STEP).tolist()
    beyond = [*beyond, LAST] if seen[-1] < LAST else []
    return [round(a, 1) for a in seen], [round(a, 1) for a in beyond]


def assemble(
    photographs: BallPhotographs, stack: Reflectance, size: int, angles: Sequence[float] | None = None
) -> tuple[SphereImages, list[bool]]:
    """The pictures, `size` texels across at `angles` [degrees] (default: `choose_angles`), and which of them rest on
    photographs. Raises ParameterError for angles that do not increase within [0, 180)."""
    lights = np.degrees(photographs.angles)
    if angles is None:
        seen, beyond = choose_angles(lights)
        angles = [*seen, *beyond]
    degrees = checked_angles(angles)
    images = np.asarray(sphere_pictures(stack, degrees, size, dilate=True), np.float64)
    photographed = []
    for image, angle in zip(images, degrees, strict=True):
        near = np.abs(lights - angle)
        weights = np.exp(-0.5 * (near / REACH) ** 2)
        used = np.flatnonzero(near <= 3 * REACH)
        photographed.append(bool(len(used)))
        if len(used):
            _mix(
                image,
                photographs.select(used.tolist()),
                weights[used] / weights[used].sum(),
                stack,
                math.radians(angle),
            )
    return SphereImages(images, degrees), photographed


def as_published(photographs: BallPhotographs, size: int) -> SphereImages:
    """The paper's way with the same photographs: each is a picture of its own, turned but neither moved, averaged nor
    filled, on black ground, blended by its Eq. 4. Reference: Mihalik2015."""
    x, y = disc(size)
    order = np.argsort(photographs.angles)
    images = np.stack([np.where(np.hypot(x, y)[..., None] < 1, _fetch(photographs, i, x, y)[0], 0) for i in order])
    angles: list[float] = []
    for angle in np.degrees(photographs.angles[order]):
        angles.append(max(float(angle), angles[-1] + SAME_ANGLE if angles else 0.0))
    return SphereImages(np.maximum(images, 0), angles, blend="paper", dilated=False)


def _mix(image: Array, photographs: BallPhotographs, weights: Array, stack: Reflectance, phi: float) -> None:
    """Put the weighted mean of photographs, moved to the light's angle `phi`, in the place of the stack's picture."""
    x, y = disc(len(image))
    # the limb is not seen: what is next to it goes on to the edge of the picture
    shrink = np.minimum(1.0, SEEN_RADIUS / np.maximum(np.hypot(x, y), 1e-9))
    x, y = x * shrink, y * shrink
    here = sphere_radiance(stack, x.ravel(), y.ravel(), phi).reshape(image.shape)
    a, rho = np.arctan2(x, np.sqrt(np.maximum(1 - x * x - y * y, 0))), np.sqrt(np.maximum(1 - y * y, 0))
    lit = a > phi - math.pi / 2
    total, share = PRIOR * here, np.full(x.shape, PRIOR)
    for number, weight in enumerate(weights):
        light = float(photographs.angles[number])
        x_j = rho * np.sin(a + monotone(a, phi, phi) * (light - phi))
        there = sphere_radiance(stack, x_j.ravel(), y.ravel(), light).reshape(image.shape)
        ratio = np.clip((here + FAINT) / (there + FAINT), 1 / RATIO, RATIO)
        for side in (1.0, -1.0):
            value, good = _fetch(photographs, number, x_j, side * y)
            w = 0.5 * weight * (good & lit)
            total = total + w[..., None] * ratio * value
            share = share + w
    image[...] = np.maximum(total / share[..., None], 0)


def _fetch(photographs: BallPhotographs, number: int, x: Array, y: Array) -> tuple[Array, NDArray[np.bool_]]:
    """Bilinear values (..., 3) of a photograph at normals (x, y) with the light in the plane y = 0, and whether all
    four pixels are usable and clear of the limb."""
    light, ball = photographs.lights[number], photographs.ball
    r = math.hypot(light[0], light[1])
    c, s = (light[0] / r, light[1] / r) if r > 1e-9 else (1.0, 0.0)
    column = ball.x - 0.5 + ball.radius * (c * x - s * y)
    row = ball.y - 0.5 - ball.radius * (s * x + c * y)
    picture = photographs.pictures[number]
    height, width = picture.shape[:2]
    inside = (column >= 0) & (column <= width - 1) & (row >= 0) & (row <= height - 1)
    left = np.clip(np.floor(column).astype(np.intp), 0, width - 2)
    top = np.clip(np.floor(row).astype(np.intp), 0, height - 2)
    u, v = np.clip(column - left, 0, 1), np.clip(row - top, 0, 1)
    value = np.zeros((*x.shape, 3))
    good = inside & (np.hypot(x, y) <= SEEN_RADIUS + 1e-6)
    for down, across, share in ((0, 0, (1 - v) * (1 - u)), (0, 1, (1 - v) * u), (1, 0, v * (1 - u)), (1, 1, v * u)):
        value += share[..., None] * picture[top + down, left + across]
        good &= photographs.usable[number, top + down, left + across]
    return value, good
