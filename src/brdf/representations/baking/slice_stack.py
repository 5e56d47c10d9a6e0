"""The theta_d slice stack: a reflectance in 16 KB, or as many bytes as there are.

For one light a sphere seen from afar shows a single theta_d: a table over (theta_h, theta_d, phi_d) is a stack of such
pictures. The diffuse floor and the growth towards grazing angles are taken out, logarithms stored, nodes crowded at
small theta_h and grazing theta_d, phi_d folded to a quarter turn and warped so that its first harmonic is linear; the
values at the nodes are what makes the interpolated pictures look most like the exact ones (`least_squares`).

How many nodes each axis gets of a budget depends on the material: a few splits are tried on it.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError, ReflectanceError, UnknownNameError
from ...geometry.directions import from_half_difference
from ...geometry.warps import HALF_PI, Circle, FarPower, Power, SquaredSine, Warp, identity
from ...metrics.sphere import psnr, sphere_pairs
from ...reflectance import Reflectance
from ..tables.albedo_table import NBYTES as ALBEDO_BYTES
from ..tables.anisotropic import AnisotropicHalfBasis
from ..tables.bases import HalfBasis
from ..tables.encoding import Encoding, Log
from ..tables.layout import Layout
from ..tables.table import Table
from .bake import bake_points
from .least_squares import bake_least_squares, rank

Array = NDArray[np.floating[Any]]

BUDGETS = {"16K": 16 << 10, "64K": 64 << 10, "256K": 256 << 10}
"""The usual budgets [bytes]; any other number will do."""

LEAST_BYTES = 512
"""Below this not even the constants and two nodes an axis make a picture."""

MOST_BYTES = 1 << 26

CONSTANT_BYTES = 36
"""Floor, low and span of three channels."""

OVERHEAD = CONSTANT_BYTES + ALBEDO_BYTES
"""Bytes that are not nodes."""

CHOICE_BYTES = 16 << 10
"""The split of bigger budgets is chosen at this size, which is quick."""

MEASURED_FLOOR = 0.002
"""The quantile of measured values that counts as the diffuse floor: their minimum is noise."""

SYMMETRY_TOLERANCE = 0.02
"""Mean difference between mirror images, in parts of the mean value, that counts as none."""

FOLDS = ("quarter-turn", "half-turn", "mirror")
"""Symmetries of phi_d, as `HalfBasis` has them."""

ASYMMETRY = 1e-3
"""Mean difference between images, in parts of the mean value, that a fold may average without another being tried."""

CHOICE_PICTURE = 32
"""Pixels across the pictures of a sphere by which stacks are told apart."""

METHODS = ("least-squares", "points")

ENCODING = Encoding(Log(1e-3), cosine_power=1.5, scale=math.pi)


class Split(NamedTuple):
    """Proportions of the numbers of nodes along theta_h, theta_d, phi_d, and the warp of phi_d."""

    proportions: tuple[float, float, float]
    phi_d: Warp


SPLITS = (
    Split((50, 16, 5), SquaredSine()),
    Split((80, 16, 3), SquaredSine()),  # narrow highlights
    Split((43, 23, 4), SquaredSine()),  # wide ones, with colours that change with the angle
    Split((50, 16, 5), identity()),  # V-grooves: a kink at phi_d = 0
    Split((39, 17, 6), identity()),
)
"""Found on the published fits of 100 materials, microfacet models, and Oren-Nayar's: each is the best of some."""


HALF_TURN = identity(math.pi)
"""The warp of phi_d over half a turn: the first harmonic, cos phi_d, is linear."""

ANISOTROPIC_PROPORTIONS = (20.0, 36.0, 14.0, 7.0)
"""Proportions of the numbers of nodes along phi_h over half a turn, theta_h, theta_d, phi_d over a quarter turn."""


class SliceStack:
    """Makes tables of one kind; `SliceStack.bake(m)` returns a `Table`."""

    @staticmethod
    def layouts(budget: str | int = "16K") -> list[Layout]:
        """The layouts tried within a budget. Raises ParameterError."""
        return [_layout(split, parse_budget(budget)) for split in SPLITS]

    @staticmethod
    def bake(
        m: Reflectance,
        budget: str | int = "16K",
        method: str = "least-squares",
        anisotropic: bool = False,
        fold: str | None = None,
    ) -> Table:
        """`m` as a slice stack of at most `budget` bytes: a number, or a text such as "16K", "24576" or "1M".

        `method` is "least-squares" or "points" (evaluation at the nodes: for photographs; less exact). Of measured
        values the floor is a low quantile, directions that the fold joins are averaged, and of bins outliers count
        little. With `anisotropic` the table has an azimuth, too; its `nbytes` says what that costs.

        `fold` names the symmetries used: "quarter-turn" (reciprocity and mirror symmetry), "half-turn" (reciprocity
        alone) or "mirror" (mirror symmetry alone). By default that of measured values is the one whose pictures are
        nearest, that of all others "quarter-turn". A stack folded by "mirror" is not reciprocal.

        Raises ReflectanceError when `m` is anisotropic and `anisotropic` is not set, ParameterError for an impossible
        budget, or fold, UnknownNameError for an unknown method.
        """
        size = parse_budget(budget)
        if method not in METHODS:
            raise UnknownNameError("bake method", method, METHODS)
        if fold is not None and fold not in FOLDS:
            raise UnknownNameError("fold", fold, FOLDS)
        if anisotropic and fold is not None:
            raise ParameterError("a stack with an azimuth is folded by the symmetries it finds; leave `fold` out")
        if not m.isotropic and not anisotropic:
            raise ReflectanceError(
                f"{m.name or type(m).__name__} is anisotropic; bake it as such (anisotropic=True, --anisotropic), with "
                "one more axis"
            )
        if anisotropic:
            return _baked(m, _anisotropic_layout(m, size), method)
        if method == "points":
            return _baked(m, _layout(SPLITS[0], size, fold or FOLDS[0]), method).with_albedo()
        folds = [fold] if fold else _folds_of(m) if is_measured(m) else FOLDS[:1]
        return _nearest(m, [_fitted(m, size, each) for each in folds]).with_albedo()


def _baked(m: Reflectance, layout: Layout, method: str) -> Table:
    measured = is_measured(m)
    quantile = MEASURED_FLOOR if measured else 0.0
    if method == "points":
        return bake_points(m, layout, quantile, symmetrise=measured)
    return bake_least_squares(m, layout, quantile, symmetrise=measured, robust=isinstance(m, Table) and m.has_holes)


def _fitted(m: Reflectance, size: int, fold: str) -> Table:
    """A stack of the split that suits `m`; with less symmetry, of the one that mostly does.

    Fits to few samples rank the splits; pictures tell the best two apart.
    """
    if fold != FOLDS[0]:
        return _baked(m, _layout(SPLITS[0], size, fold), "least-squares")
    small = min(size, CHOICE_BYTES)
    layouts = SliceStack.layouts(small)
    likely = rank(m, layouts, MEASURED_FLOOR if is_measured(m) else 0.0, symmetrise=False)[:2]
    stack = _nearest(m, [_baked(m, layouts[index], "least-squares") for index in likely])
    if small == size:
        return stack
    return _baked(m, SliceStack.layouts(size)[layouts.index(stack.layout)], "least-squares")


def _folds_of(m: Reflectance) -> list[str]:
    """The folds worth trying: those that spare something that the first one averages."""
    wi, wo = sphere_pairs(CHOICE_PICTURE)
    mirror = np.array([1, -1, 1], np.float32)
    value = m(wi, wo)
    images = {"mirror": (wo, wi), "half-turn": (wi * mirror, wo * mirror)}  # what the fold tells apart
    scale = ASYMMETRY * np.abs(value).mean()
    return [FOLDS[0], *(fold for fold, pair in images.items() if np.abs(m(*pair) - value).mean() > scale)]


def _nearest(m: Reflectance, stacks: list[Table]) -> Table:
    """The stack whose pictures are most like those of `m`."""
    return stacks[0] if len(stacks) == 1 else max(stacks, key=lambda stack: psnr(m, stack, CHOICE_PICTURE))


def _layout(split: Split, size: int, fold: str = "quarter-turn") -> Layout:
    """The layout of so many bytes."""
    basis, nodes = HalfBasis(fold), (size - OVERHEAD) // 4
    first, second, third = split.proportions
    third *= basis.extents[2] / HALF_PI
    azimuths = max(2, round(third * (nodes / (first * second * third)) ** (1 / 3)))
    slices = max(2, round(math.sqrt(nodes / azimuths * second / first)))
    shape = nodes // (azimuths * slices), slices, azimuths
    warps = Power(exponent=2.4), _slices(slices), split.phi_d if fold == "quarter-turn" else HALF_TURN
    return Layout(basis, warps, shape, ENCODING, "10-10-10")


def _anisotropic_layout(m: Reflectance, size: int) -> Layout:
    """The layout with an azimuth of so many bytes, folded by the symmetries that `m` has."""
    half, mirrored = has_half_turn(m), has_mirror(m)
    basis = AnisotropicHalfBasis("quarter-turn" if mirrored else "half-turn", "half" if half else "full")
    proportions = np.array(ANISOTROPIC_PROPORTIONS) * (1 if half else 2, 1, 1, 1 if mirrored else 2)
    nodes = (size - CONSTANT_BYTES) // 4
    rest = proportions * (nodes / proportions.prod()) ** 0.25
    turns, slices, azimuths = (max(least, round(rest[k])) for k, least in ((0, 3), (2, 2), (3, 2)))
    shape = turns, max(2, nodes // (turns * slices * azimuths)), slices, azimuths
    phi_d = SquaredSine() if mirrored else Power(math.pi)
    warps = Circle(basis.extents[0]), Power(exponent=2.4), _slices(slices), phi_d
    return Layout(basis, warps, shape, ENCODING, "10-10-10")


def _slices(count: int) -> Warp:
    return FarPower(math.radians(180 - 64 / count) / 2, exponent=1.5)


def parse_budget(budget: str | int, kind: str = "slice stack", least: int = LEAST_BYTES, most: int = MOST_BYTES) -> int:
    """Bytes of 24576, "24576", "24K" or "1M". Raises ParameterError unless there are between `least` and `most`."""
    text = str(budget).strip().upper().removesuffix("B")
    units = {"K": 1 << 10, "M": 1 << 20}
    unit = units.get(text[-1:], 1)
    digits = text[:-1] if unit > 1 else text
    if not digits.isdecimal():
        raise ParameterError(f"a budget is a number of bytes such as 16384, '16K' or '1M', got {budget!r}")
    size = int(digits) * unit
    if not least <= size <= most:
        raise ParameterError(f"a {kind} has between {least} bytes and {most >> 20} MB, got a budget of {size} bytes")
    return size


def has_half_turn(m: Reflectance) -> bool:
    """Whether turning both directions by half a turn about the normal changes nothing."""
    return _is_symmetric(m, np.array([-1.0, -1.0, 1.0]))


def has_mirror(m: Reflectance) -> bool:
    """Whether mirroring both directions across the tangent changes nothing."""
    return _is_symmetric(m, np.array([1.0, -1.0, 1.0]))


def _is_symmetric(m: Reflectance, image: Array) -> bool:
    """Whether `m` is the same, up to SYMMETRY_TOLERANCE, for both directions times `image`."""
    u = np.random.default_rng(1).random((4, 4096))
    angles = HALF_PI * u[0] ** 2, 2 * math.pi * u[1], HALF_PI * u[2], 2 * math.pi * u[3]
    wi, wo = from_half_difference(*angles)
    clear = (wi[:, 2] > 0.1) & (wo[:, 2] > 0.1)
    wi, wo = wi[clear], wo[clear]
    value, other = m(wi, wo), m(wi * image, wo * image)
    return bool(np.abs(value - other).sum() <= SYMMETRY_TOLERANCE * np.abs(value).sum())


def is_measured(m: Reflectance) -> bool:
    """Whether the values carry the noise and the asymmetry of a measurement: tables with holes, and what needs a search
    to be evaluated."""
    return not m.has_formula or (isinstance(m, Table) and m.has_holes)
