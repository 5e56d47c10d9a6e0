"""Pictures that stand in for photographs of a sample, and the full BTF they are to be compared with."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import ParameterError, UnknownNameError
from ...geometry.arguments import as_directions
from ...geometry.directions import from_spherical
from ...reflectance import Reflectance
from ...representations.btf import BTF
from ..flat_sample.sample import FlatSample
from . import fabrics, solids  # noqa: F401  (they enter their materials)
from .registry import REGISTRY
from .surface import MicroSurface
from .tracer import Floats, Tracer

ELEVATIONS = (0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 87.0)
"""Angles of the lamp from the normal [degrees]: ten in steps of about 10 as in Kautz2004, the last short of 90."""
RINGS = {0.0: 1, 20.0: 6, 40.0: 8, 60.0: 10, 75.0: 12}
"""Directions of a BTF: angle from the normal [degrees] and how many around it."""
SUBTEXELS = 2
"""Texels across a pixel."""
MAX_SIZE = 4096
"""Pixels across a picture."""
UP = (0.0, 0.0, 1.0)


def names() -> list[str]:
    """The materials that `simulate` knows."""
    return sorted(REGISTRY)


def micro_surface(material: str, texels: int = 1024, seed: int = 0) -> MicroSurface:
    """The relief and the reflectances of a simulated material. Raises UnknownNameError, ParameterError."""
    if material not in REGISTRY:
        raise UnknownNameError("simulated material", material, REGISTRY)
    if seed < 0:
        raise ParameterError(f"a seed is a whole number from 0 on, got {seed}")
    return REGISTRY[material](texels, np.random.default_rng(seed))


def simulate(
    material: str | MicroSurface,
    elevations: Sequence[float] = ELEVATIONS,
    size: int = 512,
    brdf: Reflectance | None = None,
    *,
    azimuth: float = 0.0,
    bounce: bool = True,
    seed: int = 0,
    progress: Callable[[str], None] | None = None,
) -> FlatSample:
    """Pictures of a sample seen from above, one for each place of a distant lamp on an arc.

    `material`: a name of `names()` or a relief of its own; `elevations`: angles of the lamp from the normal [degrees],
    in [0, 90); `size`: pixels across; `brdf` replaces what the surface reflects, all over; `azimuth` of the arc
    [degrees] from the picture's right; `bounce`: with light that bounces once. Pixels are radiance under irradiance 1
    on a plane that faces the lamp [1/sr]: f cos of the sample where it has no relief. Pictures continue themselves on
    all sides. The same seed gives the same pictures. Reference: Kautz2004.

    Raises UnknownNameError, ParameterError.
    """
    angles = np.array(elevations, np.float64).reshape(-1)
    if not len(angles) or not ((angles >= 0) & (angles < 90)).all():
        raise ParameterError("elevations must be angles from the normal in [0, 90) degrees, at least one")
    tracer, texels = _tracer(material, size, brdf, bounce, seed)
    images = np.empty((len(angles), size, size, 3), np.float32)
    for number, wi in enumerate(from_spherical(np.radians(angles), np.full(len(angles), math.radians(azimuth)))):
        if progress is not None:
            progress(f"picture {number + 1} of {len(angles)}")
        images[number] = _averaged(tracer.radiance(tracer.light(wi), UP), texels, size)
    name = material if isinstance(material, str) else "sample"
    return FlatSample(images, angles, name, f"simulated, seed {seed}", scale_known=True)


def simulate_btf(
    material: str | MicroSurface,
    lights: ArrayLike | None = None,
    views: ArrayLike | None = None,
    size: int = 128,
    brdf: Reflectance | None = None,
    *,
    bounce: bool = True,
    seed: int = 0,
    progress: Callable[[str], None] | None = None,
) -> BTF:
    """The full BTF of a sample: as `simulate`, for every light (L, 3) and every distant view (V, 3).

    Views are rectified to the sample's mean plane, with the parallax and the masking of its relief. By default lights
    and views are those of `RINGS`; the images take 12 L V size² bytes. Reference: Dana1999. Raises UnknownNameError,
    ParameterError.
    """
    wi, wo = (_ring_directions() if w is None else as_directions("directions", w) for w in (lights, views))
    for w in (wi, wo):
        if w.ndim != 2 or not (w[:, 2] > 0).all():
            raise ParameterError("directions of a BTF must be (n, 3) and above the surface")
    tracer, texels = _tracer(material, size, brdf, bounce, seed)
    images = np.empty((len(wi), len(wo), size, size, 3), np.float32)
    shown = [tracer.seen(view) for view in wo]
    for number, direction in enumerate(wi):
        if progress is not None:
            progress(f"light {number + 1} of {len(wi)}")
        light = tracer.light(direction)
        for column, view in enumerate(wo):
            radiance = tracer.radiance(light, view, shown[column])
            images[number, column] = _averaged(radiance, texels, size) / direction[2]
    made = BTF(wi, wo, images)
    return made.named(material if isinstance(material, str) else "sample", f"simulated, seed {seed}")


def _tracer(
    material: str | MicroSurface, size: int, brdf: Reflectance | None, bounce: bool, seed: int
) -> tuple[Tracer, int]:
    """The tracer, and texels across a pixel."""
    if not 1 <= size <= MAX_SIZE:
        raise ParameterError(f"size must lie between 1 and {MAX_SIZE} pixels, got {size}")
    surface = micro_surface(material, size * SUBTEXELS, seed) if isinstance(material, str) else material
    if surface.size % size:
        raise ParameterError(f"size must divide the {surface.size} texels of the relief, got {size}")
    if brdf is not None:
        surface = surface.covered_by(brdf)
    return Tracer(surface, bounce, seed), surface.size // size


def _averaged(radiance: Floats, texels: int, size: int) -> Floats:
    """(N, 3) of texels -> (size, size, 3) of pixels."""
    return np.asarray(radiance.reshape(size, texels, size, texels, 3).mean((1, 3)))


def _ring_directions() -> NDArray[np.floating[Any]]:
    theta = np.concatenate([np.full(count, angle) for angle, count in RINGS.items()])
    phi = np.concatenate([np.arange(count) * 360 / count for count in RINGS.values()])
    return from_spherical(np.radians(theta), np.radians(phi))
