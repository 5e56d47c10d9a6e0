"""Slices over half and difference angle, and the lobe as a solid."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ..color import luminance, srgb_encode
from ..geometry.directions import from_half_difference, from_spherical
from ..reflectance import Reflectance
from .page import figure_of, log_range, name_of, titled

if TYPE_CHECKING:
    from matplotlib.figure import Figure, FigureBase

HEIGHT, SOLID_HEIGHT = 3.2, 4.6
DECADES = 4
"""How many powers of ten below the largest value are still figure."""


def slices(m: Reflectance, phi_d: float = 90.0, size: int = 192) -> Figure:
    """f over half and difference angle at one azimuth `phi_d` [degrees]: in colour, and its luminance on a log scale.

    theta_h runs to the right, spread by a square root so that narrow highlights show; theta_d runs up. Below the
    horizon nothing is figure.
    """
    figure = figure_of(HEIGHT)
    titled(figure, f"{name_of(m)}\n{draw_slices(figure, m, phi_d, size)}")
    return figure


def solid(m: Reflectance, angle: float = 45.0, size: int = 121) -> Figure:
    """The lobe for light from polar `angle` [degrees] as a solid: its radius in a direction is f, logarithmic.

    The scale is the luminance of f [1/sr], over four powers of ten; colour says the same. The light comes along the
    line from the left.
    """
    from matplotlib import colormaps
    from matplotlib.colors import LogNorm

    figure = figure_of(SOLID_HEIGHT, layout=None)
    axes: Any = figure.add_axes((0.02, -0.02, 0.8, 0.95), projection="3d")
    wi = from_spherical(-math.radians(angle), 0.0)
    # finer around the mirror direction, where the lobe is: distance from it grows as a square
    u, v = np.meshgrid(np.linspace(0, 1, size), np.linspace(-1, 1, 2 * size - 1))
    theta, phi = np.arccos(np.clip(u, 1e-3, 1)), math.pi * np.sign(v) * v * v
    value = luminance(m(wi, from_spherical(theta, phi)))
    top, bottom = log_range(value, DECADES)
    radius = (np.log10(np.maximum(value, 10.0**bottom)) - bottom) / (top - bottom)
    norm = LogNorm(10.0**bottom, 10.0**top)
    shell = from_spherical(theta, phi) * radius[..., None]
    colours = colormaps["cividis"](norm(np.maximum(value, 10.0**bottom)))
    axes.plot_surface(*np.moveaxis(shell, -1, 0), facecolors=colours, rcount=121, ccount=121, lw=0, antialiased=False)
    axes.plot(*np.stack([wi * 1.15, 0 * wi], -1), color="#D55E00", lw=2)
    axes.text(*(wi * 1.25), f"light, {angle:g}°", fontsize=9, ha="center")
    ring = np.linspace(0, 2 * math.pi, 100)
    axes.plot(np.cos(ring), np.sin(ring), 0 * ring, color="0.6", lw=0.8)
    axes.set_box_aspect((2, 2, 1), zoom=1.35)
    axes.set(xlim=(-1, 1), ylim=(-1, 1), zlim=(0, 1))
    axes.view_init(elev=22, azim=-70)
    axes.set_axis_off()
    bar = figure.add_axes((0.84, 0.2, 0.025, 0.55))
    from matplotlib.cm import ScalarMappable

    figure.colorbar(ScalarMappable(norm, "cividis"), cax=bar, label="f [1/sr]")
    titled(figure, f"{name_of(m)}\nlobe as a solid, luminance of f, logarithmic")
    return figure


def draw_slices(figure: FigureBase, m: Reflectance, phi_d: float = 90.0, size: int = 192) -> str:
    from matplotlib.colors import LogNorm

    axes_pair: Any = figure.subplots(1, 2, sharey=True)
    colour_axes, log_axes = axes_pair
    spread = (np.arange(size) + 0.5) / size
    theta_h, theta_d = np.meshgrid(spread**2 * math.pi / 2, spread * math.pi / 2)
    wi, wo = from_half_difference(theta_h, 0.0, theta_d, math.radians(phi_d))
    value = m(wi, wo)
    below = (wi[..., 2] <= 0) | (wo[..., 2] <= 0)
    extent = (0.0, 1.0, 0.0, 90.0)
    picture = np.where(below[..., None], 1.0, srgb_encode(math.pi * value))
    colour_axes.imshow(picture, origin="lower", extent=extent, aspect="auto")
    colour_axes.set_title("πf as a colour (sRGB, clipped)", fontsize=10)
    bright = np.ma.masked_array(luminance(value), below)
    # the few nodes next to grazing incidence would take the whole scale
    shown = bright.compressed()
    top, bottom = log_range(shown[shown <= np.quantile(shown, 0.99)], DECADES)
    norm = LogNorm(10.0**bottom, 10.0**top)
    mapped = log_axes.imshow(bright, origin="lower", extent=extent, aspect="auto", cmap="cividis", norm=norm)
    log_axes.set_title("luminance of f", fontsize=10)
    figure.colorbar(mapped, ax=log_axes, label="f [1/sr]", extend="both")
    ticks = (0, 2, 10, 25, 50, 90)
    for axes in (colour_axes, log_axes):
        axes.set_xticks([math.sqrt(t / 90) for t in ticks], [f"{t}°" for t in ticks])
        axes.set_yticks(range(0, 91, 30), [f"{t}°" for t in range(0, 91, 30)])
        axes.set_xlabel("half angle θh")
        axes.tick_params(labelsize=9)
    colour_axes.set_ylabel("difference angle θd")
    return f"slice at φd = {phi_d:g}°"
