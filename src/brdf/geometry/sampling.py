"""Samplers: distributions over the direction to the light, given the direction to the viewer."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError
from .directions import cosine_weighted, normalized, reflected
from .tabulated_sampler import TabulatedSampler

__all__ = [
    "CosineSampler", "DeltaSampler", "GGXSampler", "MirrorSampler", "MixtureSampler", "Sampler", "TabulatedSampler",
    "event_probability", "same_direction",
]  # fmt: skip

Floats = NDArray[np.floating[Any]]


class Sampler(Protocol):
    """A distribution of `wi` given `wo`.

    A sampler may draw directions below the horizon; their density is 0, so that the density integrates, over
    the upper hemisphere, to the share of draws that are of use.
    """

    def sample(self, wo: Floats, u: Floats) -> tuple[Floats, NDArray[np.bool_]]:
        """(N, 3) viewing directions, (N, 2) numbers in [0, 1) -> (N, 3) directions, (N,) whether a delta event.

        The directions have the dtype of `wo`.
        """
        ...

    def pdf(self, wi: Floats, wo: Floats) -> Floats:
        """(N, 3), (N, 3) -> (N,) density of `sample`, 1/sr; delta events have none and count as 0."""
        ...


@runtime_checkable
class DeltaSampler(Sampler, Protocol):
    """A sampler some of whose draws are delta events: each of them has a probability instead of a density."""

    def event_probability(self, wi: Floats, wo: Floats) -> Floats:
        """(N, 3), (N, 3) -> (N,) probability that `sample` draws the delta event `wi`; 0 where there is none."""
        ...


def event_probability(sampler: Sampler, wi: Floats, wo: Floats) -> Floats:
    """(N,) probability of the delta events `wi` (N, 3), seen from `wo` (N, 3), under any sampler."""
    if isinstance(sampler, DeltaSampler):
        return sampler.event_probability(wi, wo)
    return np.zeros(len(wi), wi.dtype)


def same_direction(a: Floats, b: Floats) -> NDArray[np.bool_]:
    """(N,) whether two directions (N, 3) are the same up to the rounding of single precision."""
    difference = a - b
    return np.asarray(np.einsum("ij,ij->i", difference, difference) < SAME_DIRECTION**2)


SAME_DIRECTION = 1e-5
"""Chord below which directions of delta events are one. What events of two lobes that lie closer carry is added up
whichever is drawn, so that no light is lost or doubled."""


class MirrorSampler:
    """The one delta event of a mirror: the direction that mirrors `wo` in the normal."""

    def sample(self, wo: Floats, u: Floats) -> tuple[Floats, NDArray[np.bool_]]:
        return wo * np.array([-1, -1, 1], wo.dtype), np.ones(len(wo), bool)

    def pdf(self, wi: Floats, wo: Floats) -> Floats:
        return np.zeros(len(wi), wi.dtype)

    def event_probability(self, wi: Floats, wo: Floats) -> Floats:
        mirrored, _ = self.sample(wo, wo)
        return same_direction(wi, mirrored).astype(wi.dtype)


class CosineSampler:
    """Density cos/pi over the upper hemisphere."""

    def sample(self, wo: Floats, u: Floats) -> tuple[Floats, NDArray[np.bool_]]:
        return cosine_weighted(u.astype(wo.dtype, copy=False)), np.zeros(len(wo), bool)

    def pdf(self, wi: Floats, wo: Floats) -> Floats:
        return np.where(wo[:, 2] > 0, np.maximum(wi[:, 2], 0) * wi.dtype.type(1 / np.pi), 0)


class GGXSampler:
    """Mirrors `wo` in a visible normal of a GGX surface: density D(h) G1(wo) / (4 cos_o) [1/sr].

    `alpha_x`, `alpha_y` are the widths along tangent and bitangent. The visible normals come from a uniformly
    sampled spherical cap. References: Heitz2018, Dupuy2023. Raises ParameterError.
    """

    def __init__(self, alpha_x: float, alpha_y: float) -> None:
        if not (alpha_x > 0 and alpha_y > 0):
            raise ParameterError(f"a GGX lobe needs widths above 0, got {alpha_x:g} and {alpha_y:g}")
        self.alpha_x, self.alpha_y = float(alpha_x), float(alpha_y)

    def sample(self, wo: Floats, u: Floats) -> tuple[Floats, NDArray[np.bool_]]:
        u = u.astype(wo.dtype, copy=False)
        stretch = np.array([self.alpha_x, self.alpha_y, 1], wo.dtype)
        # Where the surface is stretched to a hemisphere, mirrored rays fill a spherical cap evenly.
        view = normalized(wo * stretch)
        phi = wo.dtype.type(2 * np.pi) * u[:, 0]
        z = (1 - u[:, 1]) * (1 + view[:, 2]) - view[:, 2]
        radius = np.sqrt(np.maximum((1 - z) * (1 + z), 0))
        h = view + np.stack([radius * np.cos(phi), radius * np.sin(phi), z], axis=-1)
        wi = reflected(wo, normalized(h * stretch))
        return wi, np.zeros(len(wo), bool)

    def pdf(self, wi: Floats, wo: Floats) -> Floats:
        h = wi + wo
        squared = np.einsum("ij,ij->i", h, h)
        stretched = (h[:, 0] / self.alpha_x) ** 2 + (h[:, 1] / self.alpha_y) ** 2 + h[:, 2] ** 2
        usable = (wi[:, 2] > 0) & (wo[:, 2] > 0)
        ratio = np.divide(squared, stretched, out=np.zeros_like(squared), where=usable)
        D = ratio * ratio * wi.dtype.type(1 / (np.pi * self.alpha_x * self.alpha_y))
        # G1(wo) / (4 cos_o) = 1 / (2 (cos_o + sqrt(cos_o^2 + ax^2 x^2 + ay^2 y^2))): cos_o may vanish
        projected = np.sqrt((self.alpha_x * wo[:, 0]) ** 2 + (self.alpha_y * wo[:, 1]) ** 2 + wo[:, 2] ** 2)
        density: Floats = np.divide(D, 2 * (wo[:, 2] + projected), out=np.zeros_like(D), where=usable)
        return density


class MixtureSampler:
    """Chooses one of several samplers with fixed weights; its density is the weighted sum of theirs.

    So is the probability of a delta event. `weights` need not sum to 1; where all are 0 the choice is even. Raises
    ParameterError.
    """

    def __init__(self, samplers: Sequence[Sampler], weights: Sequence[float]) -> None:
        shares = np.asarray(weights, np.float64)
        if len(samplers) == 0 or shares.shape != (len(samplers),) or not np.all((shares >= 0) & (shares < np.inf)):
            raise ParameterError(f"a mixture of {len(samplers)} samplers needs as many weights >= 0, got {weights}")
        if shares.sum() == 0:
            shares = np.ones_like(shares)
        self._samplers = list(samplers)
        self._shares = shares / shares.sum()

    def sample(self, wo: Floats, u: Floats) -> tuple[Floats, NDArray[np.bool_]]:
        upper = np.cumsum(self._shares)
        chosen = np.minimum(np.searchsorted(upper, u[:, 0], side="right"), np.flatnonzero(self._shares)[-1])
        wi, is_delta = np.empty_like(wo), np.zeros(len(wo), bool)
        for index, sampler in enumerate(self._samplers):
            mine = np.flatnonzero(chosen == index)
            if len(mine):
                share, rescaled = self._shares[index], u[mine]
                # what is left of the first number once it has made the choice is uniform again
                below_one = np.nextafter(u.dtype.type(1), u.dtype.type(0))
                rescaled[:, 0] = np.clip((rescaled[:, 0] - (upper[index] - share)) / share, 0, below_one)
                wi[mine], is_delta[mine] = sampler.sample(wo[mine], rescaled)
        return wi, is_delta

    def pdf(self, wi: Floats, wo: Floats) -> Floats:
        total = np.zeros(len(wi), wi.dtype)
        for sampler, share in zip(self._samplers, self._shares, strict=True):
            if share > 0:
                total += wi.dtype.type(share) * sampler.pdf(wi, wo)
        return total

    def event_probability(self, wi: Floats, wo: Floats) -> Floats:
        total = np.zeros(len(wi), wi.dtype)
        for sampler, share in zip(self._samplers, self._shares, strict=True):
            total += wi.dtype.type(share) * event_probability(sampler, wi, wo)
        return total
