"""The contract: what every reflectance is and does.

Local frame: normal +z, tangent +x, bitangent +y, right-handed. `wi` points to the light, `wo` to the viewer, both away
from the surface and of unit length. `f(wi, wo)` is the BRDF without the cosine, in 1/sr, linear RGB (Rec. 709).
"""

from __future__ import annotations

import os
from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any, ClassVar, NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import container
from .errors import BrdfError, CorruptFileError, ParameterError, ReflectanceError
from .formula import engine, interpreted
from .formula.backends import backend_of, is_foreign
from .formula.vec import Vec
from .geometry.arguments import MIDDLE, as_directions, broadcast_directions, broadcast_places, flat_places
from .geometry.sampling import Sampler, TabulatedSampler, event_probability
from .shaders.embedded import PREFIX, embedded

Floats = NDArray[np.floating[Any]]

ALBEDO_BLOCK = 1 << 18
"""Samples an albedo takes at once: bounds the memory of many viewing directions."""


class Sample(NamedTuple):
    """Sampled directions towards the light."""

    wi: Floats
    """(..., 3) directions"""
    weight: Floats
    """(..., 3) f |cos| / pdf, for a delta event `delta` / pdf; 0 where the direction is of no use"""
    pdf: Floats
    """(...) density [1/sr]; of a delta event its probability [1]"""
    is_delta: NDArray[np.bool_]
    """(...) whether the direction comes from a delta distribution (mirror, smooth refraction)"""


class Reflectance(ABC):
    """A reflectance: a formula over two directions (or arrays behind one), with parameters and textures.

    A concrete class gives `f` (a formula, traced and compiled) or, when its evaluation needs a search, sets
    `has_formula = False` and gives `_evaluate_arrays`. Everything else derives from that.
    """

    transmits: ClassVar[bool] = False
    """Whether it is defined below the horizon, too."""
    varies: ClassVar[bool] = False
    """Whether it depends on the place on the surface, `uv`."""
    breaks: ClassVar[Mapping[str, str]] = {}
    """Laws it is known to break, each with the reason and its source."""
    lossless: ClassVar[Mapping[str, Any] | None] = None
    """Values of parameters with which it promises to lose no light at all; None for no such promise."""
    _kinds: ClassVar[dict[str, type[Reflectance]]] = {}

    __array_ufunc__ = None
    """NumPy leaves `array * m` to this class instead of making an array of reflectances."""

    name: str = ""
    source: str = ""
    """Where it comes from: file, paper, fit, operator chain."""

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        Reflectance._kinds[cls.__name__] = cls

    # ---- what a concrete class gives -------------------------------------------------------------------------

    @property
    def has_formula(self) -> bool:
        """Whether `f` exists: then it compiles to every backend."""
        return True

    @property
    def has_delta(self) -> bool:
        """Whether delta distributions (mirror, smooth refraction) are part of it, which its values do not show."""
        return any(child.has_delta for child in self.children.values())

    @property
    def isotropic(self) -> bool:
        """Whether the value stays when both directions turn together about the normal."""
        return True

    @property
    def relative_index(self) -> float:
        """Refractive index below the surface over that above it; other than 1 for what transmits into a medium."""
        return 1.0

    @property
    def structure(self) -> tuple[Any, ...]:
        """What the traced formula depends on beside the numbers."""
        raise NotImplementedError

    @property
    def values(self) -> Mapping[str, Any]:
        """Parameters by full name: floats and (3,) arrays."""
        return {}

    @property
    def textures(self) -> Mapping[str, NDArray[Any]]:
        """Textures by full name: arrays (n1, …, nk, channels)."""
        return {}

    @property
    def children(self) -> Mapping[str, Reflectance]:
        return {}

    def f(self, wi: Vec, wo: Vec) -> Vec:
        """The formula: one straight line from two directions to RGB [1/sr]. No guards, no batching."""
        raise ReflectanceError(f"{self.name or type(self).__name__} has no formula; bake it to a Table first")

    def _delta_arrays(self, wi: Floats, wo: Floats) -> Floats:
        """(N, 3), (N, 3) -> (N, 3), see `delta`."""
        return np.zeros_like(wi)

    def _evaluate_arrays(self, wi: Floats, wo: Floats, clamp: bool) -> Floats:
        """(N, 3), (N, 3) -> (N, 3); zero below the horizon, negative values clamped on request."""
        raise NotImplementedError

    def _evaluate_places(self, wi: Floats, wo: Floats, uv: Floats, clamp: bool) -> Floats:
        """As `_evaluate_arrays`, for what varies in space: at the places (N, 2)."""
        raise NotImplementedError

    def _make_sampler(self) -> Sampler:
        """The default is tabulated from the values; a reflectance that knows better overrides it."""
        return TabulatedSampler(self, isotropic=self.isotropic)

    # ---- evaluation ------------------------------------------------------------------------------------------

    def __call__(self, wi: Any, wo: Any, uv: Any = None) -> Any:
        """f(wi, wo) without the cosine [1/sr].

        `wi`, `wo`: (..., 3) unit vectors that broadcast; `uv`: (..., 2) in [0, 1] for what varies in space, else
        ignored; without it what varies is taken at the middle, (0.5, 0.5).
        Returns (..., 3), float32 when both inputs are float32, else float64; zero where either direction lies below
        the horizon; measured values below zero are clamped. JAX, PyTorch and Dr.Jit arrays give arrays of their kind.
        Raises DirectionError for a wrong shape or a length off by more than 0.1 %.
        """
        return self._guarded(wi, wo, uv, clamp=True)

    def raw(self, wi: Any, wo: Any, uv: Any = None) -> Any:
        """As the call, with negative measured values untouched."""
        return self._guarded(wi, wo, uv, clamp=False)

    def f_cos(self, wi: Any, wo: Any, uv: Any = None) -> Any:
        """f(wi, wo) times the cosine of the light's angle, max(0, wi.z) [1/sr]; |wi.z| for what transmits."""
        value = self(wi, wo, uv)
        cosine = wi[..., 2:] if not isinstance(wi, (list, tuple)) else np.asarray(wi)[..., 2:]
        return value * abs(cosine) if self.transmits else value * cosine.clip(0)

    def delta(self, wi: ArrayLike, wo: ArrayLike) -> Floats:
        """What delta distributions carry from `wi` to `wo`: radiance out over radiance in, (..., 3).

        A smooth mirror's reflectance where wi mirrors wo; 0 for all other pairs, and for whatever has values alone.
        """
        wi, wo, shape = broadcast_directions(wi, wo)
        return self._delta_arrays(wi, wo).reshape(*shape, 3)

    def _guarded(self, wi: Any, wo: Any, uv: Any, clamp: bool) -> Any:
        if is_foreign(wi) or is_foreign(wo):
            return self._evaluate_foreign(wi, wo, uv, clamp)
        place = None
        if self.varies:
            wi, wo, place, shape = broadcast_places(wi, wo, uv)
        else:
            wi, wo, shape = broadcast_directions(wi, wo)
        if self.has_formula:
            value = engine.evaluate(self, wi, wo, clamp, place)
        else:
            engine.check_lengths(wi=wi, wo=wo)
            value = (
                self._evaluate_arrays(wi, wo, clamp) if place is None else self._evaluate_places(wi, wo, place, clamp)
            )
        return value.reshape(*shape, value.shape[-1])

    def _evaluate_foreign(self, wi: Any, wo: Any, uv: Any, clamp: bool) -> Any:
        """The formula on another library's arrays: last axis 3 (JAX, PyTorch) or a 3-vector type (Dr.Jit, Mitsuba)."""
        backend = backend_of(wi, wo)
        if hasattr(backend, "stack"):
            i, o = (Vec(w[..., 0], w[..., 1], w[..., 2]) for w in (wi, wo))
            place = Vec(*MIDDLE) if uv is None else Vec(uv[..., 0], uv[..., 1])
            return backend.stack(engine.run(self, i, o, clamp, place).components)
        i, o = (Vec(w[0], w[1], w[2]) for w in (wi, wo))
        place = Vec(*MIDDLE) if uv is None else Vec(uv[0], uv[1])
        return type(wi)(*interpreted.run(self, i, o, clamp, place))

    # ---- sampling --------------------------------------------------------------------------------------------

    @property
    def sampler(self) -> Sampler:
        """How `sample` draws directions; made on first use."""
        made: Sampler | None = self.__dict__.get("_sampler")
        if made is None:
            made = self.__dict__["_sampler"] = self._make_sampler()
        return made

    def sample(self, wo: ArrayLike, u: ArrayLike, uv: Any = None) -> Sample:
        """Directions towards the light, for viewing directions `wo` (..., 3) and numbers `u` (..., 2) in [0, 1).

        `uv` (..., 2): the places, for what varies in space; they enter the weight. The density is the same all over
        the surface.

        Draws of a delta event (`is_delta`) come with the event's probability as their `pdf` and with its own weight.
        Raises DirectionError, or ParameterError for `u` of another shape.
        """
        wo, u = as_directions("wo", wo), np.asarray(u)
        if u.ndim == 0 or u.shape[-1] != 2:
            raise ParameterError(f"u must have shape (..., 2), got {u.shape}")
        try:
            shape = np.broadcast_shapes(wo.shape[:-1], u.shape[:-1])
        except ValueError:
            raise ParameterError(f"wo {wo.shape} and u {u.shape} do not broadcast") from None
        wo = np.broadcast_to(wo, (*shape, 3)).reshape(-1, 3)
        engine.check_lengths(wo=wo)
        wi, is_delta = self.sampler.sample(wo, np.broadcast_to(u, (*shape, 2)).reshape(-1, 2))
        pdf = self.sampler.pdf(wi, wo)
        cosine = np.abs(wi[:, 2]) if self.transmits else np.maximum(wi[:, 2], 0)
        usable = pdf > 0
        scale = np.where(usable, cosine / np.where(usable, pdf, 1), 0)
        weight = self(wi, wo, None if uv is None else flat_places(uv, shape)) * scale[:, None]
        events = np.flatnonzero(is_delta)
        if len(events):
            probability = event_probability(self.sampler, wi[events], wo[events])
            carried = self._delta_arrays(wi[events], wo[events])
            pdf[events] = probability
            weight[events] = carried / np.where(probability > 0, probability, np.inf)[:, None]
        return Sample(wi.reshape(*shape, 3), weight.reshape(*shape, 3), pdf.reshape(shape), is_delta.reshape(shape))

    def pdf(self, wi: ArrayLike, wo: ArrayLike, uv: Any = None) -> Floats:
        """Density with which `sample(wo, ·)` draws `wi` [1/sr]; delta events have none and count as 0.

        Integrates to at most 1: over the upper hemisphere, or over the sphere for what transmits. The same at every
        place `uv`.
        """
        wi, wo, shape = broadcast_directions(wi, wo)
        engine.check_lengths(wi=wi, wo=wo)
        return self.sampler.pdf(wi, wo).reshape(shape)

    def albedo(self, wo: ArrayLike, samples: int = 4096) -> Floats:
        """Directional-hemispherical reflectance, (..., 3): the share of light from `wo` that is reflected at all.

        For what transmits, the share that is reflected or transmitted. It is a share of the flux: radiance that enters
        a medium is the square of the index as large, which does not count.
        """
        return self._albedo(wo, samples)[0]

    def albedo_error(self, wo: ArrayLike, samples: int = 4096) -> Floats:
        """Estimated standard error of `albedo(wo, samples)`, (..., 3)."""
        return self._albedo(wo, samples)[1]

    def _albedo(self, wo: ArrayLike, samples: int) -> tuple[Floats, Floats]:
        from .geometry.quadrature import replicated_points

        if not samples >= 1:
            raise ParameterError(f"samples must be at least 1, got {samples!r}")
        points = replicated_points(samples)
        wo = as_directions("wo", np.asarray(wo))
        views = wo.reshape(-1, 1, 1, 3)
        at_once = max(1, ALBEDO_BLOCK // points[..., 0].size)
        means = np.empty((len(views), len(points), 3))
        for start in range(0, len(views), at_once):
            block = slice(start, start + at_once)
            drawn = self.sample(views[block], points)
            means[block] = self._flux_shares(drawn, views[block]).mean(2, np.float64)
        replicates = means.reshape(*wo.shape[:-1], len(points), 3)
        errors = replicates.std(-2, ddof=1) / np.sqrt(len(points))
        return replicates.mean(-2).astype(wo.dtype), errors.astype(wo.dtype)

    def _flux_shares(self, drawn: Sample, wo: Floats) -> Floats:
        """The weights of samples as shares of the flux from wo to wi: radiance times (n(wi) / n(wo))²."""
        if self.relative_index == 1:
            return drawn.weight
        crossed = np.where(drawn.wi[..., 2] * wo[..., 2] < 0, np.sign(wo[..., 2]), 0)
        return drawn.weight * (self.relative_index ** (2 * crossed))[..., None].astype(wo.dtype)

    # ---- combination and storage -----------------------------------------------------------------------------

    def __add__(self, other: Reflectance) -> Reflectance:
        from .combinators import add

        return add(self, other) if isinstance(other, Reflectance) else NotImplemented

    def __rmul__(self, scale: Any) -> Reflectance:
        from .combinators import scaled

        return scaled(self, scale)

    __mul__ = __rmul__

    def lobes(self, count: int) -> Reflectance:
        """A sum of `count` copies that together are this reflectance, each with a scale of its own: for fitting."""
        from .combinators import lobes

        return lobes(self, count)

    @property
    def nbytes(self) -> int:
        """What the representation costs in memory: textures as stored, plus 4 bytes a number."""
        return sum(t.nbytes for t in self.textures.values()) + 4 * sum(np.size(v) for v in self.values.values())

    def named(self, name: str, source: str = "") -> Self:
        """Set name and provenance; returns self."""
        self.name, self.source = name, source or self.source
        return self

    def state(self) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
        """A JSON header and arrays that `from_state` turns back into this reflectance."""
        header: dict[str, Any] = {"kind": type(self).__name__, "name": self.name, "source": self.source}
        own, arrays = self._state()
        for key, child in self.children.items():
            child_header, child_arrays = child.state()
            header.setdefault("children", {})[key] = child_header
            arrays |= {f"{key}.{k}": v for k, v in child_arrays.items()}
        return header | own, arrays

    @abstractmethod
    def _state(self) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
        """This class's own part of `state`."""

    @classmethod
    def _restore(
        cls,
        header: Mapping[str, Any],
        arrays: Mapping[str, NDArray[Any]],
        children: Mapping[str, Reflectance],
    ) -> Reflectance:
        """The inverse of `_state`. May raise KeyError, TypeError or ValueError for a broken header."""
        raise NotImplementedError

    @staticmethod
    def from_state(header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> Reflectance:
        """The reflectance that `state` described. Raises KeyError for an unknown kind."""
        children = {
            key: Reflectance.from_state(
                child, {k[len(key) + 1 :]: v for k, v in arrays.items() if k.startswith(f"{key}.")}
            )
            for key, child in header.get("children", {}).items()
        }
        made = Reflectance._kinds[header["kind"]]._restore(header, arrays, children)
        return made.named(header.get("name", ""), header.get("source", ""))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write everything to one safetensors file, which `brdf.load` reads, and pages without Python can draw."""
        header, arrays = self.state()
        shader = embedded(self, arrays)
        if shader is not None:
            header, arrays = header | {"shader": shader[0]}, arrays | shader[1]
        container.save(path, header, arrays)

    @staticmethod
    def restore(path: str | os.PathLike[str]) -> Reflectance:
        """Read a file written by `save`. Raises CorruptFileError."""
        header, arrays = container.load(path)
        own = {name: array for name, array in arrays.items() if not name.startswith(PREFIX)}
        try:
            return Reflectance.from_state(header, own)
        except (BrdfError, LookupError, TypeError, ValueError, AttributeError, RecursionError) as error:
            raise CorruptFileError(path, f"its header does not describe a reflectance ({error}).") from None
