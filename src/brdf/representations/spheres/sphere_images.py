"""An isotropic reflectance as a few pictures of a sphere under lights at different angles [Mihalik2015].

The pictures show the radiance pi f cos(theta_i) of a unit sphere seen from afar; light and viewer span the horizontal
plane. Any pair of directions has its place in such a picture: the angle between light and viewer chooses the two
pictures next to it, the normal, seen from the viewer, the texels.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Mapping, Sequence
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import BrdfError
from ...formula import Scalar, Vec, clip, maximum, pi, texture2d
from ...reflectance import Reflectance
from ..storage import storage
from .blends import blend_options, blend_rule
from .formula import Fetch, blended, seen_from_viewer
from .pictures import checked_angles, decoded, packed
from .separated import measured_constants

Array = NDArray[np.floating[Any]]
LEAST_COSINE = 1e-6
"""The light's cosine that radiance is divided by is at least this: f cos(theta_i) stays finite at the shadow's edge."""


class SphereImages(Reflectance):
    """f(wi, wo) = I / (pi cos_i), I blended from the two pictures next to the angle phi between wi and wo:

        I = (1 - t) T_1(P(R_y(k (phi_1 - phi)) n)) + t T_2(P(R_y(k (phi_2 - phi)) n))
        t = (phi - phi_1) / (phi_2 - phi_1)

    n: the normal in the frame with the viewer at +z and the light in the plane y = 0, which is known at every pixel,
    so that perspective and point lights are exact; P drops z; k: see `blends`. Beyond the last picture it
    alone counts, turned by the same rule (the paper's: k = 3/4; "monotone" lets the trend of the last two go on);
    before the first, the first.

    Reciprocal only as far as the blend is exact: pictures are turned as the viewer sees them.
    Reference: Mihalik2015, equations 1 to 4.
    """

    spheres: Any
    floor: Any
    F0: Any
    """The texture and the constants of "separated", as `self` has them inside the formula."""

    def __init__(
        self,
        images: ArrayLike,
        angles: ArrayLike,
        *,
        storage: str = "half",
        blend: str = "monotone",
        dilated: bool = True,
        shorten: float | None = None,
        mask: bool = True,
        guard: bool = True,
        trend: bool = True,
    ) -> None:
        """`images` (N, size, size, 3): linear radiance pi f cos(theta_i), top row (y near +1) first, x near -1 in the
        first column; `angles` (N,) [degrees] between light and viewer, increasing, in [0, 180).

        `storage`: how the numbers are held, see `storage.STORAGES`; `blend`: see `with_blend`;
        `dilated`: whether the texels around the disc repeat its limb instead of being black; for the other options
        see `with_blend`. Raises ParameterError, UnknownNameError.
        """
        self._hold(*packed(images, storage), storage, angles, dilated)
        self._choose(blend, {"shorten": shorten, "mask": mask, "guard": guard, "trend": trend})

    def _hold(
        self, codes: NDArray[Any], constants: Mapping[str, ArrayLike], store: str, angles: ArrayLike, dilated: bool
    ) -> None:
        self._codes, self._storage, self._dilated = codes, store, bool(dilated)
        self._constants = {name: np.asarray(value, np.float64) for name, value in constants.items()}
        if set(self._constants) != set(storage(store).constants):
            raise ValueError(f"storage {store!r} has the constants {storage(store).constants}")
        texels = storage(store).texels(codes)
        # the pictures below each other: a lookup reads four texels, which eight are for a texture of three axes
        self._textures = {"spheres": texels.reshape(-1, *texels.shape[2:])}
        self._angles = checked_angles(angles, len(texels))

    def _choose(self, blend: str, options: Mapping[str, Any]) -> None:
        blend_rule(blend)
        self._blend, self._options = blend, blend_options(options, self._dilated)
        measured = measured_constants(self.images, self.nodes) if blend == "separated" else {}
        self._values = self._constants | measured

    @classmethod
    def bake(
        cls,
        m: Reflectance,
        angles: str | Sequence[float] = (0, 45, 90, 135),
        size: int = 512,
        storage: str = "half",
        blend: str = "separated",
        dilate: bool = True,
    ) -> SphereImages:
        """Pictures of `m` under lights at `angles` [degrees] from the viewer, `size` texels across.

        `angles` may be "plastic" (0, 45, 90, 135) or "metal" (0, 30, … 150), the paper's choices. With `dilate`, texels
        around the disc repeat its limb. The default blend is the nearest to what is baked (docs/sphere-images.md);
        that of the class itself, "monotone", takes nothing from the pictures but their texels. Raises ReflectanceError
        for an `m` that is anisotropic, transmits or mirrors, ParameterError, UnknownNameError.
        """
        from .bake import named_angles, sphere_pictures

        degrees = checked_angles(named_angles(angles))
        images = sphere_pictures(m, degrees, size, dilate)
        made = cls(images, degrees, storage=storage, blend=blend, dilated=dilate)
        return made.named(m.name, f"{m.source or m.name}, baked as pictures of spheres")

    def with_blend(self, blend: str, **options: Any) -> Self:
        """The same pictures under another rule: "full", "half", "paper" (Eq. 2, its halves, Eq. 4), "monotone" or
        "separated" (see `blends` and `separated`), with options

        - `shorten`: factor on the normal, default 1, for pictures on black ground 0.995;
        - `mask`: in the fixed view (`fixed_view`), whether normals turned away from the light are black, default True;
          as a reflectance it always is;
        - `guard`: whether a picture in which the turned normal is out of sight leaves the pixel to the other one,
          default True ("separated" fades such pictures out in any case);
        - `trend`: whether "monotone" lets the trend of the last two pictures go on beyond the last, default True.

        Raises UnknownNameError, ParameterError.
        """
        made = copy.copy(self)
        made.__dict__.pop("_sampler", None)
        made._choose(blend, options)
        return made

    def beside(self, angle: float) -> Self:
        """The two pictures next to `angle` [degrees] alone, which say what all of them do where light and viewer are
        that far apart: enough for one distant light and parallel rays. For drawing with, not for keeping.
        """
        first = int(np.clip(np.searchsorted(self._angles, angle, "right") - 1, 0, len(self._angles) - 2))
        made = copy.copy(self)
        made.__dict__.pop("_sampler", None)
        pair = slice(first, first + 2)
        made._hold(self._codes[pair], self._constants, self._storage, self._angles[pair], self._dilated)
        return made

    # ---- what it holds -------------------------------------------------------------------------------------------

    @property
    def images(self) -> NDArray[np.float32]:
        """(N, size, size, 3) radiance as stored, decoded."""
        return decoded(self.texels, self._storage, self._constants)

    @property
    def texels(self) -> NDArray[np.float32]:
        """(N, size, size, 3) what a lookup reads and `storage` decodes."""
        return self._textures["spheres"].reshape(len(self._angles), self.size, self.size, 3)

    @property
    def angles(self) -> Array:
        """(N,) degrees between light and viewer."""
        return np.array(self._angles)

    @property
    def nodes(self) -> tuple[float, ...]:
        """The same in radians."""
        return tuple(map(math.radians, self._angles))

    @property
    def size(self) -> int:
        """Texels across a picture."""
        return int(self._textures["spheres"].shape[1])

    @property
    def blend(self) -> str:
        return self._blend

    @property
    def options(self) -> dict[str, Any]:
        """Shortening factor, mask, guard and trend, see `with_blend`."""
        return dict(self._options)

    @property
    def dilated(self) -> bool:
        """Whether the texels around the disc repeat its limb."""
        return self._dilated

    @property
    def storage(self) -> str:
        return self._storage

    @property
    def nbytes(self) -> int:
        """The codes, and 4 bytes an angle and a constant."""
        return self._codes.nbytes + 4 * (len(self._angles) + sum(v.size for v in self._constants.values()))

    def __repr__(self) -> str:
        angles = ", ".join(f"{angle:g}" for angle in self._angles)
        kind = f"{self.size} x {self.size} at {angles} degrees, {self._blend}, {self._storage}, {self.nbytes:,} bytes"
        return f"SphereImages({self.name or 'unnamed'}: {kind})"

    # ---- the contract --------------------------------------------------------------------------------------------

    @property
    def structure(self) -> tuple[Any, ...]:
        return (SphereImages, self._angles, self.size, self._blend, self._storage, *self._options.items())

    @property
    def values(self) -> Mapping[str, Any]:
        return self._values

    @property
    def textures(self) -> Mapping[str, NDArray[Any]]:
        return self._textures

    def f(self, wi: Vec, wo: Vec) -> Vec:
        f: Vec = self.radiance(*seen_from_viewer(wi, wo)) * (1.0 / (pi * maximum(wi.z, LEAST_COSINE)))
        return f

    def radiance(self, n_x: Scalar, n_y: Scalar, n_z: Scalar, phi: Scalar, fetch: Fetch | None = None) -> Vec:
        """The formula: pi f cos(theta_i) of a normal seen from +z with the light at (sin phi, 0, cos phi).

        `fetch` may stand in for `self.fetch`.
        """
        return blended(self, n_x, n_y, n_z, phi, fetch or self.fetch)

    def fetch(self, number: Scalar, u: Scalar, v: Scalar) -> Vec:
        """The formula: picture `number` at u (left to right) and v (top to bottom) in [0, 1], filtered linearly."""
        edge = 0.5 / self.size  # the centre of the outermost texels: beyond lies the next picture
        return texture2d(self.spheres, (number + clip(v, edge, 1.0 - edge)) * (1 / len(self._angles)), u)

    # ---- storage -------------------------------------------------------------------------------------------------

    def _state(self) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
        header = {
            "angles": list(self._angles),
            "storage": self._storage,
            "dilated": self._dilated,
            "constants": {name: value.tolist() for name, value in self._constants.items()},
            "blend": self._blend,
            "options": self._options,
        }
        return header, {"codes": self._codes}

    @classmethod
    def _restore(cls, header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]], children: Any) -> Reflectance:
        made = cls.__new__(cls)
        try:
            made._hold(arrays["codes"], header["constants"], header["storage"], header["angles"], header["dilated"])
            made._choose(header["blend"], header["options"])
        except BrdfError as error:
            raise ValueError(error) from None
        return made
