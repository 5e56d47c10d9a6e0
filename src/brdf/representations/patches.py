"""Reflectance between patches of two hemispheres: the matrices of daylighting.

Each hemisphere is divided into bands of the polar angle and each band into equal patches of the azimuth, the first of
which is centred on azimuth 0. One value belongs to each pair of an incident and an outgoing patch. Reference:
Klems1994.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..formula import Scalar, Vec, atan2, floor, texture2d, where
from ..reflectance import Reflectance

MOST_BANDS = 40
"""What a formula can hold: each band is a choice on every lookup."""


class Patches(Reflectance):
    """One value for each pair of patches, constant over them.

        f(wi, wo) = values[patch(-azimuth of wi), patch(wo)]      [1/sr]

    The incident direction is numbered by the azimuth opposite to it, so that mirror reflection lies on the diagonal.
    Neither reciprocal nor continuous in general.
    """

    breaks: ClassVar[Mapping[str, str]] = {
        "reciprocity": "each side of the matrix is measured or computed by itself [Klems1994]"
    }

    matrix: Any
    """The texture, as `self` has it inside the formula."""

    def __init__(self, values: ArrayLike, limits: ArrayLike, counts: Sequence[int]) -> None:
        """`values` (P, P, 3) in 1/sr, incident patch first; `limits` (bands + 1,): the polar angles [rad] between the
        bands, from 0 to pi/2; `counts` (bands,): patches in each band, P in all. Raises ValueError.
        """
        self.limits: NDArray[np.float64] = np.asarray(limits, np.float64)
        self.counts = tuple(int(count) for count in counts)
        with np.errstate(over="ignore"):
            self.patch_values: NDArray[np.float32] = np.ascontiguousarray(values, np.float32)
        total = sum(self.counts)
        if not 1 <= len(self.counts) <= MOST_BANDS or len(self.limits) != len(self.counts) + 1 or min(self.counts) < 1:
            raise ValueError(f"there must be 1 to {MOST_BANDS} bands of one or more patches, and a limit more")
        if self.limits[0] != 0 or np.any(np.diff(self.limits) <= 0) or abs(self.limits[-1] - math.pi / 2) > 1e-6:
            raise ValueError("the bands must go from 0 to a right angle")
        if self.patch_values.shape != (total, total, 3):
            raise ValueError(f"values must be ({total}, {total}, 3), got {self.patch_values.shape}")
        if not np.isfinite(self.patch_values).all():
            raise ValueError("values must be finite")

    @property
    def isotropic(self) -> bool:
        return False

    @property
    def structure(self) -> tuple[Any, ...]:
        return (Patches, tuple(self.limits), self.counts)

    @property
    def textures(self) -> Mapping[str, NDArray[Any]]:
        """The values, incident patch first."""
        return {"matrix": self.patch_values}

    def f(self, wi: Vec, wo: Vec) -> Vec:
        count = sum(self.counts)
        incident, outgoing = self.patch(Vec(-wi.x, -wi.y, wi.z)), self.patch(wo)
        value: Vec = texture2d(self.matrix, (incident + 0.5) / count, (outgoing + 0.5) / count, filter="nearest")
        return value

    def patch(self, w: Vec) -> Scalar:
        """The formula: the number of the patch in which a direction lies."""
        turns = atan2(w.y, w.x) * (0.5 / math.pi)
        turns = where(turns < 0.0, turns + 1.0, turns)
        number: Scalar = 0.0
        before = 0
        for limit, count in zip(np.cos(self.limits[:-1]).tolist(), self.counts, strict=True):
            place = floor(turns * count + 0.5)
            within = before + where(place < count - 0.5, place, 0.0)
            number = within if before == 0 else where(w.z <= limit, within, number)
            before += count
        return number

    def _state(self) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
        return {"counts": list(self.counts)}, {"values": self.patch_values, "limits": self.limits}

    @classmethod
    def _restore(cls, header: Any, arrays: Mapping[str, NDArray[Any]], children: Any) -> Reflectance:
        return cls(arrays["values"], arrays["limits"], header["counts"])

    def __repr__(self) -> str:
        return f"Patches({self.name!r}, {sum(self.counts)} x {sum(self.counts)})"
