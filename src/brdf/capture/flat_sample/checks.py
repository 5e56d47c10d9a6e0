"""What pictures under a moving lamp tell about the way they were taken, and about the sample."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...color import luminance

Floats = NDArray[np.floating[Any]]

BLOCKS = 8
"""Blocks across a picture whose means show a gradient."""
GRADIENT = 0.1
"""Change of brightness across a picture, over its mean, from which a warning is due."""
CLIPPED = 0.001
"""Share of saturated pixels from which a warning is due."""
ANISOTROPY = 0.35
"""Anisotropy of the shading from which a warning is due."""


@dataclass(frozen=True)
class Checks:
    """Figures of M pictures."""

    averages: Floats
    """(M,) mean luminance"""
    gradients: Floats
    """(M, 2) change of brightness from the left edge to the right and from the bottom to the top, over the mean"""
    clipped: Floats
    """(M,) share of pixels that are saturated"""
    anisotropy: float
    """of the picture under the highest lamp, whose shading prefers no direction: 0 (none) to 1 (parallel lines)"""

    @property
    def monotone(self) -> bool:
        """Whether the averages never rise as the lamp goes down."""
        return bool((np.diff(self.averages) <= 0).all())


def checks_of(images: Floats, clipped: Floats | None = None) -> Checks:
    """The figures of (M, H, W, 3) linear pictures in order of the lamp's angle from the normal."""
    averages, gradients = [], []
    for image in images:
        grey = luminance(image)
        mean = float(grey.mean(dtype=np.float64))
        averages.append(mean)
        gradients.append(_gradient(grey) / mean if mean > 0 else np.zeros(2))
    saturated = np.zeros(len(images)) if clipped is None else np.asarray(clipped)
    return Checks(np.array(averages), np.array(gradients), saturated, anisotropy_of(_structure(luminance(images[0]))))


def anisotropy_of(structure: Floats) -> float:
    """(l1 - l2) / (l1 + l2) of the eigenvalues of a structure tensor (2, 2): 0 for no direction, 1 for one."""
    low, high = np.linalg.eigvalsh(structure)
    return float((high - low) / (high + low)) if high > 0 else 0.0


def _gradient(grey: Floats) -> Floats:
    """(2,) change of a fitted plane across the picture, to the right and upwards, robust to the sample's own pattern.

    Fitted to medians of blocks: a plane through all pixels follows single bright spots.
    """
    height, width = grey.shape
    rows, columns = min(BLOCKS, height), min(BLOCKS, width)
    blocks = [
        [float(np.median(part)) for part in np.array_split(band, columns, 1)] for band in np.array_split(grey, rows, 0)
    ]
    values = np.array(blocks)
    x = (np.arange(columns) + 0.5) / columns - 0.5
    y = 0.5 - (np.arange(rows) + 0.5) / rows
    along_x = x @ values.mean(0) / (x @ x) if columns > 1 else 0.0
    along_y = y @ values.mean(1) / (y @ y) if rows > 1 else 0.0
    return np.array([along_x, along_y])


def _structure(grey: Floats) -> Floats:
    """(2, 2) mean product of the slopes."""
    if min(grey.shape) < 3:
        return np.zeros((2, 2))
    right = (grey[1:-1, 2:] - grey[1:-1, :-2]) / 2
    up = (grey[:-2, 1:-1] - grey[2:, 1:-1]) / 2
    cross = float(np.mean(right * up))
    return np.array([[float(np.mean(right * right)), cross], [cross, float(np.mean(up * up))]])


def warnings_of(checks: Checks, elevations: Floats) -> list[str]:
    """Sentences about what is wrong or unusual."""
    said = []
    if checks.averages[-1] > 1.5 * checks.averages[0]:
        said.append(
            "averages rise with the angle: are the angles measured from the surface? They must be from the normal"
        )
    elif not checks.monotone:
        worst = int(np.argmax(np.diff(checks.averages)))
        said.append(
            f"averages do not fall all the way: the picture at {elevations[worst + 1]:.4g}° is brighter than the one "
            f"at {elevations[worst]:.4g}° (the sample glows at grazing angles, or the lamp's brightness changed)"
        )
    steep = np.abs(checks.gradients)
    usual = elevations <= 60
    if usual.any() and float(np.median(steep[usual].max(1))) > GRADIENT:
        share = float(np.median(steep[usual].max(1)))
        said.append(
            f"brightness changes by {share:.0%} across a picture: the lamp is too near (give --white), or the "
            "sample is not flat"
        )
    if checks.clipped.max() > CLIPPED:
        at = int(np.argmax(checks.clipped))
        said.append(
            f"{checks.clipped[at]:.1%} of the picture at {elevations[at]:.4g}° is saturated: expose shorter, or bracket"
        )
    if checks.anisotropy > ANISOTROPY:
        said.append(
            f"the relief has a direction (anisotropy {checks.anisotropy:.2f}), and a shading map knows one arc of lamps"
        )
    return said
