"""Shading maps: the mesostructure of a flat sample from a few photographs, under any reflectance."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import BrdfError, ParameterError, ReflectanceError
from ...formula import Scalar
from ...formula.vec import Vec
from ...geometry.sampling import CosineSampler, MixtureSampler, Sampler
from ...parameters import Parameterised, choice, number
from ...reflectance import Floats, Reflectance
from ..tables.table import Table
from . import quilting
from .compression import CompressionRow, compressed, compression_table
from .lookup import TECHNIQUES, looked_up, looked_up_arrays, luminous, pictures_at
from .photographs import average_brdf, matching_sigma, pictures_of
from .slices import Slices
from .stack import Stack

COSINE_SHARE = 0.25
"""Share of draws from a cosine lobe: some texels reflect where the average does not."""


class ShadingMap(Parameterised, Reflectance):
    """Pictures of a flat sample, looked up by what a reflectance says of their average.

        f(wi, wo, uv) = S(r; uv) / cos_i,      r = sigma Y(f_brdf(wi, wo)) cos_i      [1/sr]

    S(r) is the picture of the sample whose average luminance is r, interpolated between pictures that were taken; so
    the surface as a whole reflects as sigma · brdf does, and shows the sample's structure. Darker than the darkest
    picture, that one is scaled; so is the brightest above itself (or r is clamped there). It takes the sample to be
    isotropic and its structure small: shadows keep the direction they had. Reference: Kautz2004.

    Made by `from_images`. `elevations` (N,): the light's angle from the normal [degrees] of each picture, darkest
    first; `photographed` (M, 2): angle and average of all photographs; `dropped`: angles of those left out.
    """

    varies = True
    breaks = {"reciprocity": "the picture is chosen by f cos_i, in which light and viewer differ [Kautz2004]"}  # noqa: RUF012

    above: str = choice("r beyond the brightest picture", "scale", {"scale": None, "clamp": None})
    technique: str = choice("how pictures are looked up", "shading", TECHNIQUES)
    sigma: Scalar = number("factor from the BRDF to the sample's average", 1.0, 0.0)
    intensity: Scalar = number("irradiance that the technique 'radiance' assumes", 1.0, 0.0)
    tiles: Scalar = number("copies along each side of the texture, of a map that tiles", 1.0, 1e-3, 1e5)

    def __init__(
        self, stack: Stack, brdf: Reflectance, elevations: ArrayLike, photographed: ArrayLike = (),
        dropped: Sequence[float] = (), **parameters: Any,
    ) -> None:  # fmt: skip
        """Raises ParameterError, and ReflectanceError for a brdf with delta events, or that transmits."""
        super().__init__(**parameters)
        if brdf.has_delta or brdf.transmits:
            raise ReflectanceError(
                f"{brdf.name or brdf!r} cannot light a shading map: it has delta events or transmits"
            )
        self.stack, self._children = stack, {"brdf": brdf}
        self.elevations = np.asarray(elevations, np.float64)
        self.photographed = np.asarray(photographed, np.float64).reshape(-1, 2)
        self.dropped = tuple(map(float, dropped))
        if self.elevations.shape != stack.nodes.shape:
            raise ParameterError(f"{len(stack.nodes)} pictures need as many elevations, got {self.elevations.shape}")
        if self.technique == "angular" and not (np.diff(self.elevations) < 0).all():
            raise ParameterError("the angular technique needs pictures that grow darker towards grazing light")
        if self.tiles != 1 and not stack.wraps:
            raise ParameterError("only a map that tiles can be repeated; make it one with tileable()")
        self.name = f"shading map under {brdf.name or type(brdf).__name__}"

    @classmethod
    def from_images(
        cls, photographs: Sequence[ArrayLike], elevations: ArrayLike, brdf: Reflectance | None = None,
        mode: str = "native", slices: int = 8, above: str = "scale", sigma: float | None = None,
        branch: str = "descending",
    ) -> ShadingMap:  # fmt: skip
        """From M >= 2 photographs (rows, columns, 3), linear, of a flat sample seen along its normal.

        Each lit by a distant lamp of irradiance 1 at normal incidence, whose angle from the normal is in `elevations`
        (M,) [degrees, 0 <= angle < 90], the azimuth always the same. `brdf`: any reflectance, by default the sample's
        own average (`average_brdf`). `mode` "native" keeps each picture at its own average; "paper" resamples them to
        `slices` even steps, a black one included. `sigma` None is what brings brdf · cos nearest to the photographs'
        averages. `branch`: where averages do not fall steadily towards grazing light (velvet), "descending" keeps the
        pictures from the brightest one on, "all" keeps every one; `dropped` tells which were left out.
        Negative pixels count as 0. Raises ParameterError, UnknownNameError, ReflectanceError.
        """
        kept = pictures_of(photographs, elevations, mode, slices, branch)
        brdf = average_brdf(kept.photographed) if brdf is None else brdf
        sigma = matching_sigma(brdf, kept.photographed) if sigma is None else sigma
        return cls(kept.slices, brdf, kept.elevations, kept.photographed, kept.dropped, above=above, sigma=sigma)

    def replaced(self, **changes: Any) -> ShadingMap:
        """A copy with other parameters (`technique="angular"`, `tiles=4`), another `brdf` or another `stack`."""
        parts: dict[str, Any] = {"stack": self.stack, "brdf": self._children["brdf"], "elevations": self.elevations,
                 "photographed": self.photographed, "dropped": self.dropped}  # fmt: skip
        return type(self)(**parts | self._chosen | self._values | changes).named(self.name, self.source)

    def average_brdf(self) -> Table:
        """The sample's own average BRDF; under it the map predicts every kept photograph. Raises ReflectanceError."""
        if not len(self.photographed):
            raise ReflectanceError("this shading map does not know its photographs' averages")
        return average_brdf(self.photographed)

    # ---- smaller, larger -------------------------------------------------------------------------------------

    def compress(self, bytes_per_texel: int = 6, method: str | None = None) -> ShadingMap:
        """The map in few bytes a texel, rendered from as it is.

        `method`: "pca" (the default, 1 to 6 bytes), "quadratic", "power-joint", "power", or the paper's
        "power-brute-force" (6 bytes). Raises ReflectanceError for a map that is compressed, ParameterError,
        UnknownNameError.
        """
        return self.replaced(stack=compressed(self._slices("compressed"), bytes_per_texel, method))

    def compression_table(self, held_out: Sequence[NDArray[Any]] = ()) -> list[CompressionRow]:
        """Error against bytes for every method; `held_out`: more pictures (rows, columns, 3) of the sample."""
        return compression_table(self._slices("compressed"), held_out)

    def mipmaps(self) -> list[ShadingMap]:
        """The map at half, a quarter, … of its size, down to one texel: what to show from further away."""
        level, levels = self._slices("filtered"), []
        while max(level.shape) > 1:
            level = level.halved()
            levels.append(self.replaced(stack=level))
        return levels

    def tileable(self) -> ShadingMap:
        """A part of the map, nearly as large, that continues at its opposite edges. Raises ParameterError."""
        return self.replaced(stack=self.stack.gathered(quilting.tile(self.stack.features()), wraps=True))

    def synthesise(self, size: int | tuple[int, int], seed: int = 0) -> ShadingMap:
        """The map grown to `size` (rows, columns) by quilting; it tiles. All pictures get the same texels.

        Raises ParameterError.
        """
        texels = quilting.quilt(self.stack.features(), size, seed)
        return self.replaced(stack=self.stack.gathered(texels, wraps=True))

    def _slices(self, what: str) -> Slices:
        if not isinstance(self.stack, Slices):
            raise ReflectanceError(f"this shading map is compressed; it is {what} from the pictures alone")
        return self.stack

    # ---- the contract ------------------------------------------------------------------------------------------

    @property
    def has_formula(self) -> bool:
        return self._children["brdf"].has_formula

    @property
    def isotropic(self) -> bool:
        return self._children["brdf"].isotropic

    @property
    def children(self) -> Mapping[str, Reflectance]:
        return self._children

    @property
    def structure(self) -> tuple[Any, ...]:
        return (ShadingMap, self.above, self.technique, self.stack.structure, self._children["brdf"].structure)

    @property
    def values(self) -> dict[str, Any]:
        angles = {f"angle_{k + 1}": float(angle) for k, angle in enumerate(self.elevations)}
        own = super().values | self.stack.values | (angles if self.technique == "angular" else {})
        return own | self._of_brdf("values")

    @property
    def textures(self) -> dict[str, NDArray[Any]]:
        return self.stack.textures | self._of_brdf("textures")

    def _of_brdf(self, what: str) -> dict[str, Any]:
        return {f"brdf_{name}": value for name, value in getattr(self._children["brdf"], what).items()}

    @property
    def nbytes(self) -> int:
        return self.stack.nbytes + self._children["brdf"].nbytes

    def f(self, wi: Vec, wo: Vec) -> Vec:
        bound: Any = self
        reflected = bound.sigma * luminous(bound.brdf.f(wi, wo))
        return looked_up(bound, reflected, wi.z, TECHNIQUES[self.technique])

    def _evaluate_places(self, wi: Floats, wo: Floats, uv: Floats, clamp: bool) -> Floats:
        brdf = self._children["brdf"]
        value = brdf(wi, wo, uv) if brdf.varies else brdf(wi, wo)
        reflected = np.asarray(self.sigma * luminous(Vec(*value.T)), wi.dtype)
        return looked_up_arrays(self, reflected, np.maximum(wi[:, 2], 0), uv, TECHNIQUES[self.technique])

    def lookup(self, r: ArrayLike, uv: ArrayLike) -> NDArray[np.float64]:
        """S(r) at places: r (...) >= 0, `uv` (..., 2) -> (..., 3) radiance per irradiance. Raises ParameterError."""
        return pictures_at(self, r, uv)

    def picture(self, r: float) -> NDArray[np.float64]:
        """S(r) as a picture (rows, columns, 3): the sample lit so that its average luminance is r >= 0."""
        if not r >= 0:
            raise ParameterError(f"r must be at least 0, got {r!r}")
        return self.stack.scaled_picture(min(r, self.stack.highest) if self.above == "clamp" else r)

    def _make_sampler(self) -> Sampler:
        shares = [1 - COSINE_SHARE, COSINE_SHARE]
        return MixtureSampler([self._children["brdf"].sampler, CosineSampler()], shares)

    def _state(self) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
        header, arrays = self.stack.state()
        own = {"parameters": self._chosen | self._values, "stack": {"kind": type(self.stack).__name__, **header},
               "elevations": self.elevations.tolist(), "photographed": self.photographed.tolist(),
               "dropped": list(self.dropped)}  # fmt: skip
        return own, arrays

    @classmethod
    def _restore(cls, header: Any, arrays: Mapping[str, NDArray[Any]], children: Any) -> Reflectance:
        described = header["stack"]
        try:
            stack = Stack.kinds[described["kind"]].restored(described, arrays)
            return cls(stack, children["brdf"], header["elevations"], header["photographed"], header["dropped"],
                       **header["parameters"])  # fmt: skip
        except BrdfError as error:
            raise ValueError(error) from None

    def __repr__(self) -> str:
        rows, columns = self.stack.shape
        kind = f"{len(self.stack.nodes)} pictures as {type(self.stack).__name__}"
        return f"ShadingMap({self.name}: {rows} x {columns}, {kind}, {self.stack.bytes_per_texel:g} bytes a texel)"
