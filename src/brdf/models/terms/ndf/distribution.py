"""What a distribution of facet normals gives, and the widths along tangent and bitangent that several share.

`D(h)` [1/sr] integrates, times h.z, to 1 over the hemisphere. `projected_area(w)` [1] is the area that
the facets facing `w` show it, per area of macrosurface: w.z (1 + Lambda(w)) with Smith's auxiliary function Lambda.
Unlike Lambda it is finite at the horizon.
"""

from __future__ import annotations

from typing import Any

from ....formula import Scalar, Vec, sqrt
from ....geometry.sampling import Sampler
from ....parameters import Parameterised, width

DISTRIBUTIONS: dict[str, type[Distribution]] = {}
"""Every distribution by the name it is chosen by; a distribution enters by being defined with one."""


class Distribution(Parameterised):
    """Base of the distributions."""

    def __init_subclass__(cls, name: str = "", **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        if name:
            DISTRIBUTIONS[name] = cls

    @property
    def isotropic(self) -> bool:
        return True

    def D(self, h: Vec) -> Scalar:
        raise NotImplementedError

    def projected_area(self, w: Vec) -> Scalar:
        raise NotImplementedError

    def slope_width(self) -> Scalar:
        """Width of the Beckmann distribution that this one resembles near its peak: its RMS slope."""
        raise NotImplementedError

    def sampler(self) -> Sampler | None:
        """A sampler of its own, if it has one."""
        return None


class Stretched(Distribution):
    """A distribution of slopes, stretched along tangent and bitangent: equally unless both widths are given."""

    alpha: Scalar = width("width of the distribution", default=0.2)
    alpha_x: Scalar = width("width along the tangent", follows="alpha")
    alpha_y: Scalar = width("width along the bitangent", follows="alpha")

    @property
    def isotropic(self) -> bool:
        return bool(self.alpha_x == self.alpha_y)

    def stretched2(self, w: Vec) -> Scalar:
        """Squared length of the tangential part of w where the surface is stretched to unit width."""
        return (w.x * self.alpha_x) ** 2 + (w.y * self.alpha_y) ** 2

    def slope_width(self) -> Scalar:
        return sqrt(0.5 * (self.alpha_x * self.alpha_x + self.alpha_y * self.alpha_y))
