"""Figure 4: the shading map against a complete BTF, and against principal components of that."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....capture import simulate, simulate_btf
from ....color import luminance, srgb_encode
from ....geometry.directions import from_spherical
from ....metrics import psnr_of
from ....reflectance import Reflectance
from ....render import Directional, Image, render
from ....representations.btf import BTF
from ....representations.shading.planes import LEVELS, Planes
from ....representations.shading.principal import principal_components
from ....representations.shading.shading_map import ShadingMap
from ...charts import curves
from ...pictures import error_picture
from ...report import Cell, Column, Panel, Report
from .samples import Sample, relative, sun
from .settings import COMPARED, Settings

Floats = NDArray[np.floating[Any]]

COMPONENTS = 16
"""Of the paper's compressed BTF."""
HIGHEST_ERROR = 0.3
"""sRGB difference at which the colours of the error pictures end."""

FULL, PCA, TRUE_R, OWN, SMALL = (
    "full BTF", f"BTF, {COMPONENTS} components", "shading map, r the true average", "shading map, own average BRDF",
    "the same, 6 bytes a texel",
)  # fmt: skip


@dataclass(frozen=True)
class Found:
    """By method relative errors per pair (lights, views, 2): per texel, of the histogram; and bytes."""

    lights: Floats
    """(L, 2) angle from the normal and azimuth [degrees]"""
    views: Floats
    """(V,) angle from the normal [degrees]"""
    errors: Mapping[str, Floats]
    nbytes: Mapping[str, int]

    def mean(self, method: str, kind: int = 0, views: float | None = None, photographed: bool = False) -> float:
        """Over all pairs, or those at an angle of view [degrees], or with the lamp at the photographs' azimuth, 0."""
        v = np.isclose(self.views, views) if views is not None else np.ones(len(self.views), bool)
        i = np.isclose(self.lights[:, 1], 0) if photographed else np.ones(len(self.lights), bool)
        return float(self.errors[method][i][:, v, kind].mean())


def present(report: Report, settings: Settings, samples: Sequence[Sample]) -> Found:
    """The figure and its numbers, which are returned."""
    name = COMPARED if any(sample.name == COMPARED for sample in samples) else samples[0].name
    theta, phi = np.radians([
        (angle, 360 * k / count) for angle, count in settings.rings for k in range(count)
    ]).T  # fmt: skip
    directions = from_spherical(theta, phi)
    btf = simulate_btf(name, directions, directions, settings.full_btf)
    pca, pca_bytes = components(btf)
    h = simulate(name, size=settings.full_btf).shading_map()
    small = h.compress()
    texels = settings.full_btf**2
    angles = np.degrees(theta)
    found = Found(
        np.degrees(np.stack([theta, phi], -1)), angles,
        {PCA: _errors(btf, lambda pair: pca.images[pair]), TRUE_R: _errors(btf, _true_average(h, btf)),
         OWN: _errors(btf, _predicted(h, btf)), SMALL: _errors(btf, _predicted(small, btf))},
        {FULL: 3 * texels * len(angles) ** 2, PCA: pca_bytes, TRUE_R: 3 * texels * len(h.stack.nodes),
         OWN: 3 * texels * len(h.stack.nodes), SMALL: small.stack.nbytes},
    )  # fmt: skip
    _pictures(report, settings, name, {FULL: btf, PCA: pca, OWN: h, SMALL: small}, found, sun(h))
    _numbers(report, settings, name, found)
    return found


def components(btf: BTF) -> tuple[BTF, int]:
    """The BTF of `COMPONENTS` principal components, 8 bits a texel, channel and component; and its bytes."""
    shape = btf.images.shape
    vectors = np.ascontiguousarray(btf.images.reshape(shape[0] * shape[1], -1).T)
    count = min(COMPONENTS, vectors.shape[1])
    made = principal_components(vectors, count)
    codes, low, span = Planes.quantised(made.coefficients.reshape(*shape[2:4], 3 * count))
    planes = (low + span * (codes / LEVELS)).reshape(-1, count)
    images = (made.mean + planes @ made.basis).T.reshape(shape)
    constants = 4 * (made.basis.size + made.mean.size + low.size + span.size)
    return BTF(btf.lights, btf.views, np.maximum(images, 0)), codes.nbytes + constants


def _errors(btf: BTF, shown: Any) -> Floats:
    shape = btf.images.shape[:2]
    return np.reshape([relative(shown(pair), btf.images[pair]) for pair in np.ndindex(shape)], (*shape, 2))


def _true_average(h: ShadingMap, btf: BTF) -> Any:
    def shown(pair: tuple[int, int]) -> Floats:
        cosine = btf.lights[pair[0], 2]
        return np.asarray(h.picture(float(luminance(btf.images[pair].astype(np.float64)).mean()) * cosine) / cosine)

    return shown


def _predicted(h: ShadingMap, btf: BTF) -> Any:
    f = h.sigma * luminance(h.children["brdf"](btf.lights[:, None], btf.views))

    def shown(pair: tuple[int, int]) -> Floats:
        cosine = btf.lights[pair[0], 2]
        return np.asarray(h.picture(float(f[pair]) * cosine) / cosine)

    return shown


def difference(a: Image, b: Image) -> Floats:
    """(H, W) the largest difference of the channels in sRGB."""
    return np.asarray(np.abs(srgb_encode(a.pixels) - srgb_encode(b.pixels)).max(-1))


def _pictures(
    report: Report, settings: Settings, name: str, made: Mapping[str, Reflectance], found: Found, light: Directional
) -> None:  # fmt: skip
    truth: Image | None = None
    shown, wrong = [], []
    for method, m in made.items():
        image = render(m, lights=light, size=settings.picture, background="transparent", progress=False)
        truth = truth or image
        assert truth.alpha is not None
        on = truth.alpha > 0
        kilobytes = f"{found.nbytes[method] / 1000:,.0f} KB"
        if image is truth:
            shown.append(Panel(image.developed(), f"{method}, {kilobytes}"))
            continue
        label = f"{method}, {kilobytes}, {psnr_of(truth.pixels[on], image.pixels[on]):.1f} dB"
        shown.append(Panel(image.developed(), label))
        wrong.append(Panel(error_picture(difference(image, truth), HIGHEST_ERROR, truth.alpha), method))
    report.figure(
        "figure-4",
        f"Figure 4. {name.capitalize()}: a complete BTF of {len(found.lights)} lights and {len(found.views)} views, "
        "its principal components, and shading maps of ten pictures. Below: the differences from the complete BTF.",
        {"": shown, "differences": wrong},
    )


def _numbers(report: Report, settings: Settings, name: str, found: Found) -> None:
    rings = [angle for angle, _ in settings.rings]
    rows: list[list[Cell]] = [
        [method, found.nbytes[method] / 1000, found.nbytes[method] / settings.full_btf**2, found.mean(method),
         found.mean(method, 1), *(found.mean(method, views=angle, photographed=True) for angle in rings)]
        for method in found.errors
    ]  # fmt: skip
    whole = found.nbytes[FULL]
    rows.insert(0, [FULL, whole / 1000, whole / settings.full_btf**2, *[0.0] * (2 + len(rings))])
    ends = rings[0], rings[-1]
    first, last = (found.mean(TRUE_R, views=angle, photographed=True) for angle in ends)
    around = [found.mean(TRUE_R, views=angle) for angle in ends]
    report.table(
        "figure-4",
        "Figure 4 in numbers",
        ["method", Column("memory", "KB", ",.0f", "ours"), Column("a texel", "bytes", ",.0f", "ours"),
         Column("per texel", "1", ".3f", "ours"), Column("histogram", "1", ".3f", "ours"),
         *(Column(f"from {angle:g}°", "1", ".3f", "ours") for angle in rings)],
        rows,
        f"{name.capitalize()}, {settings.full_btf}² texels, 8 bits a channel. Relative RMS error against the complete "
        "BTF, mean over all lights and views; in the last columns per texel by the viewer's angle, over the lights at "
        "the azimuth of the photographs.",
        f"With r the true average and the lamp where it was photographed, the shading map's error per texel is "
        f"{first:.2f} seen from {ends[0]:g}° and {last:.2f} from {ends[1]:g}°, {last / first:.1f} times as much; with "
        f"the lamp all around {around[0]:.2f} and {around[1]:.2f}. A shading map has neither masking nor parallax, and "
        "its shadows keep their direction.",
    )  # fmt: skip
    report.figure(
        "figure-4-angles",
        f"Relative RMS error per texel against the angle of the viewer ({name}): lamps at the azimuth of the "
        "photographs, and all around.",
        curves(
            {f"{short}, {words}": (rings, [found.mean(method, views=angle, photographed=only) for angle in rings])
             for only, words in ((True, "as taken"), (False, "all around"))
             for method, short in ((PCA, "components"), (TRUE_R, "map, true r"), (OWN, "map, own BRDF"))},
            "viewer from the normal [degrees]", "relative RMS error",
        ),
    )  # fmt: skip
