"""Figures 3 and 4: the pictures themselves, and what is blended from two of them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ....color import luminance, srgb_encode
from ....loading import load
from ....metrics import psnr_of
from ....reflectance import Reflectance
from ....representations.spheres.bake import sphere_pictures
from ....representations.spheres.sphere_images import SphereImages
from ....representations.spheres.view import fixed_view, sphere_normals
from ...pictures import developed, error_picture
from ...pictures import disc as coverage
from ...report import Column, Panel, Report
from .settings import FIT, METAL, PLASTIC, Settings

Array = NDArray[np.floating[Any]]

COLOUR_SHIFTING = ("color-changing-paint1", "color-changing-paint2", "color-changing-paint3")

PHI = 60.0
"""The light of figure 4 [degrees], between the pictures at 45 and 90."""

SHOWN = "yellow-plastic"
GLOSSY = "Lambertian:albedo=.5 + GGX:alpha=.1,F0=.04"
MATTE = "Lambertian:albedo=1"

HIGHEST_ERROR = 0.2
"""sRGB difference at which the colours of the error pictures end."""

PROMINENCE = 0.02
"""A highlight counts when it stands out of its surroundings by this share of the brightest value."""


def textures(report: Report, settings: Settings) -> None:
    """Figure 3."""
    rows: dict[str, list[Panel]] = {}
    for name, angles in ((SHOWN, PLASTIC), *((name, METAL) for name in COLOUR_SHIFTING)):
        images = SphereImages.bake(load(f"{name}@{FIT}"), angles, settings.picture).images
        seen = coverage(settings.picture)
        rows[name] = [
            Panel(developed(image, seen), f"φ = {angle:g}°") for image, angle in zip(images, angles, strict=True)
        ]
    report.figure(
        "figure-3",
        "Figure 3. What is stored: a sphere seen from afar, lit at φ from the viewer. First row: yellow plastic. The "
        "others: three paints whose colour shifts (the paper's second row shows one such material, unnamed).",
        rows,
    )


class Blended(NamedTuple):
    """A material in the light of figure 4: the truth, and what is blended from the same four pictures."""

    m: Reflectance
    truth: Array
    """(size, size, 3) radiance of a sphere; black where it is not lit, and around it"""
    ways: Mapping[str, SphereImages]
    pictures: Mapping[str, Array]
    """the same as `truth` in each way, in the paper's own form"""

    @staticmethod
    def of(m: Reflectance, settings: Settings) -> Blended:
        ways = blends(m, settings)
        light = math.sin(math.radians(PHI)), 0.0, math.cos(math.radians(PHI))
        pictures = {way: fixed_view(made, sphere_normals(settings.picture), light) for way, made in ways.items()}
        return Blended(m, sphere_pictures(m, [PHI], settings.picture, dilate=False)[0], ways, pictures)


def blends(m: Reflectance, settings: Settings) -> dict[str, SphereImages]:
    """The ways of figure 4 to blend the same four pictures."""
    dark, dilated = (SphereImages.bake(m, PLASTIC, settings.largest, dilate=d) for d in (False, True))
    literal: dict[str, Any] = {"guard": False, "mask": False}
    return {
        "a) full angles, Eq. 2": dark.with_blend("full", **literal),
        "b) half angles": dark.with_blend("half", **literal),
        "c) Eq. 4": dark.with_blend("paper", **literal),
        "d) Eq. 4, normals not shortened": dark.with_blend("paper", shorten=1.0, **literal),
        "ours: monotone k": dilated.with_blend("monotone"),
        "ours: diffuse light separated": dilated.with_blend("separated"),
    }


def blending(report: Report, settings: Settings) -> Mapping[str, Mapping[str, float]]:
    """Figure 4, and the same in numbers, which it returns by way and column."""
    plastic, glossy, matte = (Blended.of(load(text), settings) for text in (f"{SHOWN}@{FIT}", GLOSSY, MATTE))
    seen = coverage(settings.picture)
    shown, wrong = {}, {}
    for name, given in ((SHOWN, plastic), ("a glossier plastic (GGX, alpha 0.1)", glossy)):
        pictures = {"the truth": given.truth, **given.pictures}
        shown[name] = [Panel(developed(picture, seen), way) for way, picture in pictures.items()]
        wrong[name] = [
            Panel(error_picture(_difference(picture, given.truth), HIGHEST_ERROR, seen), way)
            for way, picture in given.pictures.items()
        ]
    report.figure(
        "figure-4",
        f"Figure 4. Spheres lit at {PHI:g}°, blended from the pictures at 45° and 90°. The paper's caption gives the "
        "second turn as 55°; it is 30°.",
        shown,
    )
    report.figure("figure-4-errors", "How far each is from the truth: the largest difference of the channels.", wrong)
    return _numbers(report, plastic, glossy, matte)


def _difference(picture: Array, truth: Array) -> Array:
    return np.asarray(np.abs(srgb_encode(picture) - srgb_encode(truth)).max(-1))


def _numbers(report: Report, plastic: Blended, glossy: Blended, matte: Blended) -> Mapping[str, Mapping[str, float]]:
    lit = matte.truth[..., 0] > 0
    found = {}
    for way in plastic.ways:
        error = matte.pictures[way][lit] - matte.truth[lit]
        found[way] = {
            "psnr": psnr_of(plastic.truth[lit], plastic.pictures[way][lit]),
            "highlights": _highlights(glossy.ways[way]),
            "matte RMSE": float(np.sqrt(np.mean(error**2))),
            "matte worst": float(np.abs(error).max()),
        }
    report.table(
        "figure-4",
        "Figure 4 in numbers",
        [
            "way",
            Column(f"{SHOWN}, PSNR", "dB", ".1f", "ours"),
            Column("highlights of a glossy plastic", "1", "d", "ours"),
            Column("white diffuser, RMSE", "1", ".4f", "ours"),
            Column("white diffuser, largest error", "1", ".3f", "ours"),
        ],
        [[way, *numbers.values()] for way, numbers in found.items()],
        f"Lit at {PHI:g}°, lit pixels of the sphere. Highlights: maxima of the luminance along the equator that stand "
        f"out by {PROMINENCE:.0%} of the brightest, for a diffuser of albedo 0.5 under a GGX lobe, alpha 0.1, F0 0.04, "
        f"which has {_highlights(glossy.m)}. The diffuser has albedo 1, so that its radiance is cos θ.",
    )
    return found


def _highlights(m: Reflectance) -> int:
    """How many maxima the luminance has along the equator."""
    from scipy.signal import find_peaks

    x = np.linspace(-1, 1, 4001)[1:-1]
    azimuth, phi = np.arcsin(x), math.radians(PHI)
    wi = np.stack([np.sin(phi - azimuth), np.zeros_like(x), np.cos(phi - azimuth)], -1)
    wo = np.stack([np.sin(-azimuth), np.zeros_like(x), np.cos(azimuth)], -1)
    row = luminance(m.f_cos(wi, wo))
    return len(find_peaks(row, prominence=PROMINENCE * float(row.max()))[0])
