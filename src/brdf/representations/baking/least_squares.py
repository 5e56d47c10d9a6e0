"""The values at a table's nodes that make what the table interpolates look most like a reflectance.

The error is the one of pictures: the sRGB values of a sphere, viewed from afar under a light at any angle (`metrics`).
Its linearisation about the exact picture weighs the squared error of pi f of a sample, of the two directions exchanged,
and of all turns of the sphere by

    w = sin theta_h cos_i cos_o (cos_i S'(pi f cos_i)^2 + cos_o S'(pi f cos_o)^2),

S' the slope of the sRGB curve. Where the picture is white, S' is replaced by a constant relative error, so that
highlights keep their shape under weaker lights. The encoding (a logarithm) is not linear: Gauss-Newton steps.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...errors import ReflectanceError
from ...geometry.warps import Angle, Circle, FarPower, Power, Warp
from ...reflectance import Reflectance
from ...threads import map_threads
from ..tables.bases import Basis
from ..tables.layout import Layout
from ..tables.table import Table
from . import normal_equations as ne
from .bake import Array, diffuse_floor, evaluate, require_isotropic, require_values

WHITE_SLOPE = 0.15
"""The slope above white, times the value: d S / d ln(value), a third of what it is just below white."""

DARK_SHARE = 1e-4
"""Weight of the error of the stored (logarithmic) values beside that of the picture: keeps black from being free."""

STIFFNESS = 1e-8
"""Weight, in parts of the sum of all weights, of squared differences between neighbouring nodes: carries values on to
where there are no samples."""

ITERATIONS = 80
"""Conjugate-gradient steps; the normal matrix is well conditioned but for nodes without samples."""

ROBUST_STEPS = 3

OUTLIER = 3.0
"""Standard deviations, estimated by the median, at which a sample counts half in a robust fit."""

LEAST_NOISE = 0.02
"""The least standard deviation assumed of a robust fit's encoded values."""

SAMPLES = {"phi_h": 2, "theta_h": 3, "theta_d": 5, "phi_d": 5}
"""Samples a node along each axis: with fewer, the nodes fit them better than what lies between."""

CHOICE_SAMPLES = {"phi_h": 2, "theta_h": 2, "theta_d": 3, "phi_d": 3}
"""The same to tell layouts apart, and for four axes."""

LEAST_SAMPLES = {"phi_h": 8, "theta_h": 48, "theta_d": 32, "phi_d": 16}

SAMPLING: dict[str, Warp] = {
    "phi_h": Circle(), "theta_h": Power(exponent=2.0), "theta_d": FarPower(exponent=1.3), "phi_d": Power(),
}  # fmt: skip
"""Where samples lie: dense where nodes are."""


@dataclass(frozen=True)
class Observations:
    """A reflectance at the points of a product of angles; float32."""

    angles: tuple[Array, ...]
    """One array an axis [rad]."""
    values: Array
    """(3, *samples): scale * f."""
    valid: NDArray[np.bool_]
    """(*samples)"""
    cos_d: Array
    """(*samples)"""
    importance: Array
    """(*samples): the weight of relative errors; 0 where not valid."""
    weight: Array
    """(3, *samples): the weight of errors of the values; 0 where not valid."""


def observe(m: Reflectance, basis: Basis, counts: tuple[int, ...], scale: float, symmetrise: bool) -> Observations:
    """`m` at `counts` samples along the axes of a half-vector basis. See `evaluate` for `symmetrise`."""
    warps = [_stretched(SAMPLING[name], extent) for name, extent in zip(basis.axes, basis.extents, strict=True)]
    angles = tuple(w.angle((np.arange(n) + 0.5) / n) for w, n in zip(warps, counts, strict=True))
    widths = [np.diff(w.angle(np.linspace(0, 1, n + 1))) for w, n in zip(warps, counts, strict=True)]
    wi, wo = basis.directions(*np.meshgrid(*angles, indexing="ij", sparse=True))
    f, valid = evaluate(m, basis, wi, wo, symmetrise)
    if not valid.any():
        raise ReflectanceError("no valid value to bake: every sample is below the horizon or unmeasured")
    values = np.ascontiguousarray(np.moveaxis(f, -1, 0), np.float32) * np.float32(scale)
    measure = np.ones(())
    for name, angle, width in zip(basis.axes, angles, widths, strict=True):
        measure = np.multiply.outer(measure, width * (np.sin(angle) if name == "theta_h" else 1))
    cos_i, cos_o = (np.maximum(w[..., 2], 0).astype(np.float32) for w in (wi, wo))
    importance = (measure * valid).astype(np.float32) * cos_i * cos_o
    importance /= importance.sum()
    to_radiance = np.float32(math.pi / scale)
    slopes = [cos * _display_slope(to_radiance * values * cos) ** 2 for cos in (cos_i, cos_o)]
    weight = importance * to_radiance**2 * (slopes[0] + slopes[1])
    cos_d = 0.5 * np.linalg.norm(wi + wo, axis=-1).astype(np.float32)
    return Observations(angles, values, valid, cos_d, importance, weight)


def _stretched(warp: Warp, extent: float) -> Warp:
    return type(warp)(**{**warp.__dict__, "extent": extent})


def _display_slope(radiance: Array) -> Array:
    """d sRGB / d radiance, and beyond white the constant relative error."""
    slope = 1.055 / 2.4 * np.maximum(radiance, 0.0031308) ** np.float32(1 / 2.4 - 1)
    slope = np.where(radiance <= 0.0031308, np.float32(12.92), slope)
    return np.where(radiance > 1, WHITE_SLOPE / np.maximum(radiance, 1), slope)


def fit(seen: Observations, layout: Layout, floor: Array, steps: int, robust: bool = False) -> tuple[Array, float]:
    """The encoded values (3, *shape) of all nodes, and about the mean square error of the picture they make.

    A fit of the encoded values themselves, then at most `steps` Gauss-Newton steps towards the values; a `robust` fit
    adds ROBUST_STEPS that trust samples far from the last fit little.
    """
    encoding = layout.encoding
    factor = encoding.grazing_factor(seen.cos_d).astype(np.float32)
    above = seen.values - floor.astype(np.float32).reshape(3, *(1,) * len(layout.shape))
    target = encoding.transform.encode(above * factor)
    known = target[:, seen.valid].astype(np.float64)
    low, high, flat = (f(known, axis=1).reshape(3, *(1,) * len(layout.shape)) for f in (np.min, np.max, np.median))
    axes = _interpolation(layout, seen.angles)
    periodic = [warp.periodic for warp in layout.warps]
    smooth = ne.difference_penalty(layout.shape, periodic)

    trust: Array = np.ones_like(seen.importance)

    def step(stored: Array, at: Array, slope: Array, missing: Array) -> Array:
        """Better nodes than `stored`, which interpolate to `at`, miss the values by `missing`, and change them at rate
        `slope`."""
        pull = trust * seen.weight * slope
        dark = DARK_SHARE * trust * seen.importance
        weight = pull * slope + dark
        pull = pull * missing + dark * (target - at)
        stiffness = STIFFNESS * weight.reshape(3, -1).sum(1, dtype=np.float64)
        matrix = ne.add(ne.normal_matrix(weight, axes, periodic), smooth, stiffness)
        right = ne.gather(pull, axes) - stiffness.reshape(low.shape) * ne.multiply(smooth, stored)
        return np.clip(stored + ne.solve(matrix, right, ITERATIONS), low, high)

    def errors(stored: Array) -> tuple[Array, Array, float]:
        at = ne.interpolate(stored.astype(np.float32), axes)
        missing = above - encoding.transform.value(at) / factor
        return at, missing, float(np.sum(seen.weight * missing**2, dtype=np.float64)) / 3

    start = np.broadcast_to(flat, (3, *layout.shape))
    at = flat.astype(np.float32)
    slope = encoding.transform.slope(target) / factor
    best = step(start, at, slope, slope * (target - at))
    at, missing, error = errors(best)
    for _ in range(steps):
        candidate = step(best, at, encoding.transform.slope(at) / factor, missing)
        at, missing, reached = errors(candidate)
        if reached >= error and not robust:
            break
        best, error = candidate, reached
    for _ in range(ROBUST_STEPS if robust else 0):
        trust = _trust(np.abs(target - at).max(0), seen.valid)
        best = step(best, at, encoding.transform.slope(at) / factor, missing)
        at, missing, error = errors(best)
    return best, error


def _trust(apart: Array, valid: NDArray[np.bool_]) -> Array:
    """Weights in [0, 1] of samples that are `apart` from a fit, near 1 where that is no more than common:
    Cauchy's."""
    common = max(1.4826 * float(np.median(apart[valid])), LEAST_NOISE)
    return np.asarray(1 / (1 + (apart / (OUTLIER * common)) ** 2), np.float32)


def _interpolation(layout: Layout, angles: tuple[Array, ...]) -> list[Array]:
    """For each axis the weights (samples, nodes) with which the table interpolates at angles."""
    positions = layout.positions(tuple(Angle(np.sin(a), np.cos(a)) for a in angles))
    axes = zip(positions, layout.shape, layout.warps, strict=True)
    return [ne.hats(np.asarray(position), count, warp.periodic) for position, count, warp in axes]


def bake_least_squares(
    m: Reflectance, layout: Layout, floor_quantile: float, symmetrise: bool, robust: bool = False
) -> Table:
    """A table that interpolates to what looks most like `m`.

    See `evaluate` for `symmetrise`, `fit` for `robust`. Raises ReflectanceError when `m` is anisotropic and the basis
    is not, or when it has no valid value.
    """
    seen, floor = _seen(m, [layout], SAMPLES if layout.basis.isotropic else CHOICE_SAMPLES, floor_quantile, symmetrise)
    stored, _ = fit(seen, layout, floor, 1, robust)
    stored = np.moveaxis(stored, 0, -1)
    return Table.encoded(layout, stored, floor).named(m.name, f"{m.source or m.name}, baked by least squares")


def rank(m: Reflectance, layouts: Sequence[Layout], floor_quantile: float, symmetrise: bool) -> list[int]:
    """Layouts of one basis and encoding by how well they fit `m`, about; the best first. See `bake_least_squares`."""
    seen, floor = _seen(m, layouts, CHOICE_SAMPLES, floor_quantile, symmetrise)
    errors = map_threads(lambda layout: fit(seen, layout, floor, steps=0)[1], layouts)
    return [int(index) for index in np.argsort(errors)]


def _seen(
    m: Reflectance, layouts: Sequence[Layout], samples: dict[str, int], floor_quantile: float, symmetrise: bool
) -> tuple[Observations, Array]:
    """`m` at so many samples a node of all the layouts, and its floor."""
    basis, scale = layouts[0].basis, layouts[0].encoding.scale
    require_isotropic(m) if basis.isotropic else require_values(m)
    sizes = zip(basis.axes, *(layout.shape for layout in layouts), strict=True)
    counts = tuple(max(LEAST_SAMPLES[axis], samples[axis] * max(nodes)) for axis, *nodes in sizes)
    seen = observe(m, basis, counts, scale, symmetrise)
    return seen, diffuse_floor(np.moveaxis(seen.values, 0, -1), seen.valid, floor_quantile)
