"""Figures 1, 5 and 7: the materials on a mesh."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ....metrics import psnr_of
from ....render import render
from ....render.progress import Progress
from ....representations.shading.compression import rms
from ...pictures import developed
from ...report import Panel, Report
from .samples import Sample, named, slices_of, sun
from .settings import DIFFUSE, PHONG, SHOWN, Settings

AMBIENT = 0.04
"""Radiance from everywhere, for a map of albedo 1."""

FABRICS = ("jeans", "suede", "nylon", "cloth", "wool")


def bunny(report: Report, settings: Settings, samples: Sequence[Sample]) -> None:
    """Figure 1."""
    sample = named(samples, SHOWN)
    width, height = settings.picture
    h = sample.under_phong()
    image = render(h, env="studio", lights=sun(h), size=(2 * width, 2 * height),
                   background="environment", progress=False)  # fmt: skip
    report.figure(
        "figure-1",
        f"Figure 1. The shipped teapot, which stands for the paper's bunny, with simulated {sample.name}, in a studio "
        "and one lamp.",
        Panel(image.developed()),
    )


def materials(report: Report, settings: Settings, samples: Sequence[Sample]) -> None:
    """Figure 7."""
    rows: dict[str, list[Panel]] = {"fabrics": [], "others": []}
    with Progress("figure 7", len(samples), None) as bar:
        for sample in samples:
            h = sample.under_phong()
            image = render(h, lights=sun(h), env=AMBIENT / (math.pi * h.stack.highest), size=settings.picture,
                           background="transparent", samples=4, progress=False)  # fmt: skip
            highlight, exponent = PHONG[sample.name]
            row = rows["fabrics" if sample.name in FABRICS else "others"]
            row.append(Panel(image.developed(), f"{sample.name}; {highlight:g}, N = {exponent:g}"))
            bar.step()
    report.figure(
        "figure-7",
        "Figure 7. The simulated materials under the modified Phong model, in a lamp that makes each as bright as the "
        f"others, and a little light from everywhere. Albedo of the diffuser {DIFFUSE:g}; below each the albedo of the "
        "highlight and its exponent N.",
        {title: row for title, row in rows.items() if row},
    )


def compressed(report: Report, settings: Settings, samples: Sequence[Sample]) -> None:
    """Figure 5."""
    sample = named(samples, SHOWN)
    h = sample.even
    slices = slices_of(h)
    forms = {
        f"{len(slices.nodes) + 1} pictures": h,
        "the paper's power fit, 6 bytes a texel": h.compress(method="power-brute-force"),
        "principal components, 6 bytes a texel": h.compress(),
        "principal components, 3 bytes a texel": h.compress(3),
    }
    levels = [slices.nodes[k] for k in (len(slices.nodes) - 1, len(slices.nodes) // 2, 0)]
    rows, truth = {}, None
    for name, form in forms.items():
        image = render(sample.under_phong(form), lights=sun(h), size=settings.picture, background="transparent",
                       progress=False)  # fmt: skip
        assert image.alpha is not None
        truth = truth or image
        on = image.alpha > 0
        label = "" if form is h else f"{psnr_of(truth.pixels[on], image.pixels[on]):.1f} dB"
        pictures = [Panel(developed((form.picture(r) / r * levels[0] / sample.white).clip(0, 1)), f"r = {r:.3f}")
                    for r in levels]  # fmt: skip
        title = name if form is h else f"{name}; RMS {rms(form.stack, slices):.4f} of white"
        rows[title] = [Panel(image.developed(), label), *pictures]
    report.figure(
        "figure-5",
        f"Figure 5. {sample.name.capitalize()}, as it was and compressed: on the teapot, and the flat sample at three "
        "levels, each exposed to the same average.",
        rows,
    )
