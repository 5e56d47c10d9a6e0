"""Photographs to representations: pictures of a coated sphere, pictures of a flat sample under a moving lamp."""

from .captured import Captured
from .coverage import Coverage
from .flat_sample import FlatSample, flat
from .hold_out import HeldOut
from .simulation import simulate, simulate_btf
from .sphere_capture import sphere

__all__ = ["Captured", "Coverage", "FlatSample", "HeldOut", "flat", "simulate", "simulate_btf", "sphere"]
