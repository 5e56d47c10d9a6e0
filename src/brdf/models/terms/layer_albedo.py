"""Directional albedos of the lobes that layers are made of, tabulated over all their parameters.

A formula that looks them up follows its parameters wherever it runs: in a fit, in a shader, under a slider.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...formula import Scalar, Vec, dot, maximum, normalize, sqrt
from ...geometry.directions import from_spherical
from ...geometry.quadrature import half_vector_rule
from ..sheen import charlie
from .albedo import LOWEST
from .fresnel import dielectric
from .ggx import ggx_lobe
from .ndf.projected_area import node_coordinate

COSINES, ROUGHNESSES, ROOTS = 32, 32, 17
"""Nodes over the root of the cosine, the root of alpha and the root of F0."""
NARROWEST = 1e-3
"""Least alpha."""
LARGEST_ROOT = 0.5
"""That of the index 3."""

FUZZ_COSINES, FUZZ_ROUGHNESSES = 64, 16
LEAST_FUZZ = 0.1


def dielectric_coordinates(cosine: Scalar, alpha: Scalar, root: Scalar) -> tuple[Scalar, Scalar, Scalar]:
    """Where `dielectric_albedo` holds a direction, a width and the root of F0."""
    least = NARROWEST**0.5
    return (
        node_coordinate(sqrt(maximum(cosine, 0.0)), COSINES),
        node_coordinate((sqrt(alpha) - least) / (1.0 - least), ROUGHNESSES),
        node_coordinate(root * (1.0 / LARGEST_ROOT), ROOTS),
    )


def fuzz_coordinates(cosine: Scalar, roughness: Scalar) -> tuple[Scalar, Scalar]:
    """Where `fuzz_albedo` holds a direction and a roughness."""
    return (
        node_coordinate(sqrt(maximum(cosine, 0.0)), FUZZ_COSINES),
        node_coordinate((roughness - LEAST_FUZZ) / (1.0 - LEAST_FUZZ), FUZZ_ROUGHNESSES),
    )


@cache
def dielectric_albedo() -> NDArray[np.float32]:
    """E of the GGX lobe with exact Fresnel reflectance and no colour, (32, 32, 17, 1), to half precision."""
    widths = np.linspace(NARROWEST**0.5, 1, ROUGHNESSES) ** 2
    root = np.linspace(0, LARGEST_ROOT, ROOTS)
    eta = (1 + root) / (1 - root)
    rows = []
    for wi, wo, weight in _hemispheres(COSINES):
        cosine = dot(wi, normalize(wi + wo))
        lobes = np.stack([ggx_lobe(wi, wo, alpha, alpha) * weight for alpha in widths.tolist()])
        rows.append(lobes @ np.stack([dielectric(cosine, index) for index in eta.tolist()]).T)
    return _packed(np.stack(rows))


@cache
def fuzz_albedo() -> NDArray[np.float32]:
    """E of the white fuzz lobe, (64, 16, 1), to half precision."""
    roughness = np.linspace(LEAST_FUZZ, 1, FUZZ_ROUGHNESSES).tolist()
    return _packed(
        np.stack([[np.sum(charlie(wi, wo, r) * w) for r in roughness] for wi, wo, w in _hemispheres(FUZZ_COSINES)])
    )


def _hemispheres(cosines: int) -> list[tuple[Vec, Vec, Any]]:
    """For each node of the viewer's cosine: wi on one side of the plane of incidence, wo, cos(theta_i) d wi."""
    found = []
    for cosine in np.maximum(np.linspace(0, 1, cosines) ** 2, LOWEST):
        wo = from_spherical(np.arccos(cosine), 0.0)
        rule = half_vector_rule(wo, 64, 48)
        one_side = rule.directions[:, 1] > 0  # the other is its mirror image
        wi, weight = rule.directions[one_side], 2 * rule.weights[one_side]
        found.append((Vec(*wi.T), Vec(*wo), wi[:, 2] * weight))
    return found


def _packed(table: NDArray[Any]) -> NDArray[np.float32]:
    return table.clip(0, 1).astype(np.float16).astype(np.float32)[..., None]
