"""Photographs to representations: pictures of a coated sphere, pictures of a flat sample under a moving lamp."""

from .captured import Captured
from .coverage import Coverage
from .hold_out import HeldOut
from .sphere_capture import sphere

__all__ = ["Captured", "Coverage", "HeldOut", "sphere"]
