"""Pictures of a flat sample under a lamp on an arc: what a capture yields, what the simulator makes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .checks import Checks, checks_of, warnings_of

Floats = NDArray[np.floating[Any]]


@dataclass(frozen=True)
class FlatSample:
    """Linear pictures of one sample by a fixed camera straight above, ordered by the lamp's angle."""

    images: NDArray[np.float32]
    """(M, H, W, 3) radiance [1/sr] under irradiance 1 on a plane that faces the lamp"""
    elevations: Floats
    """(M,) the lamp's angle from the normal [degrees], rising"""
    name: str = "sample"
    source: str = ""
    scale_known: bool = False
    """whether the pictures' brightness is absolute; else the sample was taken to have a certain albedo"""
    clipped: Floats | None = None
    """(M,) share of saturated pixels"""
    facts: Sequence[str] = field(default_factory=tuple)

    def __post_init__(self) -> None:
        order = np.argsort(self.elevations, kind="stable")
        if (np.diff(order) < 0).any():
            object.__setattr__(self, "images", self.images[order])
            object.__setattr__(self, "elevations", np.asarray(self.elevations)[order])
            object.__setattr__(self, "clipped", None if self.clipped is None else np.asarray(self.clipped)[order])

    @cached_property
    def checks(self) -> Checks:
        """Figures of the pictures."""
        return checks_of(self.images, self.clipped)

    @property
    def averages(self) -> Floats:
        """(M,) mean luminance of the pictures: a_i of Kautz2004."""
        return self.checks.averages

    @property
    def warnings(self) -> list[str]:
        """What is wrong or unusual about the pictures, one sentence each."""
        return warnings_of(self.checks, self.elevations)
