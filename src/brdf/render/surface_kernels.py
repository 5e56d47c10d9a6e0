"""Compiled loops from camera rays to shading points: position, local frame, direction to the viewer."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .compiled import helper, kernel

ONE = np.float32(1)
ZERO = np.float32(0)
GRAZING = np.float32(0.01)
"""Least cosine between shading normal and viewing direction: interpolated normals bend away beyond the horizon."""


@kernel("void(i8, i8, f8[:,::1], f8[:,::1], f8, f8, f8, b1, i4[::1], i8, i4, f4[:,::1], f4[:,::1], f4[:,::1])")
def camera_rays(
    start: int, stop: int, frame: Any, position: Any, half_height: Any, width: Any, height: Any, parallel: Any,
    pixels: Any, per_side: Any, picture_width: Any, offsets: Any, origins: Any, directions: Any,
) -> None:  # fmt: skip
    """Rays of `pixels[n // k]`, k = per_side², through `offsets` (k, 2) within the pixel.

    `position` (1, 3); `half_height`: tangent of half the field of view, or half the height where `parallel`.
    """
    each = per_side * per_side
    for n in range(start, stop):
        pixel, k = pixels[n // each], n % each
        x = (2 * (pixel % picture_width + offsets[k, 0]) - width) / height * half_height
        y = (height - 2 * (pixel // picture_width + offsets[k, 1])) / height * half_height
        norm = 1 / math.sqrt(x * x + y * y + 1)
        for c in range(3):
            across = x * frame[0, c] + y * frame[1, c]
            if parallel:
                origins[n, c] = position[0, c] + across
                directions[n, c] = -frame[2, c]
            else:
                origins[n, c] = position[0, c]
                directions[n, c] = (across - frame[2, c]) * norm


@helper
def _dot(a: Any, b: Any) -> Any:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@helper
def _normalised(a: Any) -> Any:
    length = math.sqrt(_dot(a, a))
    scale = ONE / length if length > ZERO else ZERO
    return (a[0] * scale, a[1] * scale, a[2] * scale)


@helper
def _cross(a: Any, b: Any) -> Any:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@helper
def _orthogonal(a: Any, n: Any) -> Any:
    d = _dot(a, n)
    return (a[0] - d * n[0], a[1] - d * n[1], a[2] - d * n[2])


@helper
def _write_frame(frame: Any, view: Any, ray: Any, normal: Any, tangent: Any) -> None:
    """Local axes as rows of `frame`, and the viewing direction in them; `tangent` need not be orthogonal yet."""
    to_viewer = (-ray[0], -ray[1], -ray[2])
    slant = _dot(normal, to_viewer)
    if slant < GRAZING:
        lift = GRAZING - slant
        normal = _normalised((
            normal[0] + lift * to_viewer[0], normal[1] + lift * to_viewer[1], normal[2] + lift * to_viewer[2]
        ))  # fmt: skip
    tangent = _orthogonal(tangent, normal)
    if _dot(tangent, tangent) < np.float32(1e-6):
        # No usable texture coordinates: along the circles of latitude about +y, and about +x near the poles.
        tangent = (normal[2], ZERO, -normal[0])
        if _dot(tangent, tangent) < np.float32(1e-6):
            tangent = _orthogonal((ONE, ZERO, ZERO), normal)
    tangent = _normalised(tangent)
    bitangent = _cross(normal, tangent)
    for c in range(3):
        frame[0, c], frame[1, c], frame[2, c] = tangent[c], bitangent[c], normal[c]
    local = (_dot(to_viewer, tangent), _dot(to_viewer, bitangent), _dot(to_viewer, normal))
    local = _normalised((local[0], local[1], max(local[2], np.float32(1e-4))))
    view[0], view[1], view[2] = local[0], local[1], local[2]


@kernel(
    "void(i8, i8, i8[::1], i4[::1], f4[::1], f4[::1], f4[:,::1], f4[:,:,::1], f4[:,:,::1], f4[:,:,::1], b1, f4,"
    " f4[:,::1], f4[:,:,::1], f4[:,::1], f4[:,::1])"
)
def triangle_surface(
    start: int, stop: int, hit: Any, face: Any, weight_1: Any, weight_2: Any, rays: Any, positions: Any, normals: Any,
    uvs: Any, has_uvs: Any, nudge: Any, points: Any, frames: Any, views: Any, texture: Any,
) -> None:  # fmt: skip
    """Shading points of the rays `hit` on faces with corner `positions`, `normals` and `uvs` (F, 3, 2 or 3).

    `points` lie on the smooth surface that the normals describe, not in the face: on it no facet shadows its
    neighbour [Hanika2021]. They stand off by `nudge` towards the viewer.
    """
    for n in range(start, stop):
        ray_number = hit[n]
        f, b1, b2 = face[ray_number], weight_1[ray_number], weight_2[ray_number]
        b0 = ONE - b1 - b2
        ray = (rays[ray_number, 0], rays[ray_number, 1], rays[ray_number, 2])
        p, q = positions[f], normals[f]
        edge_1 = (p[1, 0] - p[0, 0], p[1, 1] - p[0, 1], p[1, 2] - p[0, 2])
        edge_2 = (p[2, 0] - p[0, 0], p[2, 1] - p[0, 1], p[2, 2] - p[0, 2])
        flat = _normalised(_cross(edge_1, edge_2))
        smooth = _normalised((
            b0 * q[0, 0] + b1 * q[1, 0] + b2 * q[2, 0],
            b0 * q[0, 1] + b1 * q[1, 1] + b2 * q[2, 1],
            b0 * q[0, 2] + b1 * q[1, 2] + b2 * q[2, 2],
        ))  # fmt: skip
        if _dot(smooth, smooth) < np.float32(0.5):
            smooth = flat
        if _dot(flat, smooth) < ZERO:
            flat = (-flat[0], -flat[1], -flat[2])
        side = ONE if _dot(flat, ray) < ZERO else -ONE  # faces have the same material on both sides
        at = (
            b0 * p[0, 0] + b1 * p[1, 0] + b2 * p[2, 0],
            b0 * p[0, 1] + b1 * p[1, 1] + b2 * p[2, 1],
            b0 * p[0, 2] + b1 * p[1, 2] + b2 * p[2, 2],
        )
        x, y, z = at
        for corner in range(3):
            b = b0 if corner == 0 else (b1 if corner == 1 else b2)
            normal = (q[corner, 0] * side, q[corner, 1] * side, q[corner, 2] * side)
            below = _dot((at[0] - p[corner, 0], at[1] - p[corner, 1], at[2] - p[corner, 2]), normal)
            if below < ZERO:
                x -= b * below * normal[0]
                y -= b * below * normal[1]
                z -= b * below * normal[2]
        points[n, 0] = x + nudge * side * flat[0]
        points[n, 1] = y + nudge * side * flat[1]
        points[n, 2] = z + nudge * side * flat[2]
        tangent = (ZERO, ZERO, ZERO)
        texture[n, 0], texture[n, 1] = ZERO, ZERO
        if has_uvs:
            t = uvs[f]
            texture[n, 0] = b0 * t[0, 0] + b1 * t[1, 0] + b2 * t[2, 0]
            texture[n, 1] = b0 * t[0, 1] + b1 * t[1, 1] + b2 * t[2, 1]
            u1, v1, u2, v2 = t[1, 0] - t[0, 0], t[1, 1] - t[0, 1], t[2, 0] - t[0, 0], t[2, 1] - t[0, 1]
            turn = ONE if u1 * v2 - u2 * v1 >= ZERO else -ONE
            tangent = _normalised((
                turn * (v2 * edge_1[0] - v1 * edge_2[0]),
                turn * (v2 * edge_1[1] - v1 * edge_2[1]),
                turn * (v2 * edge_1[2] - v1 * edge_2[2]),
            ))  # fmt: skip
        _write_frame(frames[n], views[n], ray, (smooth[0] * side, smooth[1] * side, smooth[2] * side), tangent)


@kernel("void(i8, i8, f4[:,::1], f4[:,::1], f4[::1])")
def sphere_distances(start: int, stop: int, origins: Any, rays: Any, distances: Any) -> None:
    """Distance along unit rays to the unit sphere from outside it; negative where it is missed."""
    for n in range(start, stop):
        b, c = 0.0, -1.0
        for k in range(3):
            b += np.float64(origins[n, k]) * rays[n, k]
            c += np.float64(origins[n, k]) * origins[n, k]
        # The squared distance of the ray from the centre decides; b*b - c would cancel far away.
        closest = 0.0
        for k in range(3):
            offset = origins[n, k] - b * rays[n, k]
            closest += offset * offset
        reach = -b - math.sqrt(max(1 - closest, 0.0))
        distances[n] = reach if closest <= 1 and reach > 0 else -1.0


@kernel("void(i8, i8, i8[::1], f4[::1], f4[:,::1], f4[:,::1], f4[:,::1], f4[:,:,::1], f4[:,::1], f4[:,::1])")
def sphere_surface(
    start: int, stop: int, hit: Any, distances: Any, origins: Any, rays: Any, points: Any, frames: Any, views: Any,
    texture: Any,
) -> None:  # fmt: skip
    """Shading points on the unit sphere."""
    for n in range(start, stop):
        m = hit[n]
        ray = (rays[m, 0], rays[m, 1], rays[m, 2])
        d = distances[m]
        normal = _normalised((origins[m, 0] + d * ray[0], origins[m, 1] + d * ray[1], origins[m, 2] + d * ray[2]))
        for c in range(3):
            points[n, c] = normal[c]
        texture[n, 0] = (math.atan2(normal[0], normal[2]) / (2 * math.pi)) % 1.0
        texture[n, 1] = 1 - math.acos(min(max(normal[1], -ONE), ONE)) / math.pi
        _write_frame(frames[n], views[n], ray, normal, (ZERO, ZERO, ZERO))


@kernel("void(i8, i8, f4[:,:,::1], f4[:,::1], f4[:,::1])")
def to_local(start: int, stop: int, frames: Any, world: Any, local: Any) -> None:
    """World directions in the frames' axes, normalised anew."""
    for n in range(start, stop):
        v = (world[n, 0], world[n, 1], world[n, 2])
        a = _normalised((_dot(frames[n, 0], v), _dot(frames[n, 1], v), _dot(frames[n, 2], v)))
        local[n, 0], local[n, 1], local[n, 2] = a[0], a[1], a[2]


@kernel("void(i8, i8, f4[:,:,::1], i8[::1], f4[:,::1], f4[:,::1])")
def to_world(start: int, stop: int, frames: Any, part: Any, local: Any, world: Any) -> None:
    """Rows `part` of the directions in the frames' axes as world directions, normalised anew."""
    for n in range(start, stop):
        m = part[n]
        f, x, y, z = frames[m], local[m, 0], local[m, 1], local[m, 2]
        a = _normalised((
            x * f[0, 0] + y * f[1, 0] + z * f[2, 0],
            x * f[0, 1] + y * f[1, 1] + z * f[2, 1],
            x * f[0, 2] + y * f[1, 2] + z * f[2, 2],
        ))  # fmt: skip
        world[n, 0], world[n, 1], world[n, 2] = a[0], a[1], a[2]


@kernel("void(i8, i8, f4[:,::1], f4[:,::1], f4[::1], f4[:,::1])")
def weighed(start: int, stop: int, value: Any, light: Any, factor: Any, product: Any) -> None:
    """value (N, 3) · light (N, 3) · factor (N,); 0 where that is not finite, so that no pixel ever is."""
    for n in range(start, stop):
        for c in range(3):
            x = value[n, c] * light[n, c] * factor[n]
            product[n, c] = x if abs(x) < np.float32(1e30) else ZERO


@kernel("void(i8, i8, i8[::1], f4[:,::1], b1[::1], f4[:,::1])")
def add_rows(start: int, stop: int, part: Any, value: Any, wanted: Any, total: Any) -> None:
    """total[part[n]] += value[n] for the wanted n."""
    for n in range(start, stop):
        if wanted[n]:
            for c in range(3):
                total[part[n], c] += value[n, c]
