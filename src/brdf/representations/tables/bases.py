"""Table bases: which angles of two directions a table runs over.

A basis turns directions into angles as a formula, and angles into directions on NumPy arrays, to place a table's
nodes. Those here are isotropic, with three angles: turning both directions about the normal changes nothing. Those of
`anisotropic` have four.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError, UnknownNameError
from ...formula import Scalar, Vec, abs, dot, length, sqrt, where
from ...geometry.warps import HALF_PI, Angle

Array = NDArray[np.floating[Any]]

_DEGENERATE = 2e-7
"""Length of a projected direction below which its azimuth is rounding noise (of float32 with fused products)."""

_MIRROR = np.array([1.0, -1.0, 1.0])


@dataclass(frozen=True)
class Basis:
    """Base of the bases; a subclass is a frozen dataclass and enters the registry by being defined."""

    kinds: ClassVar[dict[str, type[Basis]]] = {}
    axes: ClassVar[tuple[str, ...]]

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        Basis.kinds[cls.__name__] = cls

    @property
    def isotropic(self) -> bool:
        """Whether turning both directions about the normal leaves the angles as they are."""
        return len(self.axes) == 3

    @property
    def extents(self) -> tuple[float, ...]:
        """The largest angle on each axis [rad]."""
        raise NotImplementedError

    def angles(self, wi: Vec, wo: Vec) -> tuple[Angle, ...]:
        """The formula: the angles of two directions."""
        raise NotImplementedError

    def directions(self, *angles: Array) -> tuple[Array, Array]:
        """(wi, wo), each (..., 3), of angles [rad] that broadcast."""
        raise NotImplementedError

    def above_horizon(self, *angles: Array, margin: float) -> tuple[Array, ...]:
        """The nearest angles whose directions lie above the horizon by at least about `margin` [rad]."""
        raise NotImplementedError

    def horizon(self, first: Array, third: Array) -> Array:
        """The largest angle on the second of the three axes (the azimuth aside) above the horizon [rad]."""
        return np.full(np.broadcast_shapes(first.shape, third.shape), self.extents[-2])

    def jacobian(self, *angles: Array) -> Array:
        """d wi d wo over the angles' increments and, for an isotropic basis, that of the azimuth common to both."""
        raise NotImplementedError

    def images(self, wi: Array, wo: Array) -> list[tuple[Array, Array]]:
        """The pairs that this basis does not tell from (wi, wo) by the symmetries it assumes, itself first."""
        raise NotImplementedError

    @property
    def state(self) -> dict[str, Any]:
        """What `basis_from` turns back into this basis; plain JSON values."""
        return {"kind": type(self).__name__, **asdict(self)}


def basis_from(state: Mapping[str, Any]) -> Basis:
    """The basis that `state` describes. Raises UnknownNameError, ParameterError, or TypeError for a wrong field."""
    fields = dict(state)
    kind = fields.pop("kind", None)
    if kind not in Basis.kinds:
        raise UnknownNameError("table basis", str(kind), Basis.kinds)
    return Basis.kinds[kind](**fields)


@dataclass(frozen=True)
class HalfBasis(Basis):
    """(theta_h, theta_d, phi_d): half vector against normal, light against half vector, azimuth of that difference.

    phi_d is folded: to half a turn, which assumes reciprocity alone (f at phi_d + pi is f with the directions
    exchanged); by "mirror", to half a turn, which assumes mirror symmetry alone (f at -phi_d), for measurements that
    are not reciprocal; or to a quarter turn, which assumes both. With h = wi + wo,

        cos phi_d = (wo.z - wi.z) / (2 sin theta_h sin theta_d),   sin phi_d ~ (h x wi).z / cos theta_d.

    Where theta_h or theta_d is 0, phi_d is not defined and taken as 0. Reference: Rusinkiewicz1998.
    """

    axes: ClassVar[tuple[str, ...]] = ("theta_h", "theta_d", "phi_d")

    fold: str = "half-turn"

    def __post_init__(self) -> None:
        if self.fold not in ("half-turn", "mirror", "quarter-turn"):
            raise ParameterError(f"fold must be 'half-turn', 'mirror' or 'quarter-turn', got {self.fold!r}")

    @property
    def extents(self) -> tuple[float, ...]:
        return HALF_PI, HALF_PI, HALF_PI if self.fold == "quarter-turn" else math.pi

    def angles(self, wi: Vec, wo: Vec) -> tuple[Angle, ...]:
        h, d = wi + wo, wi - wo
        h_length = length(h)
        theta_h = Angle(sqrt(h.x * h.x + h.y * h.y) / h_length, h.z / h_length)
        theta_d = Angle(0.5 * length(d), 0.5 * h_length)
        sine = (wi.y * wo.x - wi.x * wo.y) / theta_d.cosine
        cosine = wo.z - wi.z
        if self.fold == "half-turn":
            cosine = where(sine < 0.0, -cosine, cosine)
        elif self.fold == "quarter-turn":
            cosine = abs(cosine)
        return theta_h, theta_d, azimuth(abs(sine), cosine)

    def directions(self, *angles: Array) -> tuple[Array, Array]:
        theta_h, theta_d, phi_d = np.broadcast_arrays(*angles)
        across = np.sin(theta_d) * np.cos(phi_d)
        h = np.cos(theta_d)[..., None] * np.stack([np.sin(theta_h), 0 * theta_h, np.cos(theta_h)], -1)
        d = np.stack([across * np.cos(theta_h), np.sin(theta_d) * np.sin(phi_d), -across * np.sin(theta_h)], -1)
        return h + d, h - d

    def above_horizon(self, *angles: Array, margin: float) -> tuple[Array, ...]:
        first, second, third = angles
        first = np.minimum(first, HALF_PI - 2 * margin)
        return first, np.minimum(second, self.horizon(first, third) - margin), third

    def horizon(self, first: Array, third: Array) -> Array:
        return np.asarray(np.arctan2(np.cos(first), np.sin(first) * np.abs(np.cos(third))))

    def jacobian(self, *angles: Array) -> Array:
        theta_h, theta_d, phi_d = angles
        return 4 * np.cos(theta_d) * np.sin(theta_d) * np.sin(theta_h) + 0 * phi_d

    def images(self, wi: Array, wo: Array) -> list[tuple[Array, Array]]:
        mirrored = [(wi * _MIRROR, wo * _MIRROR)] if self.fold != "half-turn" else []
        unswapped = [(wi, wo), *mirrored]
        return unswapped if self.fold == "mirror" else [*unswapped, *((b, a) for a, b in unswapped)]


@dataclass(frozen=True)
class NormalBasis(Basis):
    """(theta_i, theta_o, phi_delta): both polar angles and the azimuth between them, folded to half a turn.

    The fold assumes mirror symmetry; phi_delta = 0 is retroreflection, pi the mirror direction.
    """

    axes: ClassVar[tuple[str, ...]] = ("theta_i", "theta_o", "phi_delta")

    @property
    def extents(self) -> tuple[float, ...]:
        return HALF_PI, HALF_PI, math.pi

    def angles(self, wi: Vec, wo: Vec) -> tuple[Angle, ...]:
        theta_i = Angle(sqrt(wi.x * wi.x + wi.y * wi.y), wi.z)
        theta_o = Angle(sqrt(wo.x * wo.x + wo.y * wo.y), wo.z)
        return theta_i, theta_o, azimuth(abs(wi.x * wo.y - wi.y * wo.x), wi.x * wo.x + wi.y * wo.y)

    def directions(self, *angles: Array) -> tuple[Array, Array]:
        theta_i, theta_o, phi = np.broadcast_arrays(*angles)
        wi = np.stack([np.sin(theta_i), 0 * theta_i, np.cos(theta_i)], -1)
        wo = np.stack([np.sin(theta_o) * np.cos(phi), np.sin(theta_o) * np.sin(phi), np.cos(theta_o)], -1)
        return wi, wo

    def above_horizon(self, *angles: Array, margin: float) -> tuple[Array, ...]:
        first, second, third = angles
        return np.minimum(first, HALF_PI - margin), np.minimum(second, HALF_PI - margin), third

    def jacobian(self, *angles: Array) -> Array:
        theta_i, theta_o, phi = angles
        return np.sin(theta_i) * np.sin(theta_o) + 0 * phi

    def images(self, wi: Array, wo: Array) -> list[tuple[Array, Array]]:
        return [(wi, wo), (wi * _MIRROR, wo * _MIRROR)]


def cos_difference(wi: Vec, wo: Vec) -> Scalar:
    """cos theta_d, the cosine of half the angle between the directions."""
    h = wi + wo
    return 0.5 * sqrt(dot(h, h))


def cos_difference_of(wi: Array, wo: Array) -> Array:
    """`cos_difference` of (..., 3) directions, (...)."""
    return 0.5 * np.asarray(np.linalg.norm(wi + wo, axis=-1))


def azimuth(sine: Scalar, cosine: Scalar) -> Angle:
    """The angle of a pair of any length; 0 where it has none."""
    norm = sqrt(sine * sine + cosine * cosine)
    defined = norm > _DEGENERATE
    scale = 1.0 / where(defined, norm, 1.0)
    return Angle(where(defined, sine * scale, 0.0), where(defined, cosine * scale, 1.0))
