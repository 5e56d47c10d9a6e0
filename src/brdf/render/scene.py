"""What is seen and from where: the camera, and the scene that the renderer takes."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import SceneError
from .lights import Light, direction

if TYPE_CHECKING:
    from .environment import Environment
    from .mesh import Mesh

Floats = NDArray[np.float64]

UP = (0.0, 1.0, 0.0)


def _triple(name: str, value: ArrayLike) -> Floats:
    array = np.asarray(value, np.float64)
    if array.shape != (3,) or not np.isfinite(array).all():
        raise SceneError(f"{name} of the camera must be three finite numbers, got {value!r}")
    return array


@dataclass(frozen=True)
class Camera:
    """A pinhole camera, or an orthographic one where `height` is given instead of `fov`.

    `position`, `target`: world points. `fov`: vertical field of view in degrees, in (0, 180). `height`: how much of the
    world the picture is high (orthographic: all rays are parallel). Raises SceneError for what makes no picture.
    """

    position: Any
    target: Any = (0.0, 0.0, 0.0)
    up: Any = UP
    fov: float = 30.0
    height: float | None = None
    frame: Floats = field(init=False, repr=False, compare=False)
    """(3, 3) rows: to the right, up, backwards (from target to position)"""

    def __post_init__(self) -> None:
        position, target, up = (_triple(name, getattr(self, name)) for name in ("position", "target", "up"))
        backwards = position - target
        right = np.cross(up, backwards)
        if np.linalg.norm(right) <= 1e-9 * np.linalg.norm(up) * np.linalg.norm(backwards):
            raise SceneError("the camera must not stand at its target, nor look along its up direction")
        if not 0 < self.fov < 180:
            raise SceneError(f"fov of the camera must lie between 0 and 180 degrees, got {self.fov:g}")
        if self.height is not None and not 0 < self.height < np.inf:
            raise SceneError(f"height of the orthographic camera must be a positive number, got {self.height:g}")
        backwards /= np.linalg.norm(backwards)
        right /= np.linalg.norm(right)
        object.__setattr__(self, "position", position)
        object.__setattr__(self, "target", target)
        object.__setattr__(self, "frame", np.stack([right, np.cross(backwards, right), backwards]))

    @staticmethod
    def framing(
        mesh: Mesh, theta: float = 68.0, phi: float = 20.0, fov: float = 30.0, aspect: float = 4 / 3,
        orthographic: bool = False, margin: float = 1.1,
    ) -> Camera:  # fmt: skip
        """The camera that sees the whole of `mesh`, centred, `margin` times as large as needed.

        It looks from the direction `theta` degrees from +y and `phi` degrees from +z towards +x; `aspect` is the
        picture's width over its height.
        """
        middle = mesh.bounds.astype(np.float64).mean(0)
        frame = Camera(middle + direction(theta, phi), middle, fov=fov).frame
        seen = (mesh.vertices - middle) @ frame.T
        tangent = np.tan(np.radians(fov / 2))
        slopes = np.array([tangent * aspect, tangent]) / margin
        if orthographic:
            least, most = seen[:, :2].min(0), seen[:, :2].max(0)
            middle = middle + (least + most) / 2 @ frame[:2]
            height = float(np.max((most - least) / (aspect, 1))) * margin
            return Camera(middle + frame[2] * 2 * mesh.size, middle, fov=fov, height=height)
        shift, distance = np.zeros(2), 0.0
        for _ in range(8):  # centring moves what touches the picture's edge; this settles in a few rounds
            distance = float(np.max(np.abs(seen[:, :2] - shift) / slopes + seen[:, 2:]))
            projected = (seen[:, :2] - shift) / (distance - seen[:, 2:])
            shift = shift + (projected.min(0) + projected.max(0)) / 2 * distance
        distance = float(np.max(np.abs(seen[:, :2] - shift) / slopes + seen[:, 2:]))
        middle = middle + shift @ frame[:2]
        return Camera(middle + frame[2] * distance, middle, fov=fov)

    def project(self, points: ArrayLike, width: int, height: int) -> Floats:
        """World points (N, 3) -> (N, 2) pixel coordinates (x to the right, y down); NaN for what lies behind."""
        seen = (np.asarray(points, np.float64) - self.position) @ self.frame.T
        if self.height is None:
            depth = np.where(seen[:, 2] < 0, -seen[:, 2], np.nan)[:, None]
            plane = seen[:, :2] / depth / np.tan(np.radians(self.fov / 2))
        else:
            plane = seen[:, :2] / (self.height / 2)
        pixels: Floats = plane * (1, -1) * (height / 2) + (width / 2, height / 2)
        return pixels


@dataclass(frozen=True)
class Scene:
    """One shape, what lights it, and who looks."""

    mesh: Mesh
    camera: Camera
    lights: tuple[Light, ...] = ()
    environment: Environment | None = None

    def __post_init__(self) -> None:
        if not self.lights and self.environment is None:
            raise SceneError("there is no light; give lights or an environment")
