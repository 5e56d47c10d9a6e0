"""Directional albedo as a small table that a reflectance carries with it: computed once, looked up from then on.

Nodes lie evenly over the square root of cos theta_o, which crowds them at grazing angles, where albedos bend; between
them the albedo is interpolated linearly. Each node knows how far the table is from the integral nearby.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import ReflectanceError
from ...geometry.quadrature import gauss_legendre
from ...reflectance import Reflectance

Array = NDArray[np.floating[Any]]

NODES = 24

NBYTES = NODES * 3 * 2 * 2
"""What a table costs: values and errors, three channels of two bytes each."""

LEAST_ROOT = 0.03
"""The root of the cosine that stands for the horizon, where quadrature and many models fail."""

RULE, COARSE_RULE = (64, 32), (48, 23)
"""Polar angles and azimuths of the quadrature, and of the one whose difference tells its error."""

BETWEEN = (1 / 3, 2 / 3)
"""Where in each interval the interpolation is compared with the integral."""


class AlbedoTable(NamedTuple):
    """Albedo over the root of the cosine; see `tabulate`."""

    values: NDArray[np.float16]
    """(NODES, 3)"""
    errors: NDArray[np.float16]
    """(NODES, 3): the largest difference from the integral that was found up to the neighbouring nodes."""

    def look_up(self, cosine: Array) -> tuple[Array, Array]:
        """Albedo and its error, each (..., 3) float64, for cosines of theta_o (...); 0 below the horizon."""
        position = np.sqrt(np.maximum(cosine, 0)) * (NODES - 1)
        left = np.minimum(position.astype(np.intp), NODES - 2)
        share, above = (position - left)[..., None], (cosine > 0)[..., None]
        tables = (table.astype(np.float64) for table in self)
        albedo, error = (np.where(above, (1 - share) * t[left] + share * t[left + 1], 0.0) for t in tables)
        return albedo, error


def tabulate(m: Reflectance) -> AlbedoTable:
    """The directional albedo of an isotropic reflectance without delta distributions.

    Raises ReflectanceError for an anisotropic one.
    """
    if not m.isotropic:
        raise ReflectanceError(
            f"{m.name or type(m).__name__} is anisotropic; a table of its albedo would need an azimuth: "
            "use `albedo(wo)`, which samples"
        )
    nodes = np.linspace(0, 1, NODES)
    between = (nodes[:-1, None] + np.asarray(BETWEEN) / (NODES - 1)).ravel()
    exact = _albedo(m, np.concatenate([nodes, between]), *RULE)
    values = exact[:NODES].astype(np.float16)
    quadrature = np.abs(exact[:NODES] - _albedo(m, nodes, *COARSE_RULE))
    interpolated, _ = AlbedoTable(values, values).look_up(between**2)
    missed = np.abs(interpolated - exact[NODES:]).reshape(NODES - 1, -1, 3).max(1)
    errors = np.abs(values - exact[:NODES]) + quadrature
    errors[:-1] = np.maximum(errors[:-1], quadrature[:-1] + missed)
    errors[1:] = np.maximum(errors[1:], quadrature[1:] + missed)
    return AlbedoTable(values, np.nextafter(errors.astype(np.float16), np.float16(np.inf)))


def restored(saved: NDArray[Any]) -> AlbedoTable:
    """The table of the array (2, NODES, 3) that its parts were stacked to. Raises ValueError for another array."""
    if saved.shape != (2, NODES, 3) or saved.dtype != np.float16 or not np.isfinite(saved).all():
        raise ValueError(f"an albedo is (2, {NODES}, 3) finite halves, got {saved.shape} {saved.dtype}")
    return AlbedoTable(*saved)


def _albedo(m: Reflectance, root: Array, polar: int, azimuths: int) -> Array:
    """(N, 3) integral of f cos over the half vector, 1 - cos theta_h = u^4, for viewers of the roots (N,) of cosines.

    The azimuths lie a quarter of a step off the plane of incidence: of what is the same on both sides of it, each
    counts as two.
    """
    u, weight = gauss_legendre(polar)
    t, phi = u**4, (np.arange(azimuths) + 0.25) * (2 * math.pi / azimuths)
    radius = np.sqrt(t * (2 - t))[:, None]
    h = np.stack(np.broadcast_arrays(radius * np.cos(phi), radius * np.sin(phi), 1 - t[:, None]), -1).reshape(-1, 3)
    measure = np.repeat(weight * 4 * u**3, azimuths) * (2 * math.pi / azimuths) * 4
    cosine = np.maximum(root, LEAST_ROOT) ** 2
    wo = np.stack([np.sqrt(1 - cosine**2), 0 * cosine, cosine], -1)
    along = wo @ h.T
    wi = 2 * along[..., None] * h - wo[:, None]
    viewer, place = np.nonzero((along > 0) & (wi[..., 2] > 0))
    share = m.f_cos(wi[viewer, place], wo[viewer]) * (measure[place] * along[viewer, place])[:, None]
    return np.stack([np.bincount(viewer, share[:, k], len(root)) for k in range(3)], -1)
