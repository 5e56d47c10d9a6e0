"""Section 4.1: r at the vertices against r at every pixel."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ....metrics import psnr_of
from ....render import Mesh, render, render_per_vertex
from ....render.mesh import corner_normals
from ....render.progress import Progress
from ....render.teapot import tessellated
from ...pictures import error_picture
from ...report import Column, Panel, Report
from .full_btf import HIGHEST_ERROR, difference
from .samples import Sample, named, sun, under_phong
from .settings import Settings
from .techniques import HIGHLIGHT

DIVISIONS = (2, 4, 8, 16)
"""Squares along a patch of the teapot."""
EXPONENTS = (5.0, 60.0)
MATERIAL = "plastic"


def present(report: Report, settings: Settings, samples: Sequence[Sample]) -> dict[tuple[float, int], float]:
    """The table and the figure; PSNR [dB] by exponent and divisions."""
    sample, found = named(samples, MATERIAL), {}
    rows: dict[str, list[Panel]] = {}
    with Progress("r at vertices", len(EXPONENTS) * len(DIVISIONS), None) as bar:
        for exponent in EXPONENTS:
            h = under_phong(sample.native, HIGHLIGHT, exponent)
            for divisions in DIVISIONS:
                mesh = teapot(divisions)
                truth = render(h, mesh, sun(h), size=settings.picture, background="transparent", progress=False)
                image = render_per_vertex(h, mesh, sun(h), size=settings.picture, background="transparent")
                assert truth.alpha is not None
                on = truth.alpha > 0
                found[exponent, divisions] = psnr_of(truth.pixels[on], image.pixels[on])
                if exponent == EXPONENTS[-1] and divisions in DIVISIONS[:: len(DIVISIONS) - 1]:
                    wrong = error_picture(difference(image, truth), HIGHEST_ERROR, truth.alpha)
                    rows[f"{len(mesh.faces)} triangles"] = [
                        Panel(truth.developed(), "r at every pixel"), Panel(image.developed(), "r at vertices"),
                        Panel(wrong, f"difference, {found[exponent, divisions]:.1f} dB"),
                    ]  # fmt: skip
                bar.step()
    report.figure(
        "vertices",
        f"r at the vertices, interpolated over each triangle, and r at every pixel ({sample.name}, N = "
        f"{EXPONENTS[-1]:g}). On a coarse mesh highlights fall between vertices or spread over whole triangles.",
        rows,
    )
    report.table(
        "vertices",
        "r at vertices against r at every pixel",
        ["triangles", *(Column(f"PSNR, N = {exponent:g}", "dB", ".1f", "ours") for exponent in EXPONENTS)],
        [
            [len(teapot(divisions).faces), *(found[exponent, divisions] for exponent in EXPONENTS)]
            for divisions in DIVISIONS
        ],
        f"Over the teapot, {settings.picture[0]} x {settings.picture[1]} pixels, on the same mesh.",
    )
    return found


def teapot(divisions: int) -> Mesh:
    """The shipped teapot with `divisions`² squares a patch."""
    made = tessellated(divisions)
    vertices, faces = made["vertices"].astype(np.float32), made["faces"].astype(np.int32)
    normals = made["normals"][faces].astype(np.float32)
    broken = ~np.isfinite(normals).all(-1)
    normals[broken] = corner_normals(vertices, faces)[broken]
    return Mesh(f"teapot of {divisions}", vertices, faces, normals, made["uvs"][faces].astype(np.float32))
