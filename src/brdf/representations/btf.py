"""Bidirectional texture function: images of a surface under many pairs of directions."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import ParameterError
from ..geometry.arguments import as_directions
from ..geometry.sampling import CosineSampler, MixtureSampler, Sampler, TabulatedSampler
from ..reflectance import Floats, Reflectance

COSINE_SHARE = 0.25
"""Share of draws from a cosine lobe, so that what only some places reflect is drawn everywhere."""


class BTF(Reflectance):
    """Images of a flat piece of a material for each of L lights and V views, interpolated in between.

        f(wi, wo, uv) = sum_l sum_v w_l(wi) w_v(wo) image_lv(uv)      [1/sr]

    w are barycentric weights in a Delaunay triangulation of the lights (of the views), projected onto the surface along
    its normal, so that a value linear in x and y of both directions is met exactly; outside the triangulation the
    nearest point of its rim counts. Images are filtered linearly and clamped at the edge; the first row is at the top,
    u runs to the right, v up. Not reciprocal unless the images are. Reference: Dana1999.
    """

    varies = True

    def __init__(self, lights: ArrayLike, views: ArrayLike, images: ArrayLike) -> None:
        """`lights` (L, 3) and `views` (V, 3): unit directions above the surface, at least three, not on one line;
        `images` (L, V, rows, columns, 3): f without the cosine [1/sr]. Raises ParameterError.
        """
        self.lights, self.views = _directions("lights", lights), _directions("views", views)
        try:
            self.images: NDArray[np.float32] = np.ascontiguousarray(images, np.float32)
        except (TypeError, ValueError):
            raise ParameterError("the images of a BTF must be an array of numbers") from None
        expected = (len(self.lights), len(self.views))
        if (
            self.images.ndim != 5
            or self.images.shape[:2] != expected
            or self.images.shape[-1] != 3
            or not self.images.size
        ):
            raise ParameterError(
                f"the images of a BTF must be ({expected[0]}, {expected[1]}, rows, columns, 3), got {self.images.shape}"
            )
        if not np.isfinite(self.images).all():
            raise ParameterError("the images of a BTF must be finite")
        self.name = "BTF"

    @property
    def has_formula(self) -> bool:
        return False

    @property
    def isotropic(self) -> bool:
        return False

    @property
    def textures(self) -> Mapping[str, NDArray[Any]]:
        return {"images": self.images}

    @cached_property
    def _meshes(self) -> tuple[_Mesh, _Mesh]:
        return _Mesh(self.lights), _Mesh(self.views)

    def _evaluate_places(self, wi: Floats, wo: Floats, uv: Floats, clamp: bool) -> Floats:
        value = np.zeros_like(wi)
        lit = np.flatnonzero((wi[:, 2] > 0) & (wo[:, 2] > 0))
        (light, light_weight), (view, view_weight) = (
            mesh.weights(w[lit].astype(np.float64)) for mesh, w in zip(self._meshes, (wi, wo), strict=True)
        )
        rows, columns = self.images.shape[2:4]
        place = np.stack([1 - uv[lit, 1], uv[lit, 0]], -1) * (rows, columns) - 0.5
        place = np.clip(place, 0, (rows - 1, columns - 1))
        low = place.astype(np.intp)
        high = np.minimum(low + 1, (rows - 1, columns - 1))
        part = place - low
        total = np.zeros((len(lit), 3))
        for top in (False, True):
            for left in (False, True):
                row, column = (low if top else high)[:, 0], (low if left else high)[:, 1]
                share = (1 - part[:, 0] if top else part[:, 0]) * (1 - part[:, 1] if left else part[:, 1])
                texels = self.images[light[:, :, None], view[:, None, :], row[:, None, None], column[:, None, None]]
                total += share[:, None] * np.einsum("nl,nv,nlvc->nc", light_weight, view_weight, texels)
        value[lit] = np.maximum(total, 0) if clamp else total
        return value

    def _make_sampler(self) -> Sampler:
        mean = BTF(self.lights, self.views, self.images.mean((2, 3), np.float64, keepdims=True))
        samplers: list[Sampler] = [TabulatedSampler(mean, isotropic=False), CosineSampler()]
        return MixtureSampler(samplers, [1 - COSINE_SHARE, COSINE_SHARE])

    def _state(self) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
        return {}, {"lights": self.lights, "views": self.views, "images": self.images}

    @classmethod
    def _restore(cls, header: Any, arrays: Mapping[str, NDArray[Any]], children: Any) -> Reflectance:
        return cls(arrays["lights"], arrays["views"], arrays["images"])


class _Mesh:
    """Triangulated directions (K, 3), projected onto the surface."""

    def __init__(self, directions: Floats) -> None:
        from scipy.spatial import ConvexHull, Delaunay, QhullError

        self._points = directions[:, :2].astype(np.float64)
        try:
            self._triangles = Delaunay(self._points)
            rim = ConvexHull(self._points).vertices
        except (QhullError, ValueError):
            raise ParameterError("the directions of a BTF must not lie on one line") from None
        self._rim = np.stack([rim, np.roll(rim, -1)], -1)

    def weights(self, w: Floats) -> tuple[NDArray[np.intp], Floats]:
        """(N, 3) directions -> (N, 3) indices and (N, 3) weights that sum to 1."""
        points = w[:, :2]
        found = self._triangles.find_simplex(points)
        transform = self._triangles.transform[found]
        two = np.einsum("nij,nj->ni", transform[:, :2], points - transform[:, 2])
        weight = np.concatenate([two, 1 - two.sum(-1, keepdims=True)], -1).clip(0)
        index = self._triangles.simplices[found].astype(np.intp)
        outside = np.flatnonzero(found < 0)
        if len(outside):
            index[outside], weight[outside] = self._on_rim(points[outside])
        return index, weight / weight.sum(-1, keepdims=True)

    def _on_rim(self, points: Floats) -> tuple[NDArray[np.intp], Floats]:
        """The nearest point of the rim, as weights of the two ends of its edge."""
        start, end = self._points[self._rim[:, 0]], self._points[self._rim[:, 1]]
        edge = end - start
        along = np.einsum("nei,ei->ne", points[:, None] - start, edge) / (edge * edge).sum(-1)
        along = along.clip(0, 1)
        distance = np.linalg.norm(points[:, None] - (start + along[..., None] * edge), axis=-1)
        nearest = distance.argmin(-1)
        t = along[np.arange(len(points)), nearest]
        ends = self._rim[nearest]
        index = np.concatenate([ends, ends[:, :1]], -1).astype(np.intp)
        return index, np.stack([1 - t, t, 0 * t], -1)


def _directions(name: str, given: ArrayLike) -> NDArray[np.float64]:
    array = as_directions(name, given).astype(np.float64)
    if array.ndim != 2 or len(array) < 3 or not np.allclose(np.linalg.norm(array, axis=-1), 1, atol=1e-3):
        raise ParameterError(f"the {name} of a BTF must be at least 3 unit vectors (n, 3), got shape {array.shape}")
    if not (array[:, 2] >= 0).all():
        raise ParameterError(f"the {name} of a BTF must lie above the surface")
    return array
