"""Samples that need no camera: height fields with reflectances on them, and their pictures."""

from .pictures import ELEVATIONS, micro_surface, names, simulate, simulate_btf
from .surface import Layer, MicroSurface

__all__ = ["ELEVATIONS", "Layer", "MicroSurface", "micro_surface", "names", "simulate", "simulate_btf"]
