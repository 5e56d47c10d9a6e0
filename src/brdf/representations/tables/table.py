"""One class for every gridded reflectance: a grid of nodes over three or four angles, interpolated.

What distinguishes a measured MERL table, the tables of papers and a 16 KB slice stack is data here: the basis (which
angles), a warp for each axis (where the nodes lie), the encoding (what is stored in place of f), and the storage
(floats, halves, packed bits).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import BrdfError, UnknownNameError
from ...formula import Vec
from ...formula.engine import check_lengths
from ...geometry.arguments import as_directions, broadcast_directions
from ...reflectance import Reflectance
from ..storage import storage
from .albedo_table import NBYTES, AlbedoTable, restored, tabulate
from .bases import cos_difference
from .filters import PREFILTERED, prefiltered
from .layout import Layout, layout_from

Array = NDArray[np.floating[Any]]


class Table(Reflectance):
    """f = decode(texture(angles(wi, wo))): a grid of nodes over three angles, or four where anisotropic.

    `codes` are the stored numbers (see `storage`), `constants` the (3,) arrays that go with them: `floor` where the
    encoding uses one, `low` and `span` for packed storage. `measured`, if given, says for each node (shape of the
    grid) whether its value was measured; the other nodes hold values filled in from their neighbours. `albedos`, if
    given, is the table's directional albedo (see `with_albedo`).
    """

    grid: Any
    floor: Any
    """The texture and the floor, as `self` has them inside the formula."""

    def __init__(
        self,
        layout: Layout,
        codes: NDArray[Any],
        constants: Mapping[str, ArrayLike] | None = None,
        measured: NDArray[np.bool_] | None = None,
        albedos: AlbedoTable | None = None,
    ) -> None:
        self.layout = layout
        self._albedos = albedos
        self._codes = codes
        self._values = {k: np.asarray(v, np.float64) for k, v in (constants or {}).items()}
        texels = storage(layout.storage).texels(codes)
        self._measured = measured
        if texels.shape != (*layout.shape, 3):
            raise ValueError(f"codes {codes.shape} {codes.dtype} do not fill a grid of shape {layout.shape}")
        self._textures = {"grid": texels if layout.basis.isotropic else texels.reshape(*layout.texture_shape, 3)}
        expected = {*storage(layout.storage).constants, *(("floor",) if "floor" in self._values else ())}
        if set(self._values) != expected or any(v.shape != (3,) for v in self._values.values()):
            raise ValueError(f"constants must be (3,) arrays {sorted(expected)}, got {sorted(self._values)}")
        numbers: list[NDArray[Any]] = [self._textures["grid"], *self._values.values()]
        if not all(np.isfinite(array).all() for array in numbers):
            raise ValueError("the table holds NaN or infinity")
        if measured is not None and (measured.shape != layout.shape or measured.dtype != np.bool_):
            raise ValueError(f"`measured` must be booleans of shape {layout.shape}, got {measured.shape}")

    @classmethod
    def encoded(
        cls, layout: Layout, stored: Array, floor: ArrayLike | None = None, measured: NDArray[np.bool_] | None = None
    ) -> Table:
        """A table of encoded values (*shape, 3) at the nodes, packed here; `floor` (3,) is what was subtracted.

        A prefiltered spline's coefficients are made here, too.
        """
        if layout.filter == PREFILTERED:
            stored = prefiltered(stored)
        codes, constants = storage(layout.storage).pack(stored)
        if floor is not None:
            constants["floor"] = np.asarray(floor, np.float64)
        return cls(layout, codes, constants, measured)

    @classmethod
    def bake(
        cls,
        m: Reflectance,
        basis: str = "half",
        warp: str = "bezier",
        shape: tuple[int, ...] | int = (64, 64, 16),
        storage: str = "half",
        filter: str | None = None,
        alpha: tuple[float, float] | tuple[float, float, float] | str | None = None,
        encoding: str | None = None,
        method: str = "points",
        budget: str | int | None = None,
        quality: str | None = None,
    ) -> Table:
        """`m` as a table.

        `basis`: "half" (theta_h, theta_d, phi_d), "normal" (theta_i, theta_o, phi_delta), "sheared", "marschner" or
        "stark"; `warp`: "uniform", "bezier" (with `alpha`: for the polar angles and the azimuth, or for every axis,
        or how to choose it, "total-intensity" or "measured"), "identity" (even cosines; not in the half basis) or
        "merl" (the half basis alone). `shape`: nodes over each axis, or N for the preset of 2 N^3 nodes. With four
        numbers in `shape`, the first for the azimuth (phi_h or phi_i), the table is anisotropic; phi_d then covers half
        a turn and phi_delta a whole one.

        `encoding`: what is stored, "f", "sqrt", "cube-root" or "log" (ln(f + 1e-3)); None: "log" over half vectors.
        `storage`: see `storage`; `filter`: see `filters`, by default linear. `method`: "points" evaluates `m` at the
        nodes, those below the horizon repeating the last value above it; "projection" takes the table nearest to `m`
        between them, which keeps integrals where a table shrinks.

        With a `budget` (bytes, or a text such as "64K") all of these but `filter` are searched for the table of that
        size nearest to `m`: see `budget.search`; `quality="adaptive"` tries fewer, in a second or two.

        Raises ReflectanceError for an anisotropic `m` and three numbers, UnknownNameError for a name, ParameterError
        for an alpha outside [0, 1], an impossible budget, or an option beside a budget that searches for it.
        """
        if budget is not None or quality is not None:
            from ..baking.budget import bake_budget

            fixed = {"basis": basis, "warp": warp, "shape": shape, "storage": storage, "alpha": alpha,
                     "encoding": encoding, "method": method}  # fmt: skip
            return bake_budget(m, budget, quality, filter, fixed)
        from ..baking.alpha_search import with_alpha
        from ..baking.bake import bake_points
        from ..baking.projection import bake_projection
        from .layouts import named_layout, shape_of

        methods: dict[str, Callable[[Reflectance, Layout], Table]] = {
            "points": bake_points,
            "projection": bake_projection,
        }
        if method not in methods:
            raise UnknownNameError("bake method", method, methods)
        sizes = shape_of(basis, shape, m.isotropic) if isinstance(shape, int) else tuple(shape)
        pair = alpha if isinstance(alpha, tuple) and len(alpha) == 2 else None if alpha is None else (0.5, 0.5)
        layout = named_layout(basis, warp, sizes, storage, filter or "linear", pair, encoding)
        if alpha is not None and pair is not alpha:
            layout = with_alpha(m, layout, alpha)
        return methods[method](m, layout)

    # ---- the contract ------------------------------------------------------------------------------------------

    @property
    def structure(self) -> tuple[Any, ...]:
        return (Table, self.layout, *self._values)

    @property
    def values(self) -> Mapping[str, Any]:
        return self._values

    @property
    def textures(self) -> Mapping[str, NDArray[Any]]:
        return self._textures

    def f(self, wi: Vec, wo: Vec) -> Vec:
        layout = self.layout
        texel = layout.fetch(self.grid, layout.basis.angles(wi, wo))
        stored = storage(layout.storage).value(texel, self)
        floor = self.floor if "floor" in self._values else 0.0
        return layout.encoding.decode(stored, cos_difference(wi, wo), floor)

    @property
    def isotropic(self) -> bool:
        return self.layout.basis.isotropic

    @property
    def nbytes(self) -> int:
        """The codes, 4 bytes a constant, 1 bit a node for what was measured, and the albedos it carries."""
        mask = 0 if self._measured is None else (self._measured.size + 7) // 8
        albedos = 0 if self._albedos is None else NBYTES
        return self._codes.nbytes + mask + albedos + 4 * sum(np.size(v) for v in self._values.values())

    def __repr__(self) -> str:
        layout = self.layout
        size = " x ".join(f"{n} {axis}" for n, axis in zip(layout.shape, layout.basis.axes, strict=True))
        return f"Table({self.name or 'unnamed'}: {size}, {layout.storage}, {self.nbytes:,} bytes)"

    # ---- albedo ------------------------------------------------------------------------------------------------

    def with_albedo(self) -> Table:
        """This table with its directional albedo computed, which `albedo` then looks up and files keep.

        Raises ReflectanceError for an anisotropic table.
        """
        table = Table(self.layout, self._codes, self._values, self._measured, tabulate(self))
        return table.named(self.name, self.source)

    def _albedo(self, wo: ArrayLike, samples: int) -> tuple[Array, Array]:
        if self._albedos is None:
            return super()._albedo(wo, samples)
        wo = as_directions("wo", np.asarray(wo))
        check_lengths(wo=wo.reshape(-1, 3))
        albedo, error = self._albedos.look_up(wo[..., 2])
        return albedo.astype(wo.dtype), error.astype(wo.dtype)

    # ---- the grid ----------------------------------------------------------------------------------------------

    @property
    def codes(self) -> NDArray[Any]:
        """The stored numbers, as saved."""
        return self._codes

    @property
    def measured(self) -> NDArray[np.bool_]:
        """For each node whether its value was measured (all True where nothing is known to be filled in)."""
        return np.ones(self.layout.shape, np.bool_) if self._measured is None else self._measured

    @property
    def has_holes(self) -> bool:
        """Whether some nodes are filled in."""
        return self._measured is not None

    def valid(self, wi: ArrayLike, wo: ArrayLike) -> NDArray[np.bool_]:
        """Whether the values at (..., 3) directions rest on measurements: above the horizon, and at least half of the
        interpolation's weight on measured nodes. Returns (...) booleans."""
        wi, wo, shape = broadcast_directions(wi, wo)
        above = (wi[:, 2] > 0) & (wo[:, 2] > 0)
        if self._measured is not None:
            with np.errstate(all="ignore"):
                angles = self.layout.basis.angles(Vec(*wi.T), Vec(*wo.T))
                share = self.layout.fetch(self._mask_texels, angles, "linear")[0]
            above &= share >= 0.5
        return above.reshape(shape)

    @cached_property
    def _mask_texels(self) -> NDArray[np.bool_]:
        return self.measured.reshape(*self.layout.texture_shape, 1)

    # ---- storage -----------------------------------------------------------------------------------------------

    def _state(self) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
        header = {"layout": self.layout.state, "constants": {k: v.tolist() for k, v in self._values.items()}}
        arrays = {"codes": self._codes}
        if self._measured is not None:
            arrays["measured"] = np.packbits(self._measured)
        if self._albedos is not None:
            arrays["albedo"] = np.stack(self._albedos)
        return header, arrays

    @classmethod
    def _restore(cls, header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]], children: Any) -> Reflectance:
        try:
            layout = layout_from(header["layout"])
        except BrdfError as error:
            raise ValueError(error) from None
        measured = None
        if "measured" in arrays:
            bits = np.unpackbits(arrays["measured"], count=int(np.prod(layout.shape)))
            measured = bits.reshape(layout.shape).astype(np.bool_)
        albedos = restored(arrays["albedo"]) if "albedo" in arrays else None
        return cls(layout, arrays["codes"], header["constants"], measured, albedos)
