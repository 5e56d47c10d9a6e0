"""An isotropic reflectance as a few pictures of a sphere under lights at different angles [Mihalik2015].

The pictures show the radiance pi f cos(theta_i) of a unit sphere seen from afar; light and viewer span the horizontal
plane. Any pair of directions has its place in such a picture: the angle between light and viewer chooses the two
pictures next to it, the normal, seen from the viewer, the texels.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import BrdfError, ParameterError
from ..formula import Scalar, Vec, atan2, cos, cross, dot, length, maximum, pi, sin, sqrt, texture3d, where
from ..reflectance import Reflectance
from .sphere_images_blends import blend_rule, neighbours
from .sphere_images_separated import View, combined, measured_constants
from .storage import storage

Array = NDArray[np.floating[Any]]
Fetch = Callable[[Scalar, Scalar, Scalar], Vec]
"""(number of the picture, u, v) -> texel."""

SHORTENING = 0.995
"""The paper's remedy for pictures on a black ground: normals are shortened, so that no lookup touches the ground."""

LEAST_COSINE = 1e-6
"""The light's cosine that radiance is divided by is at least this: f cos(theta_i) stays finite at the shadow's edge."""

SAME_DIRECTION = 1e-6
"""Sine of the angle between light and viewer below which they count as one direction."""


class SphereImages(Reflectance):
    """f(wi, wo) = I / (pi cos_i), I blended from the two pictures next to the angle phi between wi and wo:

        I = (1 - t) T_1(P(R_y(k (phi_1 - phi)) n)) + t T_2(P(R_y(k (phi_2 - phi)) n))
        t = (phi - phi_1) / (phi_2 - phi_1)

    n: the normal in the frame with the viewer at +z and the light in the plane y = 0, which is known at every pixel,
    so that perspective and point lights are exact; P drops z; k: see `sphere_images_blends`. Beyond the last picture it
    alone counts, turned by the same rule (the paper's: k = 3/4); before the first, the first.

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
    ) -> None:
        """`images` (N, size, size, 3): linear radiance pi f cos(theta_i), top row (y near +1) first, x near -1 in the
        first column; `angles` (N,) [degrees] between light and viewer, increasing, in [0, 180).

        `storage`: how the numbers are held, see `storage.STORAGES`; `blend`: see `with_blend`;
        `dilated`: whether the texels around the disc repeat its limb instead of being black; for the other options
        see `with_blend`. Raises ParameterError, UnknownNameError.
        """
        self._hold(*_packed(_checked_images(images), storage), storage, angles, dilated)
        self._choose(blend, {"shorten": shorten, "mask": mask, "guard": guard})

    def _hold(
        self, codes: NDArray[Any], constants: Mapping[str, ArrayLike], store: str, angles: ArrayLike, dilated: bool
    ) -> None:
        self._codes, self._storage, self._dilated = codes, store, bool(dilated)
        self._constants = {name: np.asarray(value, np.float64) for name, value in constants.items()}
        if set(self._constants) != set(storage(store).constants):
            raise ValueError(f"storage {store!r} has the constants {storage(store).constants}")
        texels = storage(store).texels(codes)
        self._textures = {"spheres": texels}
        self._angles = checked_angles(angles, len(texels))

    def _choose(self, blend: str, options: Mapping[str, Any]) -> None:
        blend_rule(blend)
        shorten = options["shorten"]
        if shorten is None:
            shorten = 1.0 if self._dilated else SHORTENING
        if not 0 < shorten <= 1:
            raise ParameterError(f"shorten must lie in (0, 1], got {shorten!r}")
        self._blend = blend
        measured = measured_constants(self.images, self._nodes) if blend == "separated" else {}
        self._values = self._constants | measured
        self._options = {"shorten": float(shorten), "mask": bool(options["mask"]), "guard": bool(options["guard"])}

    @classmethod
    def bake(
        cls,
        m: Reflectance,
        angles: str | Sequence[float] = (0, 45, 90, 135),
        size: int = 512,
        storage: str = "half",
        blend: str = "monotone",
        dilate: bool = True,
    ) -> SphereImages:
        """Pictures of `m` under lights at `angles` [degrees] from the viewer, `size` texels across.

        `angles` may be "plastic" (0, 45, 90, 135) or "metal" (0, 30, … 150), the paper's choices. With `dilate`, texels
        around the disc repeat its limb. Raises ReflectanceError for an `m` that is anisotropic, transmits or mirrors,
        ParameterError, UnknownNameError.
        """
        from .sphere_images_bake import named_angles, sphere_pictures

        degrees = checked_angles(named_angles(angles))
        images = sphere_pictures(m, degrees, size, dilate)
        made = cls(images, degrees, storage=storage, blend=blend, dilated=dilate)
        return made.named(m.name, f"{m.source or m.name}, baked as pictures of spheres")

    def with_blend(self, blend: str, **options: Any) -> Self:
        """The same pictures under another rule: "full", "half", "paper" (Eq. 2, its halves, Eq. 4), "monotone" or
        "separated" (see `sphere_images_blends` and `sphere_images_separated`), with options

        - `shorten`: factor on the normal, default 1, for pictures on black ground 0.995;
        - `mask`: in the fixed view (`fixed_view`), whether normals turned away from the light are black, default True;
          as a reflectance it always is;
        - `guard`: whether a picture in which the turned normal is out of sight leaves the pixel to the other one,
          default True ("separated" fades such pictures out in any case).

        Raises UnknownNameError, ParameterError.
        """
        unknown = set(options) - {"shorten", "mask", "guard"}
        if unknown:
            raise ParameterError(f"unknown option {sorted(unknown)[0]!r}; a blend takes shorten, mask and guard")
        made = copy.copy(self)
        made.__dict__.pop("_sampler", None)
        made._choose(blend, {"shorten": None, "mask": True, "guard": True} | options)
        return made

    # ---- what it holds -------------------------------------------------------------------------------------------

    @property
    def images(self) -> NDArray[np.float32]:
        """(N, size, size, 3) radiance as stored, decoded."""
        texels = self._textures["spheres"]
        channels = storage(self._storage).value(Vec(*np.moveaxis(texels, -1, 0)), _Channels(self._constants))
        return np.stack(channels.components, -1).astype(np.float32)

    @property
    def angles(self) -> Array:
        """(N,) degrees between light and viewer."""
        return np.array(self._angles)

    @property
    def _nodes(self) -> tuple[float, ...]:
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
        """Shortening factor, mask and guard, see `with_blend`."""
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
        return (SphereImages, self._angles, self._blend, self._storage, *self._options.items())

    @property
    def values(self) -> Mapping[str, Any]:
        return self._values

    @property
    def textures(self) -> Mapping[str, NDArray[Any]]:
        return self._textures

    def f(self, wi: Vec, wo: Vec) -> Vec:
        across = cross(wi - wo, wo)  # wi x wo; the difference keeps its digits when the two are close
        sine = length(across)
        apart = sine > SAME_DIRECTION
        scale = 1.0 / maximum(sine, SAME_DIRECTION)
        n_x = where(apart, (wo.x * across.y - wo.y * across.x) * scale, sqrt(maximum(1.0 - wo.z * wo.z, 0.0)))
        n_y = where(apart, -across.z * scale, 0.0)
        radiance = self.radiance(n_x, n_y, wo.z, atan2(sine, dot(wi, wo)))
        f: Vec = radiance * (1.0 / (pi * maximum(wi.z, LEAST_COSINE)))
        return f

    def radiance(self, n_x: Scalar, n_y: Scalar, n_z: Scalar, phi: Scalar, fetch: Fetch | None = None) -> Vec:
        """The formula: pi f cos(theta_i) of a normal seen from +z with the light at (sin phi, 0, cos phi).

        `fetch` may stand in for `self.fetch`.
        """
        fetch, shorten = fetch or self.fetch, self._options["shorten"]
        a = atan2(n_x, n_z)
        rho = sqrt(n_x * n_x + n_z * n_z)
        first, second, number, t = neighbours(phi, self._nodes)
        k = blend_rule(self._blend)(a, phi, self._nodes[-1])
        a_1 = a + k * (first - phi)
        a_2 = a + k * (second - phi)
        v = 0.5 - 0.5 * shorten * n_y
        store = storage(self._storage)
        value_1 = store.value(fetch(number, 0.5 + 0.5 * shorten * rho * sin(a_1), v), self)
        value_2 = store.value(fetch(number + 1.0, 0.5 + 0.5 * shorten * rho * sin(a_2), v), self)
        if self._blend == "separated":
            view = View(a, rho, phi)
            return combined((value_1, value_2), (a_1, a_2), (first, second), t, view, self.floor, self.F0)
        if self._options["guard"]:
            t = where(cos(a_1) < 0.0, 1.0, where(cos(a_2) < 0.0, 0.0, t))
        radiance: Vec = value_1 * (1.0 - t) + value_2 * t
        return radiance

    def fetch(self, number: Scalar, u: Scalar, v: Scalar) -> Vec:
        """The formula: picture `number` at u (left to right) and v (top to bottom) in [0, 1], filtered linearly."""
        return texture3d(self.spheres, (number + 0.5) * (1 / len(self._angles)), v, u)

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


class _Channels:
    """(3,) constants of a storage as the formula has them."""

    def __init__(self, values: Mapping[str, Array]) -> None:
        self.__dict__.update({name: Vec(*value) for name, value in values.items()})


def _packed(images: Array, store: str) -> tuple[NDArray[Any], Mapping[str, ArrayLike]]:
    return storage(store).pack(images)


def _checked_images(images: ArrayLike) -> Array:
    """(N, size, size, 3) float32. Raises ParameterError."""
    array = np.asarray(images, np.float32)
    if array.ndim != 4 or array.shape[1] != array.shape[2] or array.shape[3] != 3 or array.shape[1] < 2:
        raise ParameterError(f"images must have shape (N, size, size, 3), got {array.shape}")
    if not np.isfinite(array).all():
        raise ParameterError("the images hold NaN or infinity; replace those pixels first")
    return array


def checked_angles(angles: ArrayLike, count: int | None = None) -> tuple[float, ...]:
    """The angles [degrees]: at least 2 (and `count`), increasing, in [0, 180). Raises ParameterError."""
    array = np.asarray(angles, np.float64)
    if array.ndim != 1 or len(array) < 2:
        raise ParameterError(f"at least 2 pictures at increasing angles are needed, got angles {angles!r}")
    if count is not None and len(array) != count:
        raise ParameterError(f"{count} pictures have {len(array)} angles; give one angle a picture")
    if not (np.all(np.diff(array) > 0) and array[0] >= 0 and array[-1] < 180):
        raise ParameterError(f"angles must increase within [0, 180) degrees, got {[float(a) for a in array]}")
    return tuple(float(a) for a in array)
