"""Photographs to representations: pictures of a coated sphere, pictures of a flat sample under a moving lamp."""

from .ball.capture import sphere
from .ball.captured import Captured
from .ball.coverage import Coverage
from .ball.fit_samples import sphere_samples
from .ball.hold_out import HeldOut
from .flat_sample import FlatSample, flat
from .simulation import simulate, simulate_btf

__all__ = [
    "Captured",
    "Coverage",
    "FlatSample",
    "HeldOut",
    "flat",
    "simulate",
    "simulate_btf",
    "sphere",
    "sphere_samples",
]
