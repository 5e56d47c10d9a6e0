"""Light reflected at shading points: from lights without extent, and from an environment.

Everything is evaluated in large flat batches, one call to the reflectance for all points, so that its compiled kernel
does the work.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..reflectance import Reflectance
from . import points as sequence
from . import surface_kernels as kernels
from .compiled import in_parallel
from .environment import Environment
from .lights import Light
from .visibility import ShadingPoints, Surface

Floats = NDArray[np.float32]


def from_light(reflectance: Reflectance, at: ShadingPoints, light: Light, shadows: Surface | None) -> Floats:
    """Radiance (N, 3) towards the viewer, f cos E, shadowed by `shadows` where one is given."""
    world, distances, irradiance = light.seen_from(at.points)
    local = at.to_local(world)
    reflected = np.zeros((len(local), 3), np.float32)
    lit = np.flatnonzero(_usable(reflectance, local))
    wi = local[lit]
    value = _weighed(reflectance(wi, at.views[lit], at.uvs[lit]), irradiance[lit], np.abs(wi[:, 2]))
    _add_visible(reflected, lit, value, at, wi[:, 2], world[lit], distances[lit], shadows)
    return reflected


class EnvironmentPass:
    """Light from an environment, estimated with two kinds of directions at once.

    Each round draws one direction by the environment's brightness and one by the reflectance, and weighs both by the
    balance heuristic [Veach1995]: bright lamps on matte surfaces and sharp reflections both come out clean.
    `pixels` (N,): the pixel of each point; `ranks` (N,): which of its pixel's `per_pixel` sub-samples it is.
    """

    def __init__(
        self, environment: Environment, pixels: NDArray[np.int32], ranks: NDArray[np.int32], per_pixel: int,
        rounds: int, width: int, seed: int,
    ) -> None:  # fmt: skip
        self.environment, self.ranks, self.per_pixel, self.rounds, self.seed = (
            environment, ranks, per_pixel, rounds, seed,
        )  # fmt: skip
        self.positions = np.empty(len(pixels), np.uint32)
        in_parallel(sequence.along_curve, len(pixels), pixels, width, seed, self.positions)

    def _numbers(self, part: NDArray[np.int64], round_number: int, stream: int) -> Floats:
        u = np.empty((len(part), 2), np.float32)
        in_parallel(
            sequence.fill, len(part), self.positions[part], self.ranks[part], self.rounds, round_number,
            self.per_pixel * self.rounds, (self.seed * 2 + stream) & 0xFFFFFFFF, u,
        )  # fmt: skip
        return u

    def reflected(
        self, reflectance: Reflectance, at: ShadingPoints, part: NDArray[np.int64], shadows: Surface | None,
        step: Callable[[], None],
    ) -> Floats:  # fmt: skip
        """Radiance (N, 3) towards the viewer for the points `at`, numbers `part` of all; calls `step` each round."""
        total = np.zeros((len(part), 3), np.float32)
        for round_number in range(self.rounds):
            self._by_brightness(total, reflectance, at, self._numbers(part, round_number, 0), shadows)
            self._by_reflectance(total, reflectance, at, self._numbers(part, round_number, 1), shadows)
            step()
        return total / np.float32(self.rounds)

    def _by_brightness(
        self, total: Floats, reflectance: Reflectance, at: ShadingPoints, u: Floats, shadows: Surface | None
    ) -> None:
        world, radiance, density = self.environment.sample(u)
        local = at.to_local(world)
        lit = np.flatnonzero(_usable(reflectance, local) & (density > 0))
        wi, wo = local[lit], at.views[lit]
        other = np.asarray(reflectance.pdf(wi, wo), np.float32)
        factor = np.abs(wi[:, 2]) / (density[lit] + other)
        value = _weighed(reflectance(wi, wo, at.uvs[lit]), radiance[lit], factor)
        _add_visible(total, lit, value, at, wi[:, 2], world[lit], None, shadows)

    def _by_reflectance(
        self, total: Floats, reflectance: Reflectance, at: ShadingPoints, u: Floats, shadows: Surface | None
    ) -> None:
        drawn = reflectance.sample(at.views, u, at.uvs)
        useful = np.flatnonzero((drawn.pdf > 0) & (np.abs(drawn.wi[:, 2]) <= 1))
        local = np.ascontiguousarray(drawn.wi, np.float32)
        world = at.to_world(local, useful)
        radiance, density = self.environment.radiance(world)
        own = np.asarray(drawn.pdf[useful], np.float32)
        share = np.where(drawn.is_delta[useful], np.float32(1), own / (own + density))
        value = _weighed(drawn.weight[useful], radiance, share)
        _add_visible(total, useful, value, at, local[useful, 2], world, None, shadows)


def _usable(reflectance: Reflectance, local: Floats) -> NDArray[np.bool_]:
    """(N,) whether light from the local directions can be reflected at all."""
    return np.ones(len(local), np.bool_) if reflectance.transmits else local[:, 2] > 0


def _weighed(value: Any, light: Floats, factor: Floats) -> Floats:
    """value (N, 3) · light (N, 3) · factor (N,), and no light where a formula gives no finite number."""
    product = np.empty(light.shape, np.float32)
    value, light = np.ascontiguousarray(value, np.float32), np.ascontiguousarray(light, np.float32)
    in_parallel(kernels.weighed, len(light), value, light, np.ascontiguousarray(factor, np.float32), product)
    return product


def _add_visible(
    total: Floats, part: NDArray[np.int64], value: Floats, at: ShadingPoints, cosines: Floats, world: Floats,
    distances: Floats | None, shadows: Surface | None,
) -> None:  # fmt: skip
    """Add `value` of the points `part` to their `total` where nothing stands in the way of the light.

    Light that comes through the surface from behind is not shadowed: the shape counts as a thin sheet there.
    """
    wanted = (value[:, 0] > 0) | (value[:, 1] > 0) | (value[:, 2] > 0)
    if shadows is not None:
        asked = np.flatnonzero(wanted & (cosines > 0))
        far = np.full(len(asked), 1e30, np.float32) if distances is None else distances[asked]
        wanted[asked] = ~shadows.blocks(at.points[part[asked]], world[asked], far)
    in_parallel(kernels.add_rows, len(part), part, value, wanted, total)


def pixel_means(values: Floats, pixels: NDArray[Any], count: int, per_pixel: int) -> tuple[Floats, Floats]:
    """Sum over each pixel's points divided by `per_pixel`: (count, 3), and the coverage (count,)."""
    sums = [np.bincount(pixels, values[:, channel], count) for channel in range(3)]
    coverage = np.bincount(pixels, minlength=count)
    return (np.stack(sums, -1) / per_pixel).astype(np.float32), (coverage / per_pixel).astype(np.float32)
