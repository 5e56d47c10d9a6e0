"""Figures of reflectances: lobes, slices, albedo, Fresnel curves, spheres; profiles of subsurface scattering.

Every function returns a matplotlib figure without touching matplotlib's global state, so it works in a server or a
thread; `save(figure, "x.png" | "x.svg" | "x.html")` writes it. Sizes are made for 600 pixels of width (100 dpi). Those
that take several reflectances lay them over each other.
"""

from __future__ import annotations

from .comparison import compared, comparison
from .coverage import coverage
from .curves import albedo, profile
from .fitted import fitted
from .fresnel_curves import fresnel
from .maps import slices, solid
from .overview import overview
from .page import figure_format, save
from .pareto import candidates
from .pictures import spheres, white_out
from .polar import cartesian, lobes

__all__ = [
    "albedo", "candidates", "cartesian", "compared", "comparison", "coverage", "figure_format", "fitted", "fresnel",
    "lobes", "overview", "profile", "save", "slices", "solid", "spheres", "white_out",
]  # fmt: skip
