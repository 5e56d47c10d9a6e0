"""From photographs of a flat sample to the pictures of a shading map."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...color import luminance
from ...errors import ParameterError, UnknownNameError
from ...geometry.warps import uniform
from ...reflectance import Reflectance
from ..tables.bases import HalfBasis
from ..tables.encoding import Encoding
from ..tables.layout import Layout
from ..tables.table import Table
from .slices import Slices
from .stack import MOST_NODES, average

Picture = NDArray[np.float32]

ANGLES = 721
"""Nodes of the average BRDF over 180 degrees between light and viewer: photographs at quarter degrees lie on one."""


class Kept(NamedTuple):
    """What a shading map is made of."""

    slices: Slices
    elevations: NDArray[np.float64]
    """(N,) the light's angle from the normal [degrees] of each picture, darkest first"""
    photographed: NDArray[np.float64]
    """(M, 2) angle and average radiance of every photograph"""
    dropped: tuple[float, ...]
    """Angles of the photographs that were left out"""


MODES = ("native", "paper")
BRANCHES = ("descending", "all")


def pictures_of(photographs: Sequence[ArrayLike], elevations: ArrayLike, mode: str, slices: int, branch: str) -> Kept:
    """See `ShadingMap.from_images`."""
    for kind, given, known in (("shading map mode", mode, MODES), ("branch", branch, BRANCHES)):
        if given not in known:
            raise UnknownNameError(kind, str(given), known)
    angles, photos = _checked(photographs, elevations)
    averages = np.array([average(photo) for photo in photos])
    if not averages.all():
        raise ParameterError(f"the photograph at {angles[np.argmin(averages)]:g} degrees is all black; leave it out")
    chosen = _branch(angles, averages) if branch == "descending" else _sorted(averages)
    left_out = sorted(set(range(len(angles))) - set(chosen))
    if mode == "paper":
        stack, at = _even(photos, averages, angles, chosen, slices)
    else:
        if len(chosen) > MOST_NODES:
            raise ParameterError(f"{len(chosen)} photographs are too many to keep each; use at most {MOST_NODES}, "
                                 "or mode='paper'")  # fmt: skip
        stack, at = np.stack([photos[k] for k in chosen], 2), angles[list(chosen)]
    return Kept(Slices(stack), at, np.stack([angles, averages], -1), tuple(float(angles[k]) for k in left_out))


def average_brdf(photographed: NDArray[np.float64]) -> Table:
    """The sample's own average BRDF, from the angles and averages (M, 2) of its photographs.

    f = a / cos theta was measured at the angles theta between light and camera, the camera on the normal: there
    theta = 2 theta_h. It is taken to depend on theta_h alone, which is reciprocal and lets a highlight follow the
    mirror direction; in between it is a monotone cubic, beyond the last photograph constant. Gray, as the lookup is.
    """
    from scipy.interpolate import PchipInterpolator

    theta, averages = photographed[np.argsort(photographed[:, 0])].T
    f = averages / np.cos(np.radians(theta))
    mirrored = theta > 0  # the other side of the normal is the same: level at the pole
    curve = PchipInterpolator(np.r_[-theta[mirrored][::-1], theta], np.r_[f[mirrored][::-1], f])
    at = curve(np.minimum(np.arange(ANGLES) * (180 / (ANGLES - 1)), theta[-1]))
    layout = Layout(HalfBasis("quarter-turn"), (uniform(), uniform(), uniform()), (ANGLES, 2, 2), Encoding())
    stored = np.broadcast_to(at[:, None, None, None], (*layout.shape, 3))
    return Table.encoded(layout, stored).named("average BRDF of the sample")


def matching_sigma(brdf: Reflectance, photographed: NDArray[np.float64]) -> float:
    """The factor that brings brdf · cos nearest to the photographs' averages (least squares). Raises ParameterError."""
    theta, averages = np.radians(photographed[:, 0]), photographed[:, 1]
    wi = np.stack([np.sin(theta), np.zeros_like(theta), np.cos(theta)], -1)
    r = luminance(brdf.f_cos(wi, np.array([0.0, 0.0, 1.0])))
    if not r.any() or not np.isfinite(r).all():
        raise ParameterError("the BRDF shows the camera no light at the photographs' angles; give sigma")
    return float(averages @ r / (r @ r))


def _checked(photographs: Sequence[ArrayLike], elevations: ArrayLike) -> tuple[NDArray[np.float64], list[Picture]]:
    """Angles, increasing, and the photographs in that order. Raises ParameterError."""
    try:
        angles = np.asarray(elevations, np.float64)
        photos = [np.maximum(np.asarray(photo, np.float32), 0) for photo in photographs]
    except (TypeError, ValueError):
        raise ParameterError("photographs and elevations must be arrays of numbers") from None
    if angles.shape != (len(photos),):
        raise ParameterError(f"{len(photos)} photographs need as many elevations, got shape {angles.shape}")
    if len(photos) < 2:
        raise ParameterError(f"a shading map needs at least 2 photographs, got {len(photos)}")
    if not np.all((angles >= 0) & (angles < 90)):
        raise ParameterError("elevations are angles of the light from the normal, in [0, 90) degrees")
    for number, photo in enumerate(photos, 1):
        if photo.ndim != 3 or photo.shape[-1] != 3 or not photo.size:
            raise ParameterError(f"photograph {number} must be (rows, columns, 3), got {photo.shape}")
        if photo.shape != photos[0].shape:
            raise ParameterError(f"photograph {number} is {photo.shape[:2]}, the first {photos[0].shape[:2]}: "
                                 "they must be of one size")  # fmt: skip
        if not np.isfinite(photo).all():
            raise ParameterError(f"photograph {number} holds NaN or infinity")
    order = np.argsort(angles, kind="stable")
    if (np.diff(angles[order]) == 0).any():
        raise ParameterError("two photographs have the same elevation")
    return angles[order], [photos[k] for k in order]


def _branch(angles: NDArray[Any], averages: NDArray[Any]) -> list[int]:
    """Photographs from the brightest one towards grazing light, each darker than all before; dark first."""
    kept = [int(np.argmax(averages))]
    for k in range(kept[0] + 1, len(angles)):
        if averages[k] < averages[kept[-1]]:
            kept.append(k)
    if len(kept) < 2:
        raise ParameterError("the photographs only grow brighter towards grazing light; use branch='all'")
    return kept[::-1]


def _sorted(averages: NDArray[Any]) -> list[int]:
    """All photographs, dark first; of equally bright ones the first."""
    return [int(k) for k in np.unique(averages, return_index=True)[1]]


def _even(
    photos: list[Picture], averages: NDArray[Any], angles: NDArray[Any], chosen: list[int], count: int
) -> tuple[NDArray[np.float32], NDArray[np.float64]]:
    """Pictures whose averages are i a_max / (count - 1), from the two that bracket each; the black one is left out.

    Reference: Kautz2004, equation 1. Interpolating between the two with the closest averages, as its text says,
    extrapolates to negative pixels at the dark end.
    """
    if not isinstance(count, (int, np.integer)) or not 2 <= count <= MOST_NODES + 1:
        raise ParameterError(f"slices must be a whole number in [2, {MOST_NODES + 1}], got {count!r}")
    a, theta = np.r_[0.0, averages[chosen]], np.r_[90.0, angles[chosen]]
    pictures = [np.zeros_like(photos[0]), *(photos[k] for k in chosen)]
    wanted = np.arange(1, count) * (a[-1] / (count - 1))
    above = np.searchsorted(a, wanted).clip(1, len(a) - 1)
    share = np.clip((wanted - a[above - 1]) / (a[above] - a[above - 1]), 0, 1)
    made = [
        ((1 - t) * pictures[k - 1].astype(np.float64) + t * pictures[k]).astype(np.float32)
        for k, t in zip(above, share, strict=True)
    ]
    return np.stack(made, 2), theta[above - 1] + share * (theta[above] - theta[above - 1])
