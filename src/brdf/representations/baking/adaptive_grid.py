"""Any reflectance as an adaptive measurement: grids warped to where it reflects, as RGL's files hold them.

The facet distribution D comes from retroreflection: of a microfacet model f(m, m) cos(m)^2 is proportional to D(m);
what is left where it is least counts as diffuse, to which an even D belongs. How well D fits decides how few nodes are
needed; the values are exact at the nodes whatever it is. Reference: Dupuy2018.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...color import LUMINANCE
from ...geometry.directions import from_spherical, reflected
from ...reflectance import Reflectance
from ..adaptive import Adaptive
from ..scattered import Scattered
from .bake import require_values

Array = NDArray[np.floating[Any]]

_LEAST_EVEN = 0.15
"""Share of the even distribution in D, at least: keeps the values finite where nothing is reflected back."""
_LEAST_COSINE = 0.02
"""Retroreflection is looked up no closer to the horizon, where models and measurements are unbounded."""
_LIFT = 1e-3
"""Least cosine of the viewer at which values are looked up."""
_STEEPEST = math.radians(89.5)
"""The largest angle of incidence."""
_CROWDED = 1.5
"""Power by which the angles of incidence crowd towards it, where reflection changes fastest."""


class Sizes(NamedTuple):
    """Nodes of the grids."""

    azimuths: int
    """of the incident direction"""
    elevations: int
    warp: tuple[int, int]
    """of the half vector's distribution, over azimuth and elevation"""
    values: int
    """of the measured square, along each side"""


ISOTROPIC = Sizes(1, 32, (64, 128), 64)
ANISOTROPIC = Sizes(25, 16, (64, 96), 32)


def bake_adaptive(m: Reflectance, sizes: Sizes | None = None) -> Adaptive:
    """`m` at incident directions and on grids of `sizes`, in spectra where it has them, else in RGB.

    Raises ReflectanceError for what transmits or mirrors.
    """
    require_values(m)
    sizes = sizes or (ISOTROPIC if m.isotropic else ANISOTROPIC)
    theta_i = _STEEPEST * (1 - np.linspace(1, 0, sizes.elevations) ** _CROWDED)
    phi_i = np.linspace(-math.pi, math.pi, sizes.azimuths) if sizes.azimuths > 1 else np.zeros(1)
    rows, columns = sizes.warp if sizes.azimuths > 1 else (2, sizes.warp[1])
    ndf = _facets(m, rows, columns)
    sigma = _projected_area(ndf)
    vndf = np.empty((sizes.azimuths, sizes.elevations, *sizes.warp), np.float32)
    wavelengths = m.wavelengths if isinstance(m, (Adaptive, Scattered)) else None
    channels = 3 if wavelengths is None else len(wavelengths)
    values = np.empty((sizes.azimuths, sizes.elevations, channels, sizes.values, sizes.values), np.float32)
    for p, t in np.ndindex(vndf.shape[:2]):
        wi = from_spherical(theta_i[t], phi_i[p])
        turn = phi_i[p] if sizes.azimuths > 1 else 0.0
        vndf[p, t] = _visible(ndf, wi, sizes.warp)
        u, v = _drawn(vndf[p, t], sizes.values)
        half = _half_vector(u, v)
        wo = reflected(np.broadcast_to(wi, half.shape), half)
        f = _values(m, wi, wo, wavelengths is not None)
        place = math.sqrt(theta_i[t] * (2 / math.pi)), turn / (2 * math.pi) + 0.5
        scale = np.maximum(wo[..., 2], 0) * 4 * _bilinear(sigma, *map(np.asarray, place)) / _bilinear(ndf, u, v)
        values[p, t] = np.moveaxis(f * scale[..., None], -1, 0)
    if sizes.azimuths > 1:  # the circle closes
        values[-1], vndf[-1] = values[0], vndf[0]
    tensors: dict[str, NDArray[Any]] = {
        "theta_i": theta_i.astype(np.float32),
        "phi_i": phi_i.astype(np.float32),
        "ndf": ndf,
        "sigma": sigma,
        "vndf": vndf,
        "luminance": _luminance(m, values, wavelengths),
        "jacobian": np.ones(1, np.uint8),
    }
    if wavelengths is None:
        tensors["rgb"] = values
    else:
        tensors |= {"spectra": values, "wavelengths": wavelengths.astype(np.float32)}
    made = Adaptive(tensors, f"{m.name or type(m).__name__}, resampled")
    return made.named(m.name, f"{m.source or m.name}, on adaptive grids")


def _half_vector(u: Array, v: Array) -> Array:
    """(..., 3) at places of the unit square: u = sqrt(2 theta / pi), v = phi / 2 pi + 1/2."""
    return from_spherical(u * u * (math.pi / 2), (2 * v - 1) * math.pi)


def _nodes(rows: int, columns: int) -> tuple[Array, Array]:
    v, u = np.meshgrid(np.linspace(0, 1, rows), np.linspace(0, 1, columns), indexing="ij")
    return u, v


def _facets(m: Reflectance, rows: int, columns: int) -> NDArray[np.float32]:
    """D at the nodes, with a projected area of 1."""
    u, v = _nodes(rows, columns)
    half = _half_vector(u, v)
    lifted = half.copy()
    lifted[..., 2] = np.maximum(lifted[..., 2], _LEAST_COSINE)
    lifted /= np.linalg.norm(lifted, axis=-1, keepdims=True)
    back = np.asarray(m(lifted, lifted)) @ np.asarray(LUMINANCE)
    diffuse = max(float(back.min()), 0.0)
    facets = np.maximum(back - diffuse, 0) * half[..., 2] ** 2
    area = float(np.sum(facets * half[..., 2] * _solid_angle(u, columns)) / rows)
    even = max(math.pi * diffuse / max(math.pi * diffuse + 4 * area, 1e-30), _LEAST_EVEN)  # F / 4 is in the area
    facets = facets / area if area > 0 else np.full_like(facets, 1 / math.pi)
    if rows == 2:  # isotropic
        facets[:] = facets.mean(0)
    return np.asarray((1 - even) * facets + even / math.pi, np.float32)


def _solid_angle(u: Array, columns: int) -> Array:
    """Of a node's cell over a whole circle of azimuths."""
    weights = np.full(columns, 1 / (columns - 1))
    weights[[0, -1]] /= 2
    return np.asarray(2 * math.pi**2 * u * np.sin(u * u * (math.pi / 2)) * weights)


def _projected_area(ndf: NDArray[np.float32]) -> NDArray[np.float32]:
    """sigma(w) = integral of D(m) max(0, w . m) at the nodes of D."""
    rows, columns = ndf.shape
    u, v = _nodes(rows, columns)
    fine_u, fine_v = _nodes(max(rows, 128) + 1, columns)
    fine_u, fine_v = fine_u[:-1], fine_v[:-1]
    half = _half_vector(fine_u, fine_v).reshape(-1, 3)
    weight = (_bilinear(ndf, fine_u, fine_v) * _solid_angle(fine_u, columns) / len(fine_u)).ravel()
    directions = _half_vector(u, v).reshape(-1, 3)
    sigma = np.array([weight @ np.maximum(half @ w, 0) for w in directions]).reshape(rows, columns)
    if rows == 2:
        sigma[:] = sigma.mean(0)
    return sigma.astype(np.float32)


def _visible(ndf: NDArray[np.float32], wi: Array, shape: tuple[int, int]) -> Array:
    """Density of visible facets over the unit square, at nodes; azimuths count from the light where isotropic."""
    u, v = _nodes(*shape)
    half = _half_vector(u, v)
    area = u * np.sin(u * u * (math.pi / 2))
    return np.asarray(_bilinear(ndf, u, v) * np.maximum(half @ wi, 0) * area)


def _bilinear(grid: NDArray[np.float32], u: Array, v: Array) -> Array:
    rows, columns = grid.shape
    i = np.clip((u * (columns - 1)).astype(int), 0, columns - 2)
    j = np.clip((v * (rows - 1)).astype(int), 0, rows - 2)
    fx, fy = u * (columns - 1) - i, v * (rows - 1) - j
    lower = (1 - fx) * grid[j, i] + fx * grid[j, i + 1]
    upper = (1 - fx) * grid[j + 1, i] + fx * grid[j + 1, i + 1]
    return np.asarray((1 - fy) * lower + fy * upper)


def _drawn(table: NDArray[np.float32], count: int) -> tuple[Array, Array]:
    """(x, y): where the warp of a density, bilinear between the nodes of `table`, puts `count` x `count` nodes.

    The same as `adaptive_kernels.draw`, for all nodes of one incident direction.
    """
    density = table.astype(np.float64)
    conditional = np.zeros_like(density)
    np.cumsum(0.5 * (density[:, 1:] + density[:, :-1]), axis=1, out=conditional[:, 1:])
    rows = conditional[:, -1]
    marginal = np.concatenate([[0], np.cumsum(0.5 * (rows[1:] + rows[:-1]))])
    nodes = np.linspace(0, 1, count)
    wanted = nodes * marginal[-1]
    j = np.clip(np.searchsorted(marginal, wanted, side="right") - 1, 0, len(rows) - 2)
    fy = _solved(rows[j], rows[j + 1], wanted - marginal[j])[:, None]
    cumulative = (1 - fy) * conditional[j] + fy * conditional[j + 1]
    row = (1 - fy) * density[j] + fy * density[j + 1]
    target = nodes * cumulative[:, -1:]
    i = np.clip((cumulative[:, None, :] <= target[..., None]).sum(-1) - 1, 0, density.shape[1] - 2)
    left, right, before = (np.take_along_axis(a, k, axis=1) for a, k in ((row, i), (row, i + 1), (cumulative, i)))
    fx = _solved(left, right, target - before)
    return (i + fx) / (density.shape[1] - 1), np.broadcast_to((j[:, None] + fy) / (len(rows) - 1), i.shape)


def _solved(start: Array, end: Array, area: Array) -> Array:
    """Up to where a density that runs linearly from `start` to `end` encloses `area`, in [0, 1]."""
    root = np.sqrt(np.maximum(start * start + 2 * area * (end - start), 0))
    total = start + root
    return np.minimum(np.divide(2 * area, total, out=np.zeros_like(total), where=total > 0), 1)


def _values(m: Reflectance, wi: Array, wo: Array, is_spectral: bool) -> Array:
    """f at (..., 3) viewing directions; below the horizon some finite value."""
    lifted = wo.copy()
    lifted[..., 2] = np.maximum(lifted[..., 2], _LIFT)
    lifted /= np.linalg.norm(lifted, axis=-1, keepdims=True)
    incident = np.broadcast_to(wi, wo.shape)
    if is_spectral and isinstance(m, (Adaptive, Scattered)):
        return m.spectrum(incident, lifted)
    return np.asarray(m(incident, lifted))


def _luminance(m: Reflectance, values: NDArray[np.float32], wavelengths: Array | None) -> NDArray[np.float32]:
    """The density that samples are drawn with: never zero as a whole."""
    if wavelengths is None:
        luminance = np.einsum("c,ptcyx->ptyx", np.asarray(LUMINANCE, np.float32), values)
    else:
        luminance = values.mean(axis=2)
    luminance = np.maximum(luminance, 0)
    floor = 1e-3 * luminance.mean(axis=(2, 3), keepdims=True)
    return np.asarray(np.maximum(luminance, np.maximum(floor, 1e-6)), np.float32)
