"""Newell's teapot: 32 bicubic Bézier patches, tessellated with the patches' own normals.

The control points are the published ones [Newell1975], in the form in which the teapot is usually handed on: with the
bottom added later [Crow1987] and the height scaled down by 4/3. Most of them follow from symmetry, so only what
does not is written here: six profiles that are turned about the axis, and the half of handle and spout with y <= 0.
Here z is up; `tessellated` turns the pot to y up, spout to +x.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

PROFILES = {
    # (radius, radius times the circle constant 0.56 as published, height) of the four rings of control points
    "rim": [(1.4, 0.784, 2.4), (1.3375, 0.749, 2.53125), (1.4375, 0.805, 2.53125), (1.5, 0.84, 2.4)],
    "upper body": [(1.5, 0.84, 2.4), (1.75, 0.98, 1.875), (2.0, 1.12, 1.35), (2.0, 1.12, 0.9)],
    "lower body": [(2.0, 1.12, 0.9), (2.0, 1.12, 0.45), (1.5, 0.84, 0.225), (1.5, 0.84, 0.15)],
    "knob": [(0.0, 0.0, 3.15), (0.8, 0.45, 3.15), (0.0, 0.0, 2.85), (0.2, 0.112, 2.7)],
    "lid": [(0.2, 0.112, 2.7), (0.4, 0.224, 2.55), (1.3, 0.728, 2.55), (1.3, 0.728, 2.4)],
    "bottom": [(1.5, 0.84, 0.15), (1.5, 0.84, 0.075), (1.425, 0.798, 0.0), (0.0, 0.0, 0.0)],
}

HALVES = {
    # per ring of control points: (x, z) at y = 0, width, (x, z) at y = 0 on the other side; the two middle points
    # of a ring lie straight beside its ends, at y = -width
    "upper handle": [
        ((-1.6, 2.025), 0.3, (-1.5, 2.25)),
        ((-2.3, 2.025), 0.3, (-2.5, 2.25)),
        ((-2.7, 2.025), 0.3, (-3.0, 2.25)),
        ((-2.7, 1.8), 0.3, (-3.0, 1.8)),
    ],
    "lower handle": [
        ((-2.7, 1.8), 0.3, (-3.0, 1.8)),
        ((-2.7, 1.575), 0.3, (-3.0, 1.35)),
        ((-2.5, 1.125), 0.3, (-2.65, 0.9375)),
        ((-2.0, 0.9), 0.3, (-1.9, 0.6)),
    ],
    "lower spout": [
        ((1.7, 1.425), 0.66, (1.7, 0.6)),
        ((2.6, 1.425), 0.66, (3.1, 0.825)),
        ((2.3, 2.1), 0.25, (2.4, 2.025)),
        ((2.7, 2.4), 0.25, (3.3, 2.4)),
    ],
    "upper spout": [
        ((2.7, 2.4), 0.25, (3.3, 2.4)),
        ((2.8, 2.475), 0.25, (3.525, 2.49375)),
        ((2.9, 2.475), 0.15, (3.45, 2.5125)),
        ((2.8, 2.4), 0.15, (3.2, 2.4)),
    ],
}


def patches() -> Floats:
    """Control points, (32, 4, 4, 3): index 1 runs along the profile or tube, index 2 around it; z is up."""
    made = []
    for profile in PROFILES.values():
        for turn in range(4):
            cos, sin = ((1, 0), (0, 1), (-1, 0), (0, -1))[turn]
            quarter = [[(0, r, z), (k, r, z), (r, k, z), (r, 0, z)] for r, k, z in profile]
            rotation = np.array([[cos, sin, 0], [-sin, cos, 0], [0, 0, 1]], float)
            made.append(np.array(quarter, float) @ rotation)
    for rings in HALVES.values():
        half = np.array([
            [(xa, 0, za), (xa, -width, za), (xb, -width, zb), (xb, 0, zb)] for (xa, za), width, (xb, zb) in rings
        ])  # fmt: skip
        made += [half, half[:, ::-1] * (1, -1, 1)]
    return np.array(made)


def bernstein(t: Floats) -> tuple[Floats, Floats]:
    """The four cubic Bernstein polynomials and their derivatives at `t` (N,): two (N, 4) arrays."""
    s = 1 - t
    value = np.stack([s**3, 3 * s**2 * t, 3 * s * t**2, t**3], -1)
    slope = np.stack([-3 * s**2, 3 * s**2 - 6 * s * t, 6 * s * t - 3 * t**2, 3 * t**2], -1)
    return value, slope


def tessellated(divisions: int = 20) -> dict[str, NDArray[Any]]:
    """Positions (V, 3), outward normals (V, 3), uvs (V, 2) and faces (F, 3): `divisions`² squares a patch, y up.

    Where a row of control points falls together (the tip of the knob, the middle of the bottom) the derivative along
    it vanishes, and its rate of change into the patch takes its place: the limit of the normal.
    """
    t = np.linspace(0, 1, divisions + 1)
    value, slope = bernstein(t)
    control = patches()
    position = np.einsum("ik,jl,pklc->pijc", value, value, control)
    along = np.einsum("ik,jl,pklc->pijc", slope, value, control)
    around = np.einsum("ik,jl,pklc->pijc", value, slope, control)
    mixed = np.einsum("ik,jl,pklc->pijc", slope, slope, control)
    inward = np.where(t < 0.5, 1.0, -1.0)[None, :, None, None]
    collapsed = np.linalg.norm(around, axis=-1, keepdims=True) < 1e-9
    normal = np.cross(np.where(collapsed, inward * mixed, around), along)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)

    i, j = np.meshgrid(np.arange(divisions), np.arange(divisions), indexing="ij")
    corner = (i * (divisions + 1) + j).ravel()
    below, beside = corner + divisions + 1, corner + 1
    square = np.concatenate([np.stack([corner, beside, below], -1), np.stack([beside, below + 1, below], -1)])
    faces = (np.arange(len(control))[:, None, None] * (divisions + 1) ** 2 + square).reshape(-1, 3)
    uv = np.broadcast_to(np.stack(np.meshgrid(t, t, indexing="ij")[::-1], -1), (*position.shape[:3], 2))
    vertices = position.reshape(-1, 3)
    corners = vertices[faces]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=-1)
    return {
        "vertices": vertices[:, [0, 2, 1]] * (1, 1, -1),
        "normals": normal.reshape(-1, 3)[:, [0, 2, 1]] * (1, 1, -1),
        "uvs": uv.reshape(-1, 2),
        "faces": faces[area > 1e-12],
    }
