"""A mesh as shaders read it: its triangles as a list, and a tree of boxes around them for shadows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import SceneError
from . import tree_kernels as kernels
from .mesh import Mesh

Floats = NDArray[np.float32]

MOST_FACES = 5_000_000
"""That fit a texture of common cards, six texels each, and whose numbers single precision holds."""

MARGIN = 1e-6
"""By which boxes are larger than their triangles, relative to the mesh's largest coordinate: above rounding."""


@dataclass(frozen=True)
class MeshTexels:
    """Lists of texels of four numbers for the shader stages of a mesh."""

    faces: Floats
    """(6 F, 4): for each triangle its three corners, each with u, then the normals there, each with v."""
    nodes: Floats
    """(2 N, 4): for each box (least corner, first triangle of a leaf or -1), (greatest corner, number of triangles of
    a leaf, or the node that follows its subtree), in depth-first order; none casts no shadows"""


def texels(mesh: Mesh, shadows: bool = True) -> MeshTexels:
    """The lists of a mesh; without `shadows` there are no nodes. Raises SceneError for more than MOST_FACES."""
    if len(mesh.faces) > MOST_FACES:
        raise SceneError(
            f"the mesh {mesh.name} has {len(mesh.faces):,} triangles; graphics cards take up to {MOST_FACES:,}"
        )
    corners = mesh.vertices[mesh.faces]
    order, nodes = _tree(corners, mesh) if shadows else (np.arange(len(corners)), np.zeros((0, 4), np.float32))
    faces = np.zeros((len(corners), 6, 4), np.float32)
    faces[:, :3, :3], faces[:, 3:, :3] = corners[order], mesh.normals[order]
    if mesh.uvs is not None:
        faces[:, :3, 3], faces[:, 3:, 3] = mesh.uvs[order, :, 0], mesh.uvs[order, :, 1]
    return MeshTexels(faces.reshape(-1, 4), nodes)


def _tree(corners: Floats, mesh: Mesh) -> tuple[NDArray[np.int64], Floats]:
    """The triangles in the order of the leaves, and the nodes."""
    margin = MARGIN * float(np.abs(mesh.bounds).max())
    least, greatest = corners.min(1) - np.float64(margin), corners.max(1) + np.float64(margin)
    order = np.arange(len(corners))
    nodes = np.empty((2 * len(corners), 8))
    made = kernels.build(least, greatest, order, nodes)
    return order, nodes[:made].astype(np.float32).reshape(-1, 4)
