"""What a ray meets first, and whether anything stands between a point and a light.

Meshes are traced by embree; the unit sphere is intersected in closed form and needs nothing.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ..errors import SceneError
from . import surface_kernels as kernels
from .compiled import in_parallel
from .mesh import Mesh

Floats = NDArray[np.float32]


@dataclass(frozen=True)
class ShadingPoints:
    """Where rays meet the surface: N of the rays, in their order."""

    rays: NDArray[np.int64]
    """(N,) which rays"""
    points: Floats
    """(N, 3) world positions from which light is sought"""
    frames: Floats
    """(N, 3, 3) local axes as rows: tangent, bitangent, normal; right-handed, the normal on the viewer's side"""
    views: Floats
    """(N, 3) unit directions to the viewer in the local frame, z > 0"""
    uvs: Floats
    """(N, 2) texture coordinates"""

    @staticmethod
    def empty(rays: NDArray[np.int64]) -> ShadingPoints:
        """Room for what `rays` meet."""
        count = len(rays)
        shapes: list[tuple[int, ...]] = [(count, 3), (count, 3, 3), (count, 3), (count, 2)]
        return ShadingPoints(rays, *(np.empty(shape, np.float32) for shape in shapes))

    def to_local(self, world: Floats) -> Floats:
        """World directions (N, 3) in the local frames."""
        local = np.empty_like(world)
        in_parallel(kernels.to_local, len(world), self.frames, world, local)
        return local

    def to_world(self, local: Floats, part: NDArray[np.int64]) -> Floats:
        """Rows `part` of the local directions (N, 3) as world directions (len(part), 3)."""
        world = np.empty((len(part), 3), np.float32)
        in_parallel(kernels.to_world, len(part), self.frames, part, local, world)
        return world

    def __getitem__(self, part: Any) -> ShadingPoints:
        return ShadingPoints(self.rays[part], self.points[part], self.frames[part], self.views[part], self.uvs[part])


class Surface(Protocol):
    """Something rays can meet."""

    def meet(self, origins: Floats, directions: Floats) -> ShadingPoints:
        """First hits of rays (N, 3) with unit directions."""
        ...

    def blocks(self, points: Floats, directions: Floats, distances: Floats) -> NDArray[np.bool_]:
        """(N,) whether the surface stands between shading points and what lies `distances` away from them."""
        ...


class UnitSphere:
    """The exact unit sphere about the origin. It casts no shadow on itself above any point's horizon."""

    def meet(self, origins: Floats, directions: Floats) -> ShadingPoints:
        distances = np.empty(len(origins), np.float32)
        in_parallel(kernels.sphere_distances, len(origins), origins, directions, distances)
        found = ShadingPoints.empty(np.flatnonzero(distances > 0))
        in_parallel(
            kernels.sphere_surface, len(found.rays), found.rays, distances, origins, directions, found.points,
            found.frames, found.views, found.uvs,
        )  # fmt: skip
        return found

    def blocks(self, points: Floats, directions: Floats, distances: Floats) -> NDArray[np.bool_]:
        below: NDArray[np.bool_] = np.einsum("ij,ij->i", points, directions) < 0
        return below


class Triangles:
    """A mesh in an embree scene. Raises SceneError where embree is not installed."""

    def __init__(self, mesh: Mesh) -> None:
        try:
            from embreex.mesh_construction import TriangleMesh
            from embreex.rtcore_scene import EmbreeScene
        except ImportError:
            raise SceneError(
                f"rendering the mesh {mesh.name} needs embreex, which is not installed here; "
                "pip install embreex, or render the sphere, which needs nothing"
            ) from None
        self._corners = np.ascontiguousarray(mesh.vertices[mesh.faces])
        self._mesh = mesh
        self._nudge = mesh.nudge
        self._scene = EmbreeScene()
        TriangleMesh(self._scene, mesh.vertices, mesh.faces)
        above = mesh.bounds[1] + 1
        self._scene.run(above[None], np.array([[0, 1, 0]], np.float32))  # the first ray builds the tree, on one thread

    def faces(self, origins: Floats, directions: Floats) -> tuple[NDArray[np.int32], Floats]:
        """(N,) faces that rays meet first, -1 for none, and (2, N) weights of their second and third corner there."""
        count = len(origins)
        face = np.empty(count, np.int32)
        weights = np.empty((2, count), np.float32)

        def trace(start: int, stop: int) -> None:
            met = self._scene.run(origins[start:stop], directions[start:stop], output=1)
            face[start:stop] = met["primID"]
            weights[:, start:stop] = met["u"], met["v"]

        in_parallel(trace, count)
        return face, weights

    def meet(self, origins: Floats, directions: Floats) -> ShadingPoints:
        face, weights = self.faces(origins, directions)
        found = ShadingPoints.empty(np.flatnonzero(face >= 0))
        uvs = self._mesh.uvs if self._mesh.uvs is not None else np.zeros((1, 3, 2), np.float32)
        in_parallel(
            kernels.triangle_surface, len(found.rays), found.rays, face, weights[0], weights[1], directions,
            self._corners, self._mesh.normals, uvs, self._mesh.uvs is not None, self._nudge,
            found.points, found.frames, found.views, found.uvs,
        )  # fmt: skip
        return found

    def blocks(self, points: Floats, directions: Floats, distances: Floats) -> NDArray[np.bool_]:
        blocked = np.empty(len(points), np.bool_)

        def trace(start: int, stop: int) -> None:
            reach = np.maximum(distances[start:stop] - 2 * self._nudge, np.float32(0))
            met = self._scene.run(points[start:stop], directions[start:stop], reach, "OCCLUDED")
            blocked[start:stop] = met == 0

        in_parallel(trace, len(points))
        return blocked


def surface_of(mesh: Mesh) -> Surface:
    """What to trace for a mesh."""
    return UnitSphere() if mesh.is_unit_sphere else Triangles(mesh)
