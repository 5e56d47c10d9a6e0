"""Shapes to show a material on: by name, or from any mesh file trimesh reads.

World frame: right-handed, +y up, +x to the right and +z towards the viewer of the default camera's front.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import inputs
from ..errors import CorruptFileError, FileError, SceneError, UnknownNameError
from . import teapot

Floats = NDArray[np.float32]

CREASE = 75.0
"""Degrees between two faces above which the edge between them stays sharp, where a file gives no normals."""

TRUNCATED = "it is truncated or damaged; write it anew."


@dataclass(frozen=True)
class Mesh:
    """Triangles with normals and, where there are any, texture coordinates at their corners."""

    name: str
    vertices: Floats
    """(V, 3) positions"""
    faces: NDArray[np.int32]
    """(F, 3) counter-clockwise seen from outside"""
    normals: Floats
    """(F, 3, 3) unit normals at the corners"""
    uvs: Floats | None = None
    """(F, 3, 2) texture coordinates at the corners"""
    is_unit_sphere: bool = False
    """Whether it stands for the exact unit sphere, which is then intersected in closed form."""

    @property
    def bounds(self) -> Floats:
        """(2, 3): the least and the greatest corner of the box around it."""
        return np.stack([self.vertices.min(0), self.vertices.max(0)])

    @property
    def size(self) -> float:
        """The diagonal of that box."""
        return float(np.linalg.norm(self.bounds[1] - self.bounds[0]))

    @property
    def nudge(self) -> np.float32:
        """By how much rays start off the surface: well above the rounding of float32 positions."""
        return np.float32(1e-4 * self.size + 4e-7 * float(np.abs(self.bounds).max()))


def load(mesh: str | os.PathLike[str] | Mesh) -> Mesh:
    """A mesh by name ("teapot", "sphere", "plane"), from a file (.ply, .obj, .glb, .stl …), or as it is.

    Raises UnknownNameError, FileError, CorruptFileError, or SceneError for a file without faces.
    """
    if isinstance(mesh, Mesh):
        return mesh
    if str(mesh) in BUILT_IN:
        return BUILT_IN[str(mesh)]()
    path = Path(mesh)
    if not path.exists():
        if isinstance(mesh, str) and not path.suffix and path.parent == Path():
            raise UnknownNameError("mesh", mesh, BUILT_IN)
        names = ", ".join(BUILT_IN)
        raise FileError(mesh, f"no such mesh file; give a mesh file or one of {names}.")
    return _read(path)


def _read(path: Path) -> Mesh:
    import trimesh

    inputs.note(path)
    if path.is_dir():
        raise FileError(path, "is a folder; give a mesh file.")
    if path.suffix.lower() == ".stl":
        _require_whole_stl(path)
    try:
        loaded = trimesh.load(path, process=False)
        found: Any = loaded.to_geometry() if isinstance(loaded, trimesh.Scene) else loaded
    except (Exception, MemoryError) as error:  # each of trimesh's readers raises what it likes
        known = path.suffix.lower().lstrip(".") in trimesh.available_formats()
        if known:
            problem = f"cannot be read as a mesh ({_first_line(error)}); is it truncated or damaged? Write it anew."
        else:
            problem = "is of no known mesh format; .ply, .obj, .glb and .stl can be read."
        raise CorruptFileError(path, problem) from None
    _require_whole_ply(path, found.metadata.get("_ply_raw", {}))
    faces = getattr(found, "faces", None)
    if faces is None or len(faces) == 0:
        raise SceneError(f"{path}: has no faces (a point cloud, or cut off?), so there is nothing to render.")
    vertices = np.asarray(found.vertices, np.float64)
    faces = np.asarray(faces)
    if faces.min() < 0 or faces.max() >= len(vertices) or not np.isfinite(vertices[faces]).all():
        raise CorruptFileError(path, "its faces name vertices that do not exist or are not finite.")
    corners = vertices[faces]
    faces = _once(faces[_face_vectors(corners).any(-1)])
    if len(faces) == 0:
        raise SceneError(f"{path}: all its faces have an area of zero.")
    normals = None
    if "vertex_normals" in found._cache:  # that is where trimesh puts the normals a file brings along
        normals = np.asarray(found.vertex_normals)[faces]
    uv = getattr(found.visual, "uv", None)
    uvs = None if uv is None or len(uv) != len(vertices) else np.asarray(uv)[faces]
    return _made(path.name, vertices, faces, normals, uvs)


def _require_whole_stl(path: Path) -> None:
    """trimesh takes a binary file of another length than it says for text, and passes over what no `endsolid` ends.

    Raises FileError, CorruptFileError.
    """
    try:
        content = path.read_bytes()
    except OSError as error:
        raise FileError(path, f"cannot be read ({error.strerror}).") from None
    triangles = int.from_bytes(content[80:84], "little")
    if len(content) != 84 + 50 * triangles and b"endsolid" not in content[-1024:].lower():
        raise CorruptFileError(path, f"ends too early: {TRUNCATED}")


def _require_whole_ply(path: Path, elements: Mapping[str, Mapping[str, Any]]) -> None:
    """trimesh makes do with fewer lines than the header promises. Raises CorruptFileError."""
    for name, element in elements.items():
        data = element.get("data", ())
        rows = len(next(iter(data.values()), ())) if isinstance(data, dict) else len(data)
        if rows < element["length"]:
            raise CorruptFileError(path, f"has {rows} of {element['length']} elements {name!r}: {TRUNCATED}")


def _once(faces: Any) -> Any:
    """Of faces (F, 3) with the same corners the first alone: which of them is seen would be left to chance."""
    _, first = np.unique(np.sort(faces, 1), axis=0, return_index=True)
    return faces[np.sort(first)]


def _first_line(error: BaseException) -> str:
    return str(error).split("\n")[0][:120] or type(error).__name__


def _made(name: str, vertices: Any, faces: Any, normals: Any, uvs: Any) -> Mesh:
    """Drop unused vertices, complete the normals, convert to the types the kernels take."""
    used, flat = np.unique(faces, return_inverse=True)
    vertices, faces = vertices[used], flat.reshape(-1, 3)
    if normals is None:
        smooth = corner_normals(vertices, faces)
    else:
        length = np.linalg.norm(normals, axis=-1, keepdims=True)
        usable = np.isfinite(length) & (length > 1e-6)
        smooth = normals / np.where(usable, length, 1)
        if not usable.all():
            smooth = np.where(usable, smooth, corner_normals(vertices, faces))
    if uvs is not None and not np.isfinite(uvs).all():
        uvs = None
    return Mesh(
        name,
        np.ascontiguousarray(vertices, np.float32),
        np.ascontiguousarray(faces, np.int32),
        np.ascontiguousarray(smooth, np.float32),
        None if uvs is None else np.ascontiguousarray(uvs, np.float32),
    )


def _face_vectors(corners: Any) -> Any:
    """(F, 3, 3) -> (F, 3) normals as long as twice the area."""
    return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])


def corner_normals(vertices: Any, faces: Any, crease: float = CREASE) -> Any:
    """(F, 3, 3) normals: of the faces around a position, those within `crease` degrees, weighted by area.

    Vertices at the same position count as one, so that seams of texture coordinates and triangle soups stay smooth.
    """
    from .mesh_kernels import averaged

    face = _face_vectors(vertices[faces]).astype(np.float64)
    keys = np.ascontiguousarray(vertices + 0.0).view(np.dtype((np.void, 3 * vertices.itemsize)))  # + 0: no -0
    _, position = np.unique(keys.ravel(), return_inverse=True)
    position = position.reshape(-1)[faces].ravel()
    order = np.argsort(position, kind="stable")
    starts = np.concatenate([[0], np.cumsum(np.bincount(position))])
    normals = np.empty((len(position), 3))
    averaged(face, order, starts, np.cos(np.radians(crease)), normals)
    return normals.reshape(-1, 3, 3)


def _teapot() -> Mesh:
    made = teapot.tessellated()
    faces = made["faces"]
    return _made("teapot", made["vertices"], faces, made["normals"][faces], made["uvs"][faces])


def _sphere() -> Mesh:
    """The unit sphere. The triangles serve to frame it and for other renderers; here it is intersected exactly."""
    rows, columns = 48, 96
    theta, phi = np.meshgrid(np.linspace(0, np.pi, rows + 1), np.linspace(0, 2 * np.pi, columns + 1), indexing="ij")
    vertices = np.stack([np.sin(theta) * np.sin(phi), np.cos(theta), np.sin(theta) * np.cos(phi)], -1).reshape(-1, 3)
    uv = np.stack([phi / (2 * np.pi), 1 - theta / np.pi], -1).reshape(-1, 2)
    i, j = (a.ravel() for a in np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij"))
    corner = i * (columns + 1) + j
    below = corner + columns + 1
    upper = np.stack([corner, below, corner + 1], -1)[i > 0]
    lower = np.stack([corner + 1, below, below + 1], -1)[i < rows - 1]
    faces = np.concatenate([upper, lower])
    made = _made("sphere", vertices, faces, vertices[faces], uv[faces])
    return Mesh(made.name, made.vertices, made.faces, made.normals, made.uvs, is_unit_sphere=True)


def _plane() -> Mesh:
    """The square |x|, |z| <= 1 at y = 0, facing up; texture coordinate u runs to +x, v to -z."""
    vertices = np.array([(-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1)], float)
    faces = np.array([(0, 1, 2), (0, 2, 3)])
    uv = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], float)
    return _made("plane", vertices, faces, np.broadcast_to((0.0, 1.0, 0.0), (2, 3, 3)), uv[faces])


BUILT_IN: dict[str, Callable[[], Mesh]] = {"teapot": _teapot, "sphere": _sphere, "plane": _plane}
