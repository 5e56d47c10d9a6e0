"""Distributions given by samples: a curve over the angle, or a painted map over the half vector."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....errors import ParameterError
from ....formula import Scalar, Vec, atan2, floor, maximum, pi, sqrt, texture1d, texture2d
from ....formula.backends import backend_of
from ....formula.textures import lookup
from ....geometry.quadrature import gauss_legendre
from ....parameters import texture
from .distribution import Distribution
from .projected_area import area_from, facets_away, node_coordinate

Floats = NDArray[np.floating[Any]]


class PaintedCurve(Distribution, name="curve"):
    """Relative numbers of facets at equidistant angles theta_h from 0 to 90 degrees; normalised here.

    With `masking="smith-separable"` it is Ashikhmin's generator: any distribution of facets makes a reciprocal,
    energy-conserving reflectance. Reference: Ashikhmin2000.
    """

    facets: Any = texture(
        "relative D at equidistant theta_h, 0 to 90 degrees",
        np.exp(-((np.linspace(0, np.pi / 2, 64) / 0.3) ** 2)),
        low=0.0,
    )

    def derived_textures(self) -> dict[str, NDArray[np.float32]]:
        curve = self.facets[:, 0].astype(np.float64)
        theta = np.linspace(0, np.pi / 2, len(curve))
        x, weight = gauss_legendre(4)
        fine = (theta[:-1, None] + x * theta[1]).ravel()
        mass = np.interp(fine, theta, curve) * np.pi * np.sin(2 * fine) * np.tile(weight * theta[1], len(curve) - 1)
        total = _refuse_empty(mass.sum())
        median = np.tan(fine[np.searchsorted(np.cumsum(mass), 0.5 * total)])
        density = curve / total

        def slope_density(t: Floats) -> Floats:
            return np.interp(np.arctan(t), theta, density) / (1 + t * t) ** 2

        return {
            "density": density.astype(np.float32)[:, None],
            "typical_slope": np.full((1, 1), median, np.float32),
            "facets_away": facets_away(slope_density, float(median)),
        }

    def D(self, h: Vec) -> Scalar:
        theta = atan2(sqrt(h.x * h.x + h.y * h.y), h.z)
        return texture1d(self.density, node_coordinate(theta * (2 / pi), self.density.shape[0]))[0]

    def projected_area(self, w: Vec) -> Scalar:
        return area_from(self.facets_away, w.x * w.x + w.y * w.y, w.z)

    def slope_width(self) -> Scalar:
        return texture1d(self.typical_slope, 0.5)[0]


COSINES, AZIMUTHS = 96, 32
"""Directions of the table of projected areas of a map."""

POINTS = 160
"""Places along each side of the map where it is summed."""

_SIDE = (np.arange(32) + 0.5) / 16 - 1


class PaintedMap(Distribution, name="map"):
    """The NDF map of Real-Time Rendering: relative D as a picture over the tangential part of the half vector.

    The first axis runs from h.x = -1 to 1, the second along h.y; texel centres lie at (i + 0.5) / n. The picture
    is normalised here. Reference: AkenineMoller2008.
    """

    facets: Any = texture(
        "relative D over (h.x, h.y) in [-1, 1]^2",
        np.exp(-((_SIDE[:, None] / 0.4) ** 2) - (_SIDE / 0.2) ** 2),
        dimensions=2,
        low=0.0,
    )

    @property
    def isotropic(self) -> bool:
        return False

    def derived_textures(self) -> dict[str, NDArray[np.float32]]:
        side = (np.arange(POINTS) + 0.5) * (2 / POINTS) - 1
        x, y = (c.ravel() for c in np.meshgrid(side, side, indexing="ij"))
        inside = x * x + y * y < 1
        x, y = x[inside], y[inside]
        facets = lookup(self.facets, ((x + 1) / 2, (y + 1) / 2), backend_of())[0]
        total = _refuse_empty(facets.sum() * (2 / POINTS) ** 2)
        seen = facets > 0
        # D cos d omega is D dx dy; facets of slope (x, y) / z show their own cosine to w over z
        mass = (facets / facets.sum())[seen]
        slopes = np.stack([x, y], -1)[seen] / np.sqrt(1 - x * x - y * y)[seen, None]
        cosine = np.linspace(0, 1, COSINES)[:, None] ** 2
        phi = np.linspace(0, 2 * np.pi, AZIMUTHS + 1)
        away = np.zeros((COSINES, AZIMUTHS + 1, 1), np.float32)
        directions = np.stack([np.cos(phi), np.sin(phi)], -1)
        for j, direction in enumerate(directions):
            along = slopes @ direction
            away[:, j, 0] = np.maximum(np.sqrt(1 - cosine**2) * along - cosine, 0) @ mass
        return {"density": (self.facets / total).astype(np.float32), "facets_away": away}

    def D(self, h: Vec) -> Scalar:
        return texture2d(self.density, 0.5 + 0.5 * h.x, 0.5 + 0.5 * h.y)[0]

    def projected_area(self, w: Vec) -> Scalar:
        turn = atan2(w.y, w.x) / (2.0 * pi)
        phi = turn - floor(turn)
        cosine = node_coordinate(sqrt(maximum(w.z, 0.0)), COSINES)
        return w.z + texture2d(self.facets_away, cosine, node_coordinate(phi, AZIMUTHS + 1))[0]

    def slope_width(self) -> Scalar:
        # a Beckmann surface of width m hides m / (2 sqrt(pi)) at the horizon
        return texture2d(self.facets_away, 0.0, 0.5)[0] * (2.0 * sqrt(pi))


def _refuse_empty(total: Any) -> float:
    if not total > 0:
        raise ParameterError("facets must hold some facets: all samples inside the hemisphere are 0")
    return float(total)
