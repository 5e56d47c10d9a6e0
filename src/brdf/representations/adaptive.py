"""Measurements on adaptive grids, as RGL publishes them [Dupuy2018].

For each incident direction the values lie on a square that a microfacet-like warp stretches where the
material reflects most. Evaluation looks the warp up, so there is no formula (and no shader): bake it to a
`Table` for display.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..color import rgb_weights
from ..errors import ReflectanceError
from ..formula import engine
from ..geometry.arguments import broadcast_directions
from ..geometry.sampling import CosineSampler, MixtureSampler, Sampler
from ..reflectance import Floats, Reflectance
from ..threads import in_ranges

_BLOCK = 8192
"""Pairs that a thread takes at a time."""
_REDUCTIONS = (1, 2, 4)
"""A file holds incident azimuths of the whole circle, a half (point symmetry) or a quarter (two mirrors)."""
_DEFENCE = 1 / 16
"""Share of cosine-distributed samples: the warp for `wo` may miss directions in which f(wi, wo) is not zero."""


class Adaptive(Reflectance):
    """A measurement at incident directions (theta_i, phi_i), each with its own adaptive grid; `wi` is the incident one.

        f(wi, wo) = M(warp^-1(h)) D(h) / (4 sigma(wi) cos_o)      [1/sr],   h = (wi + wo) / |wi + wo|

    M: the measured grid, D: facet distribution `ndf`, sigma: projected area, warp: of the visible normals
    `vndf` for `wi`; all are linear between the measured incident directions. Values can be negative (colours
    out of gamut); the public call clamps them. Measured data is not exactly reciprocal. Reference: Dupuy2018.
    """

    def __init__(self, tensors: Mapping[str, NDArray[Any]], description: str = "") -> None:
        """`tensors` are the fields of an RGL file by name (see `tensors`). Raises ValueError, which names the field."""
        self.description = description
        self.theta_i, self.phi_i = (_nodes(tensors, name) for name in ("theta_i", "phi_i"))
        incident = (len(self.phi_i), len(self.theta_i))
        self.ndf, self.sigma = (_grid(tensors, name, 2) for name in ("ndf", "sigma"))
        self.vndf = _grid(tensors, "vndf", 4, incident)
        # luminance dips below zero in published files
        self.luminance = _grid(tensors, "luminance", 4, incident, signed=True)
        self.has_jacobian = bool(_field(tensors, "jacobian").any())
        if not np.all(self.sigma > 0):
            raise ValueError("field 'sigma' must be above zero everywhere")

        self.wavelengths = _nodes(tensors, "wavelengths") if "wavelengths" in tensors else None
        """Of the measured channels, nm; None when the file holds RGB."""
        channels = 3 if self.wavelengths is None else len(self.wavelengths)
        measured = _grid(tensors, self._measured_name, 5, (*incident, channels), signed=True)
        if measured.shape[3:] != self.luminance.shape[2:]:
            raise ValueError(f"fields {self._measured_name!r} and 'luminance' have grids of different sizes")
        self._measured = self._rgb = _frozen(np.moveaxis(measured, 2, -1))
        if self.wavelengths is not None:
            self._rgb = _frozen(self._measured @ rgb_weights(self.wavelengths).astype(np.float32))

        is_relative = len(self.phi_i) <= 2
        reduction = 1 if is_relative else round(2 * math.pi / float(self.phi_i[-1] - self.phi_i[0]))
        if reduction not in _REDUCTIONS:
            raise ValueError("field 'phi_i' must span the whole circle, a half or a quarter of it")
        self._settings = (int(is_relative), reduction)
        warps = (_warp("vndf", self.vndf), _warp("luminance", self.luminance))
        grids = (_frozen(self.ndf[None, None]), _frozen(self.sigma[None, None]))
        self._model = (self.phi_i, self.theta_i, *warps, *grids)

    @property
    def _measured_name(self) -> str:
        return "rgb" if self.wavelengths is None else "spectra"

    @property
    def has_formula(self) -> bool:
        return False

    @property
    def isotropic(self) -> bool:
        return len(self.phi_i) == 1

    @property
    def structure(self) -> tuple[Any, ...]:
        return (Adaptive,)

    @property
    def textures(self) -> Mapping[str, NDArray[Any]]:
        """The measured grids; "rgb" or "spectra" is (phi, theta, n, n, channels), the others have no channel axis."""
        grids = {"ndf": self.ndf, "sigma": self.sigma, "vndf": self.vndf, "luminance": self.luminance}
        return grids | {self._measured_name: self._measured}

    @property
    def tensors(self) -> dict[str, NDArray[Any]]:
        """The fields of an RGL file.

        theta_i (T,) and phi_i (P,): measured incident directions, radians; ndf and sigma (azimuths, zeniths);
        vndf (P, T, ny, nx); luminance (P, T, n, n); rgb (P, T, 3, n, n), or spectra (P, T, W, n, n) and
        wavelengths (W,) in nm; jacobian (1,): whether the values are to be multiplied by D / (4 sigma).
        """
        nodes = {"theta_i": self.theta_i, "phi_i": self.phi_i}
        if self.wavelengths is not None:
            nodes["wavelengths"] = self.wavelengths
        fields: dict[str, NDArray[Any]] = {name: values.astype(np.float32) for name, values in nodes.items()}
        fields |= {name: self.textures[name] for name in ("ndf", "sigma", "vndf", "luminance")}
        fields[self._measured_name] = np.ascontiguousarray(np.moveaxis(self._measured, -1, 2))
        return fields | {"jacobian": np.array([self.has_jacobian], np.uint8)}

    def _evaluate_arrays(self, wi: Floats, wo: Floats, clamp: bool) -> Floats:
        return self._channels(self._rgb, wi, wo, clamp)

    def spectrum(self, wi: ArrayLike, wo: ArrayLike) -> Floats:
        """f [1/sr] per wavelength: (..., 3), (..., 3) -> (..., W); negative measured values are clamped.

        Raises ReflectanceError when the file holds RGB only, DirectionError as the call.
        """
        if self.wavelengths is None:
            raise ReflectanceError(f"{self.name or 'this measurement'} holds RGB only, no spectrum")
        wi, wo, shape = broadcast_directions(wi, wo)
        engine.check_lengths(wi=wi, wo=wo)
        return self._channels(self._measured, wi, wo, clamp=True).reshape(*shape, -1)

    def _channels(self, grid: NDArray[np.float32], wi: Floats, wo: Floats, clamp: bool) -> Floats:
        from . import adaptive_kernels as kernels

        wi, wo = np.ascontiguousarray(wi), np.ascontiguousarray(wo)
        value = np.empty((len(wi), grid.shape[-1]), wi.dtype)

        def run(rows: slice) -> None:
            out = value[rows]
            kernels.evaluate(self._model, grid, self._settings, self.has_jacobian, wi[rows], wo[rows], out)
            if clamp:
                np.maximum(out, 0, out=out)

        _in_threads(run, len(wi))
        return value

    def _make_sampler(self) -> Sampler:
        return MixtureSampler([AdaptiveSampler(self._model, self._settings), CosineSampler()], [1 - _DEFENCE, _DEFENCE])

    def _state(self) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
        return {"description": self.description}, self.tensors

    @classmethod
    def _restore(cls, header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]], children: Any) -> Reflectance:
        return cls(arrays, str(header["description"]))

    def __repr__(self) -> str:
        channels = "RGB" if self.wavelengths is None else f"{len(self.wavelengths)} wavelengths"
        kind = "isotropic" if self.isotropic else "anisotropic"
        return (
            f"Adaptive({self.name!r}, {len(self.phi_i)} x {len(self.theta_i)} incident directions, {channels}, {kind})"
        )


class AdaptiveSampler:
    """The published sampler with `wo` in the place of the incident direction: luminance warp, then visible normals."""

    def __init__(self, model: tuple[Any, ...], settings: tuple[int, int]) -> None:
        self._model, self._settings = model, settings

    def sample(self, wo: Floats, u: Floats) -> tuple[Floats, NDArray[np.bool_]]:
        """(N, 3), (N, 2) -> (N, 3) directions (some below the horizon, of density zero), (N,) False."""
        from . import adaptive_kernels as kernels

        wo, u = np.ascontiguousarray(wo), np.ascontiguousarray(u, wo.dtype)
        wi = np.empty_like(wo)
        _in_threads(lambda s: kernels.draw_directions(self._model, self._settings, wo[s], u[s], wi[s]), len(wo))
        return wi, np.zeros(len(wi), np.bool_)

    def pdf(self, wi: Floats, wo: Floats) -> Floats:
        """(N, 3), (N, 3) -> (N,) density, 1/sr; zero below the horizon."""
        from . import adaptive_kernels as kernels

        dtype = np.result_type(wi, wo)
        wi, wo = np.ascontiguousarray(wi, dtype), np.ascontiguousarray(wo, dtype)
        pdf = np.empty(len(wi), dtype)
        _in_threads(lambda s: kernels.density(self._model, self._settings, wo[s], wi[s], pdf[s]), len(wi))
        return pdf


def _in_threads(run: Callable[[slice], None], count: int) -> None:
    """`run` on slices that together are range(count), on all cores."""
    in_ranges(lambda start, stop: run(slice(start, stop)), count, _BLOCK)


def _field(tensors: Mapping[str, NDArray[Any]], name: str) -> NDArray[Any]:
    if name not in tensors:
        raise ValueError(f"field {name!r} is missing")
    return tensors[name]


def _nodes(tensors: Mapping[str, NDArray[Any]], name: str) -> NDArray[np.float64]:
    """A one-dimensional field that increases. Raises ValueError."""
    nodes = _field(tensors, name).astype(np.float64)
    if nodes.ndim != 1 or nodes.size == 0 or not np.isfinite(nodes).all() or np.any(np.diff(nodes) <= 0):
        raise ValueError(f"field {name!r} must be a list of numbers that increase")
    return _frozen(nodes)


def _grid(
    tensors: Mapping[str, NDArray[Any]], name: str, axes: int, first: tuple[int, ...] = (), signed: bool = False
) -> NDArray[np.float32]:
    """A float32 field of `axes` axes, the `first` of which have the sizes given. Raises ValueError."""
    grid = _field(tensors, name)
    wanted = " x ".join([*map(str, first), *["n"] * (axes - len(first))])
    if grid.ndim != axes or grid.shape[: len(first)] != first or min(grid.shape[-2:]) < 2 or grid.dtype != np.float32:
        raise ValueError(f"field {name!r} must be float32 {wanted} with n >= 2, got {grid.dtype} {grid.shape}")
    if not np.isfinite(grid).all():
        raise ValueError(f"field {name!r} holds NaN or infinity")
    if not signed and grid.min() < 0:
        raise ValueError(f"field {name!r} holds negative values")
    return _frozen(grid)


def _warp(name: str, table: NDArray[np.float32]) -> tuple[NDArray[np.float32], ...]:
    """Density with unit sum over the patches, its sums along x, and the sums of those along y. Raises ValueError."""
    density, conditional = np.empty_like(table), np.zeros_like(table)
    marginal = np.zeros((*table.shape[:2], 1, table.shape[2]), np.float32)
    for at in np.ndindex(table.shape[:2]):  # one at a time: in double precision all would need several times the file
        cells = table[at].astype(np.float64).clip(0)
        cells /= max(cells.max(), np.finfo(np.float32).tiny)
        sums = np.cumsum(0.5 * (cells[:, 1:] + cells[:, :-1]), axis=1)
        rows = np.cumsum(0.5 * (sums[1:, -1] + sums[:-1, -1]))
        if not rows[-1] > 0:
            raise ValueError(f"field {name!r} is zero everywhere for one of the incident directions")
        density[at], conditional[at][:, 1:], marginal[at][0, 1:] = cells / rows[-1], sums / rows[-1], rows / rows[-1]
    return _frozen(density), _frozen(conditional), _frozen(marginal)


def _frozen(array: NDArray[Any]) -> NDArray[Any]:
    """A contiguous array that cannot be written: the compiled kernels take exactly this type."""
    array = np.ascontiguousarray(array).view()
    array.flags.writeable = False
    return array
