"""Meshes as a page takes them: few bytes, from which the browser makes the texels that the shaders read."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..render.mesh import Mesh
from .blob import Blob

LEVELS = (1 << 16) - 1
"""Steps of a coordinate: a hundredth of a pixel of any screen."""


def described(mesh: Mesh, blob: Blob) -> dict[str, Any]:
    """A mesh's part of a page's description; its numbers go into the blob.

    Distinct corners are listed once: positions in `LEVELS` steps between `least` and `greatest`, unit normals folded
    onto an octahedron [Cigolle2014] in as many steps from -1 to 1, texture coordinates between `uv_least` and
    `uv_greatest`. `corners` are three of them a face.
    """
    about: dict[str, Any] = {"name": mesh.name, "kind": "sphere" if mesh.is_unit_sphere else "mesh"}
    if mesh.is_unit_sphere:
        return about
    least, greatest = mesh.bounds
    parts = [_steps(mesh.vertices[mesh.faces].reshape(-1, 3), least, greatest)]
    parts.append(_steps(octahedral(mesh.normals.reshape(-1, 3)), -np.ones(2), np.ones(2)))
    about |= {"faces": len(mesh.faces), "has_uv": mesh.uvs is not None, "nudge": float(mesh.nudge)}
    about |= {"least": least.tolist(), "greatest": greatest.tolist()}
    if mesh.uvs is not None:
        uvs = mesh.uvs.reshape(-1, 2)
        uv_least, uv_greatest = uvs.min(0), uvs.max(0)
        parts.append(_steps(uvs, uv_least, uv_greatest))
        about |= {"uv_least": uv_least.tolist(), "uv_greatest": uv_greatest.tolist()}
    listed, corners = _distinct(np.concatenate(parts, 1), mesh.faces.ravel())
    about["positions"] = blob.add_numbers(listed[:, :3], 16)
    about["normals"] = blob.add_numbers(listed[:, 3:5], 16)
    if mesh.uvs is not None:
        about["uvs"] = blob.add_numbers(listed[:, 5:], 16)
    about["corners"] = blob.add_numbers(corners.reshape(-1, 3), 32)
    return about


def octahedral(normals: NDArray[np.floating[Any]]) -> NDArray[np.float64]:
    """(N, 3) unit vectors -> (N, 2) in [-1, 1]: projected onto |x| + |y| + |z| = 1, the lower half folded outwards."""
    n = np.asarray(normals, np.float64)
    n = n / np.abs(n).sum(-1, keepdims=True)
    folded = (1 - np.abs(n[:, 1::-1])) * np.where(n[:, :2] >= 0, 1, -1)
    return np.asarray(np.where(n[:, 2:] < 0, folded, n[:, :2]))


def _steps(values: NDArray[Any], least: NDArray[Any], greatest: NDArray[Any]) -> NDArray[np.uint16]:
    extent = np.where(greatest > least, greatest.astype(np.float64) - least, 1)
    return np.asarray(np.rint((values.astype(np.float64) - least) / extent * LEVELS), np.uint16)


def _distinct(corners: NDArray[np.uint16], vertices: NDArray[np.int32]) -> tuple[NDArray[Any], NDArray[np.intp]]:
    """The distinct rows, in the order of the mesh's vertices, and which of them each corner is."""
    rows, first, which = np.unique(corners, axis=0, return_index=True, return_inverse=True)
    order = np.argsort(vertices[first], kind="stable")
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    return rows[order], place[which.ravel()]
