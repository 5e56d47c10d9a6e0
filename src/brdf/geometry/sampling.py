"""Samplers: distributions over the direction to the light, given the direction to the viewer."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.floating[Any]]


class Sampler(Protocol):
    """A distribution of `wi` given `wo`."""

    def sample(self, wo: Floats, u: Floats) -> tuple[Floats, NDArray[np.bool_]]:
        """(N, 3) viewing directions, (N, 2) numbers in [0, 1) -> (N, 3) directions, (N,) whether each is a delta event."""
        ...

    def pdf(self, wi: Floats, wo: Floats) -> Floats:
        """(N, 3), (N, 3) -> (N,) density of `sample`, 1/sr."""
        ...


class MixtureSampler:
    """Chooses one of several samplers with fixed weights; its density is the weighted sum of theirs."""

    def __init__(self, samplers: Sequence[Sampler], weights: Sequence[float]) -> None:
        raise NotImplementedError


class CosineSampler:
    """Density cos/pi over the upper hemisphere."""


class TabulatedSampler:
    """For any reflectance."""

    def __init__(self, reflectance: Any, isotropic: bool) -> None:
        raise NotImplementedError


class GGXSampler:
    """Mirrors `wo` in a visible normal of a GGX surface."""

    def __init__(self, alpha_x: float, alpha_y: float) -> None:
        self.alpha_x, self.alpha_y = alpha_x, alpha_y
