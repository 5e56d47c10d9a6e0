"""Photographs of a ball as samples to fit a model to."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

from ...fit import GRAZING, Samples
from .capture import ball_scale
from .reading import read_ball


def sphere_samples(
    folder: str | os.PathLike[str],
    *,
    response: str | float | None = None,
    albedo: float | None = None,
    grazing: float = GRAZING,
    progress: Callable[[str], None] | None = None,
) -> Samples:
    """The pixels of photographs of a ball, each of which counts the same, for `brdf.fit`.

    The folder and `response`, `albedo` are those of `sphere`. Raises as `sphere` does.
    """
    tell = progress or (lambda text: None)
    given = dict.fromkeys(("lights", "intensities", "mask", "dark"))
    photographs, _, _ = read_ball(Path(folder), response=response, progress=tell, **given)
    scale, _ = ball_scale(photographs, albedo, None)
    wi, wo, values, _ = photographs.scaled(scale).samples()
    source = f"photographs of a ball ({len(photographs)} lights)"
    return Samples.of(wi, wo, values, 1.0, grazing, Path(folder).resolve().name, source)
