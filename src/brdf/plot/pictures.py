"""Materials as they look: lit spheres in a row, and why snow under an overcast sky shows no shape."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..color import srgb_encode
from ..geometry.directions import from_spherical
from ..models.lambertian import Lambertian
from ..reflectance import Reflectance
from .page import Materials, figure_of, name_of, several, titled

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Floats = NDArray[np.floating[Any]]

SNOW = 0.8
"""Albedo of fresh snow, from the lecture's table of albedos."""

LAMP = (60.0, 150.0)
"""Polar angle and azimuth [degrees] of the lamp over the snow."""


def spheres(m: Materials, angles: Sequence[float] = (20, 70, 120), size: int = 160) -> Figure:
    """Spheres in a row, one a material, for lights at several `angles` [degrees] from the viewer, one a row.

    Radiance pi f cos, as sRGB, clipped: a white diffuser facing the light shows 1. Seen from far away, the light in the
    horizontal plane to the right.
    """
    given = several(m)
    figure = figure_of(0.9 + 5.2 / max(len(given), len(angles)) * len(angles))
    grid = figure.subplots(len(angles), len(given), squeeze=False)
    for row, angle in enumerate(angles):
        for column, one in enumerate(given):
            axes = grid[row, column]
            axes.imshow(srgb_encode(sphere_picture(one, math.radians(angle), size)), interpolation="nearest")
            axes.set(xticks=[], yticks=[])
            axes.spines[:].set_visible(False)
            if row == 0:
                axes.set_title(name_of(one, 72 // len(given)), fontsize=9, parse_math=False)
            if column == 0:
                axes.set_ylabel(f"light {angle:g}°", fontsize=9)
    titled(figure, "spheres in one light each, radiance π f cos as sRGB")
    return figure


def white_out(m: Reflectance | None = None, size: int = 200) -> Figure:
    """A landscape under an overcast sky beside the same under one lamp; snow (albedo 0.8) unless `m` says otherwise.

    Where light of the same radiance comes from everywhere, what is reflected is L_o = rho(wo) L_sky, whichever way the
    ground slopes: the shape of a diffuser cannot be seen. The lamp brings L_o = f cos_i E_lamp, with E_lamp chosen so
    that level ground is as bright in both pictures. Both are exposed alike, for the lamp. No slope shadows another.
    """
    ground = m or Lambertian(albedo=SNOW).named("snow, albedo 0.8")
    frames = _landscape(size)
    up = np.array([0.0, 0.0, 1.0])
    wo = frames @ up
    # the albedo depends on the slope alone, as far as the viewer straight above sees it
    cosine = np.linspace(wo[..., 2].min(), 1, 24)
    table = ground.albedo(from_spherical(np.arccos(cosine), 0.0), 4096)
    overcast = np.stack([np.interp(wo[..., 2], cosine, table[:, c]) for c in range(3)], -1)
    lamp = from_spherical(math.radians(LAMP[0]), math.radians(LAMP[1]))
    wi = frames @ lamp
    level = ground.f_cos(lamp, up).mean()
    lit = ground.f_cos(wi, wo) * (float(ground.albedo(up).mean()) / float(level) if level > 0 else 0.0)
    shown = max(1.0, float(np.quantile(lit, 0.995)))
    figure = figure_of(3.9)
    for axes, picture, title in zip(
        np.ravel(figure.subplots(1, 2)),
        (overcast, lit),
        ("overcast sky: $L_o = \\rho\\,L_{sky}$", "one lamp"),
        strict=True,
    ):
        axes.imshow(srgb_encode(picture / shown), interpolation="nearest")
        axes.set(xticks=[], yticks=[])
        spread = float(picture.mean(-1).std() / picture.mean(-1).mean())
        axes.set_title(title, fontsize=10)
        axes.set_xlabel(f"spread of radiance: {spread:.1%}", fontsize=9)
    titled(figure, f"White-out: {name_of(ground)}\nhills from above, radiance as sRGB, exposed alike")
    return figure


def sphere_picture(m: Reflectance, angle: float, size: int) -> Floats:
    """(size, size, 3) radiance pi f cos of an orthographic sphere on white, the light `angle` [rad] from the viewer."""
    x, y, inside = disc(size)
    z = np.sqrt(1 - x[inside] ** 2 - y[inside] ** 2)
    frames = _frames(np.stack([x[inside], y[inside], z], -1))
    wi, wo = frames @ np.array([math.sin(angle), 0.0, math.cos(angle)]), frames @ np.array([0.0, 0.0, 1.0])
    picture = np.ones((size, size, 3))
    picture[inside] = math.pi * m.f_cos(wi, wo)
    return picture


def disc(size: int) -> tuple[Floats, Floats, NDArray[np.bool_]]:
    """x to the right and y upwards in [-1, 1] at the pixels of a picture (size, size), and which show the sphere."""
    axis = (2 * np.arange(size) + 1) / size - 1
    x, y = np.meshgrid(axis, -axis)
    return x, y, x * x + y * y < 1


def _landscape(size: int) -> Floats:
    """(size, size, 3, 3) frames of gentle hills seen from above."""
    axis = np.linspace(-1, 1, size)
    x, y = np.meshgrid(axis, -axis)
    slope_x, slope_y = np.zeros_like(x), np.zeros_like(x)
    for centre_x, centre_y, width, height in ((-0.4, 0.3, 0.3, 0.16), (0.45, -0.2, 0.35, 0.2), (0.2, 0.65, 0.2, 0.08),
                                              (-0.5, -0.55, 0.25, 0.1)):  # fmt: skip
        hill = height * np.exp(-((x - centre_x) ** 2 + (y - centre_y) ** 2) / (2 * width**2)) / width**2
        slope_x -= hill * (x - centre_x)
        slope_y -= hill * (y - centre_y)
    normal = np.stack([-slope_x, -slope_y, np.ones_like(x)], -1)
    return _frames(normal / np.linalg.norm(normal, axis=-1, keepdims=True))


def _frames(normal: Floats) -> Floats:
    """(..., 3, 3) rows tangent, bitangent, normal; the tangent runs in the horizontal plane of the picture."""
    tangent = np.stack([normal[..., 2], np.zeros_like(normal[..., 0]), -normal[..., 0]], -1)
    tangent /= np.linalg.norm(tangent, axis=-1, keepdims=True)
    return np.stack([tangent, np.cross(normal, tangent), normal], -2)
