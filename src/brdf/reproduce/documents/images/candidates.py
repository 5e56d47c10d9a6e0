"""Everything that errors are measured of, for one material: pictures by number and by bytes, stacks, tables."""

from __future__ import annotations

import functools
import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ....reflectance import Reflectance
from ....representations.baking.slice_stack import SliceStack
from ....representations.spheres.bake import disc
from ....representations.spheres.sphere_images import SphereImages
from ....representations.tables.table import Table
from .settings import COUNTS, METAL, PLASTIC

STORAGE = "rgb9e5"
"""Of the pictures: 4 bytes a texel, high dynamic range."""

TABLE_STORAGE = "10-10-10"
"""Of the tables: 4 bytes a node."""

BYTES = 4
"""A texel, and a node."""

LITERAL = {"full": "Eq. 2, full angles", "half": "half angles", "paper": "Eq. 4, the paper's k"}
"""The paper's blends by name: on black ground, normals shortened, no guard."""
REPAIRED = "Eq. 4, dilated and guarded"
MONOTONE = "monotone k (ours)"
SEPARATED = "diffuse light separated (ours)"
STACK = "slice stack (ours)"
STACK_AT_NODES = "slice stack, baked at the nodes (ours)"
TABLES = {"uniform": "table, even axes", "merl": "table, MERL's axes", "bezier": "table, Bézier axes"}

SPLIT = 4.7
"""Nodes over theta_d for one over phi_d: of the splits tried at 16 and 64 KB the one with the highest mean PSNR."""


class Candidate(NamedTuple):
    """One thing to measure: `key` is the number of pictures, or the budget in KB."""

    sweep: str
    method: str
    key: float
    reflectance: Reflectance


def by_pictures(m: Reflectance, size: int, counts: tuple[int, ...] = COUNTS) -> Iterator[Candidate]:
    """Pictures at i 180/N degrees, in every blend."""
    angles = sorted({180 * i / count for count in counts for i in range(count)})
    dilated = _baked(m, tuple(angles), size)
    for count in counts:
        picked = [angles.index(180 * i / count) for i in range(count)]
        for method, made in blended(dilated[picked], [angles[i] for i in picked]):
            yield Candidate("pictures", method, count, made)


def by_bytes(m: Reflectance, budgets: tuple[int, ...], fitted: tuple[int, ...]) -> Iterator[Candidate]:
    """What fits into each budget [KB]; slice stacks by least squares, which takes its time, in those of `fitted`."""
    for budget in budgets:
        for name, angles, wanted in (
            ("4 pictures", PLASTIC, (*LITERAL.values(), MONOTONE, SEPARATED)),
            ("6 pictures", METAL, (LITERAL["paper"], MONOTONE, SEPARATED)),
        ):
            size = math.isqrt(budget * 1024 // (len(angles) * BYTES))
            for method, made in blended(_baked(m, angles, size), angles):
                if method in wanted:
                    yield Candidate("bytes", f"{name}, {method}", budget, made)
        for warp, method in TABLES.items():
            table = Table.bake(m, basis="half", warp=warp, shape=table_shape(budget), storage=TABLE_STORAGE)
            yield Candidate("bytes", method, budget, table)
        yield Candidate("bytes", STACK_AT_NODES, budget, SliceStack.bake(m, budget * 1024, "points"))
        if budget in fitted:
            yield Candidate("bytes", STACK, budget, SliceStack.bake(m, budget * 1024))


def largest(m: Reflectance, texels: int) -> Iterator[Candidate]:
    """The paper's four pictures at their full size, and at half of it."""
    for size in (texels // 2, texels):
        for method, made in blended(_baked(m, PLASTIC, size), PLASTIC):
            if method in (LITERAL["paper"], MONOTONE, SEPARATED):
                yield Candidate("size", method, size, made)


def blended(dilated: NDArray[np.float32], angles: Any) -> Iterator[tuple[str, SphereImages]]:
    """The same pictures in every blend: the paper's as published, repaired, and ours."""
    spheres = SphereImages(dilated * _inside(dilated.shape[1]), angles, storage=STORAGE, dilated=False)
    for blend, method in LITERAL.items():
        yield method, spheres.with_blend(blend, guard=False, mask=False)
    spheres = SphereImages(dilated, angles, storage=STORAGE, dilated=True)
    yield REPAIRED, spheres.with_blend("paper")
    yield MONOTONE, spheres.with_blend("monotone")
    yield SEPARATED, spheres.with_blend("separated")


def table_shape(budget: int) -> tuple[int, int, int]:
    """Nodes over theta_h, theta_d and phi_d, 2 : 1 : 1/SPLIT, that fit into `budget` KB."""
    nodes = budget * 1024 // BYTES
    shapes = [(2 * n, n, max(2, round(n / SPLIT))) for n in range(2, 200)]
    return next(shape for shape in reversed(shapes) if math.prod(shape) <= nodes)


def _baked(m: Reflectance, angles: tuple[float, ...], size: int) -> NDArray[np.float32]:
    return SphereImages.bake(m, angles=angles, size=size, storage="float32", dilate=True).images


@functools.cache
def _inside(size: int) -> NDArray[np.bool_]:
    x, y = disc(size)
    return (np.hypot(x, y) < 1)[..., None]
