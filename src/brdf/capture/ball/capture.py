"""`brdf.capture.sphere`: a folder of photographs of a ball -> sphere images and slice stack."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...errors import ParameterError
from ...metrics import psnr_of
from ...reflectance import Reflectance
from ...representations.baking.slice_stack import SliceStack
from ...representations.spheres.bake import disc
from ...representations.spheres.pictures import checked_angles
from ...representations.spheres.sphere_images import SphereImages
from ...representations.tables.table import Table
from .analytic_fit import fit_ggx_lambert
from .assembly import as_published, assemble
from .captured import Captured
from .coverage import coverage_of
from .hold_out import Methods, hold_out, left_out
from .photographs import BallPhotographs, Samples, visible_weight
from .reading import read_ball
from .stack_fit import fit_stack

DEFAULT_ALBEDO = 0.5
"""Diffuse albedo that the ball is taken to have where nothing sets the scale."""
POOR = 28.0
"""PSNR [dB] below which a warning is due: real balls reach 35 and more, one read with a wrong response 25.5."""
SIZES = (64, 512)
"""Texels across a sphere image by default: the ball's diameter in pixels within these."""

STACK, MONOTONE, PAPER, ANALYTIC = "slice stack", "sphere images", "paper's Eq. 4", "GGX + Lambert"
"""What the held-out check compares."""


class _Built(NamedTuple):
    images: SphereImages
    stack: Table
    analytic: Reflectance
    photographed: list[bool]
    samples: Samples


def sphere(
    folder: str | os.PathLike[str],
    *,
    lights: str | os.PathLike[str] | None = None,
    intensities: str | os.PathLike[str] | None = None,
    mask: str | os.PathLike[str] | None = None,
    dark: str | os.PathLike[str] | None = None,
    response: str | float | None = None,
    albedo: float | None = None,
    white: float | None = None,
    size: int | None = None,
    angles: Sequence[float] | None = None,
    budget: str = "16K",
    holdout: int | None = None,
    progress: Callable[[str], None] | None = None,
) -> Captured:
    """A material from photographs of a ball by a fixed camera, one light each.

    `folder` holds the photographs (PNG, TIFF, EXR, TGA, JPEG; ordered by `filenames.txt` or by name) and
    `light_directions.txt` or `lights.txt`: a line x y z a photograph, x right, y up, z to the camera; perhaps
    `light_intensities.txt` (r g b), a mask `*mask*` that is white on the ball, a dark frame `*dark*`. The other
    arguments name such files elsewhere. `response`: "linear", "srgb" or a gamma; by default linear for more than 8
    bits, for 8 the one of linear and sRGB that suits the photographs. Without a mask the ball is found on dark ground.

    Photographs have no absolute scale. `white` sets it: the number, as a share of the largest and linear, that a white
    diffuser facing the light shows; else `albedo`, the ball's diffuse albedo (its luminance), by default 0.5.

    `size`: texels across a sphere image; `angles` [degrees] of the sphere images, by default chosen from the lights;
    `budget` of the slice stack; `holdout` k leaves every k-th photograph out and predicts it; `progress` is told what
    is being done. Raises FileError, CorruptFileError, ParameterError, UnknownNameError: see `docs/capture-sphere.md`.
    """
    tell = progress or (lambda text: None)
    for name, value in (("albedo", albedo), ("white", white)):
        if value is not None and not 0 < value <= 1:
            raise ParameterError(f"{name} must lie in (0, 1], got {value:g}")
    if albedo is not None and white is not None:
        raise ParameterError("white and albedo both set the scale; give one of them")
    if angles is not None:
        checked_angles(angles)
    if size is not None:
        disc(size)
    layout = SliceStack.layouts(budget)[0]
    given = {"lights": lights, "intensities": intensities, "mask": mask, "dark": dark}
    paths = {name: None if path is None else Path(path) for name, path in given.items()}
    photographs, warnings, facts = read_ball(Path(folder), response=response, progress=tell, **paths)
    if holdout is not None:
        left_out(len(photographs), holdout)
    scale, said = ball_scale(photographs, albedo, white)
    photographs = photographs.scaled(scale)
    texels = size or int(np.clip(32 * math.ceil(photographs.ball.radius / 16), *SIZES))

    def build(which: BallPhotographs) -> _Built:
        samples = which.samples()
        tell("fitting GGX + Lambert")
        weight = visible_weight(samples.radiance, samples.wi)
        rough = fit_ggx_lambert(samples.wi, samples.wo, samples.values, weight)
        # weights from noisy radiance favour what noise made dark; those from the first fit do not
        weight = visible_weight(math.pi * rough.f_cos(samples.wi, samples.wo), samples.wi)
        analytic = fit_ggx_lambert(samples.wi, samples.wo, samples.values, weight)
        tell("fitting the slice stack")
        stack = fit_stack(which, analytic, layout)
        tell("putting the sphere images together")
        images, photographed = assemble(which, stack, texels, angles)
        return _Built(images, stack, analytic, photographed, samples)

    def methods(which: BallPhotographs) -> Methods:
        built = build(which)
        paper = as_published(which, texels)
        return {STACK: built.stack, MONOTONE: built.images, PAPER: paper, ANALYTIC: built.analytic}

    rows = () if holdout is None else hold_out(photographs, holdout, methods)
    built = build(photographs)
    agreement = _agreement(photographs, built.stack)
    facts.append(f"the slice stack repeats the photographs to {agreement:.1f} dB")
    if agreement < POOR:
        warnings.append(
            f"no isotropic material fits the photographs (to {agreement:.1f} dB only): check the directions and the "
            "order of the lights, and the camera's response (--response linear, srgb or a gamma)"
        )
    name = Path(folder).resolve().name
    source = f"photographs of a ball ({len(photographs)} lights)"
    return Captured(
        images=built.images.named(name, source),
        stack=built.stack.named(name, source),
        analytic=built.analytic,
        coverage=coverage_of(built.samples.wi, built.samples.wo),
        ball=photographs.ball,
        photographed=tuple(built.photographed),
        scale=scale,
        facts=(*facts, said),
        warnings=tuple(warnings),
        holdout=rows,
    )


def _agreement(photographs: BallPhotographs, m: Reflectance) -> float:
    """The mean PSNR [dB] between the photographs and the material's own pictures."""
    found = []
    for number in range(len(photographs)):
        wi, wo, _, radiance = photographs.pixels(number)
        if len(wi):
            found.append(min(psnr_of(radiance, math.pi * m.f_cos(wi, wo)), 100.0))
    return float(np.mean(found))


def ball_scale(photographs: BallPhotographs, albedo: float | None, white: float | None) -> tuple[float, str]:
    """What to multiply the photographs with, and a sentence about it."""
    if white is not None:
        return 1 / white, f"scale: {white:g} of the largest number is a white diffuser facing the light"
    level = photographs.diffuse_level()
    if not level > 0:
        raise ParameterError("the ball is black where the lights should fall on it; check the lights' directions")
    wanted = DEFAULT_ALBEDO if albedo is None else albedo
    assumed = "assumed; photographs have no absolute scale" if albedo is None else "as given"
    return wanted / level, f"scale: diffuse albedo {wanted:g} ({assumed})"
