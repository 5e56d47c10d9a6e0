"""Photographs of a flat sample under a lamp that moves along an arc."""

from .capture import flat
from .sample import FlatSample

__all__ = ["FlatSample", "flat"]
