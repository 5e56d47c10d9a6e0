"""Reflectances compared in every metric: one with another, or several with one reference, the nearest first."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import ParameterError, UnknownNameError
from ..reflectance import Reflectance
from . import sphere
from .albedo import ALBEDO_ANGLES, directional_albedo
from .pairs import METRICS, Array, direction_pairs
from .sphere import SPHERE_SIZE, DeltaE
from .surroundings import lit_from_all_around

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True, eq=False)
class Comparison:
    """How far `other` is from `reference`."""

    reference: str
    other: str
    psnr: float
    """dB, pictures of a sphere, all lights pooled"""
    psnr_by_angle: Array
    """dB, the picture of each of `LIGHT_ANGLES` by itself"""
    delta_e: DeltaE
    """CIEDE2000 over the pixels of all pictures: mean and 95th percentile"""
    delta_e_by_angle: Array
    """mean CIEDE2000 over the pixels of each picture"""
    relative_rmse: float
    """linear pictures of a sphere"""
    surroundings_rmse: float
    """relative RMSE of linear pictures of a sphere lit from all around, see `metrics.surroundings`"""
    albedo_difference: float
    """largest |difference| of directional albedo over channels and 0, 30, 60, 80 degrees"""
    bytes: tuple[int, int]
    """memory of reference and other"""
    metrics: dict[str, float]
    """metrics over pairs of directions by name (see `METRICS`)"""
    pair: tuple[Reflectance, Reflectance]
    """the two themselves"""

    @property
    def psnr_mean(self) -> float:
        """Mean of `psnr_by_angle`."""
        return float(self.psnr_by_angle.mean())

    @property
    def psnr_min(self) -> float:
        """Least of `psnr_by_angle`."""
        return float(self.psnr_by_angle.min())

    def rows(self) -> list[tuple[str, str]]:
        """(what, value) lines."""
        return [
            ("PSNR [dB]", f"{self.psnr:.1f}"),
            ("PSNR of one light: mean", f"{self.psnr_mean:.1f}"),
            ("PSNR of one light: least", f"{self.psnr_min:.1f}"),
            ("ΔE2000: mean", f"{self.delta_e.mean:.3g}"),
            ("ΔE2000: 95 % below", f"{self.delta_e.p95:.3g}"),
            ("relative RMSE", f"{self.relative_rmse:.3g}"),
            ("relative RMSE, lit all around", f"{self.surroundings_rmse:.3g}"),
            ("albedo difference", f"{self.albedo_difference:.3g}"),
            *((name, f"{value:.3g}") for name, value in self.metrics.items()),
            ("bytes", f"{self.bytes[0]:,} -> {self.bytes[1]:,}"),
        ]

    def numbers(self) -> dict[str, Any]:
        """Everything as plain data, for JSON."""
        return {
            "reference": self.reference, "other": self.other, "bytes": list(self.bytes),
            "psnr": self.psnr, "psnr_mean": self.psnr_mean, "psnr_min": self.psnr_min,
            "psnr_by_angle": self.psnr_by_angle.tolist(), "delta_e": self.delta_e._asdict(),
            "delta_e_by_angle": self.delta_e_by_angle.tolist(), "relative_rmse": self.relative_rmse,
            "surroundings_rmse": self.surroundings_rmse, "albedo_difference": self.albedo_difference,
            "metrics": dict(self.metrics),
        }  # fmt: skip

    def table(self) -> str:
        """A small text table."""
        rows = self.rows()
        width = max(len(what) for what, _ in rows)
        lines = [f"{what:<{width}}  {value}" for what, value in rows]
        return "\n".join([f"{self.reference} -> {self.other}", *lines])

    def plot(self) -> Figure:
        """Spheres, their difference, errors against the light's angle and over half and difference angle: the figure
        `brdf.plot.comparison` draws."""
        from ..plot import compared  # upwards in the layers, for this convenience alone: see [tool.importlinter]

        return compared([self])


class _Seen:
    """What comparisons look at of one reflectance, computed once however many others it is compared with."""

    def __init__(self, m: Reflectance, size: int) -> None:
        self.m, self.size = m, size

    @cached_property
    def radiance(self) -> Array:
        return sphere.sphere_radiance(self.m, self.size)

    @cached_property
    def lit_from_all_around(self) -> Array:
        return lit_from_all_around(self.m)

    @cached_property
    def albedos(self) -> Array:
        return np.stack([directional_albedo(self.m, angle) for angle in ALBEDO_ANGLES])

    @cached_property
    def values(self) -> Array:
        wi, wo, _ = direction_pairs()
        return np.asarray(self.m.f_cos(wi, wo))


def compare(a: Reflectance, b: Reflectance, size: int = SPHERE_SIZE) -> Comparison:
    """How far `b` is from `a`, in every metric; `size` is the resolution of the sphere's pictures."""
    return _compare(_Seen(a, size), _Seen(b, size))


RANKINGS: dict[str, Callable[[Comparison], tuple[float, ...]]] = {
    "surroundings": lambda c: (c.surroundings_rmse, -c.psnr),
    "psnr": lambda c: (-c.psnr, c.relative_rmse),
    "delta-e": lambda c: (c.delta_e.mean, -c.psnr),
    "log": lambda c: (c.metrics["log"], -c.psnr),
    "log-relative": lambda c: (c.metrics["log relative"], -c.psnr),
}
"""What to sort comparisons by, the least first. The first is the default: of the metrics here it agrees best with what
people see (docs/comparing.md)."""


def rank(
    reference: Reflectance, others: Sequence[Reflectance], size: int = SPHERE_SIZE, by: str = "surroundings"
) -> list[Comparison]:
    """How far each of `others` is from `reference`, the nearest first, by one of `RANKINGS`.

    Raises ParameterError when there are none, UnknownNameError for another ranking.
    """
    if not others:
        raise ParameterError("nothing to compare with the reference; give at least one more reflectance")
    if by not in RANKINGS:
        raise UnknownNameError("ranking", by, RANKINGS)
    seen = _Seen(reference, size)
    return sorted((_compare(seen, _Seen(m, size)) for m in others), key=RANKINGS[by])


def _compare(a: _Seen, b: _Seen) -> Comparison:
    radiances, lights = (a.radiance, b.radiance), sphere.sphere_lights(a.size)
    squared, colours = sphere.squared_differences(*radiances), sphere.colour_differences(*radiances)
    weight = direction_pairs().weight
    return Comparison(
        reference=a.m.name or type(a.m).__name__,
        other=b.m.name or type(b.m).__name__,
        psnr=float(sphere.decibels(squared.mean())),
        psnr_by_angle=sphere.decibels(sphere.mean_by_light(squared.mean(1), lights)),
        delta_e=sphere.pooled(colours),
        delta_e_by_angle=sphere.mean_by_light(colours, lights),
        relative_rmse=sphere.relative_rmse_of(*radiances),
        surroundings_rmse=sphere.relative_rmse_of(a.lit_from_all_around, b.lit_from_all_around),
        albedo_difference=float(np.abs(a.albedos - b.albedos).max()),
        bytes=(a.m.nbytes, b.m.nbytes),
        metrics={name: metric(a.values, b.values, weight) for name, metric in METRICS.items()},
        pair=(a.m, b.m),
    )
