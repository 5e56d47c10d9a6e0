"""Which picture to show: the four techniques against complete BTFs of simulated samples."""

from __future__ import annotations

import numpy as np
import pytest

from brdf import ShadingMap
from brdf.capture import simulation
from brdf.color import luminance
from brdf.geometry.directions import from_spherical

SIZE = 48
SAMPLES = simulation.names()
LIGHTS = (20.0, 40.0, 60.0, 75.0)
"""Angles from the normal; the azimuth is that of the photographs."""
VIEWS = ((0.0, 0.0), (30.0, 60.0), (30.0, 240.0), (60.0, 0.0), (60.0, 200.0))
TECHNIQUES = {
    "shading": {}, "angular": {}, "lit-texture": {},
    "radiance": {"intensity": 0.25}, "radiance, strong light": {"intensity": 4.0},
}  # fmt: skip


@pytest.fixture(scope="module")
def errors() -> dict[str, np.ndarray]:
    """For each technique (light, 2): relative RMS per texel, and that of the sorted luminances; means over the rest."""
    found: dict[str, list[np.ndarray]] = {name: [] for name in TECHNIQUES}
    centres = np.stack(np.meshgrid((np.arange(SIZE) + 0.5) / SIZE, 1 - (np.arange(SIZE) + 0.5) / SIZE), -1)
    lights = from_spherical(np.radians(LIGHTS), np.zeros(len(LIGHTS)))
    views = from_spherical(*np.radians(VIEWS).T)
    for sample in SAMPLES:
        taken = simulation.simulate(sample, size=SIZE)
        h = ShadingMap.from_images(list(taken.images), taken.elevations)
        btf = simulation.simulate_btf(sample, lights, views, SIZE)
        f = luminance(h.children["brdf"](lights[:, None], views))
        for name, options in TECHNIQUES.items():
            errors = np.zeros((len(lights), len(views), 2))
            for i, wi in enumerate(lights):
                for o, wo in enumerate(views):
                    truth = btf.images[i, o].astype("f8")
                    sigma = luminance(truth).mean() / f[i, o]  # the true average
                    m = h.replaced(technique=name.split(",")[0], sigma=sigma, **options)
                    shown = m(wi, wo, centres)
                    errors[i, o, 0] = np.sqrt(np.mean((shown - truth) ** 2)) / truth.mean()
                    both = np.sort(luminance(np.stack([shown, truth])).reshape(2, -1))
                    errors[i, o, 1] = np.sqrt(np.mean((both[0] - both[1]) ** 2)) / both[1].mean()
            found[name].append(errors.mean(1))
    return {name: np.mean(per_sample, 0) for name, per_sample in found.items()}


COLUMNS = [(slice(0, 2), 0), (slice(0, 2), 1), (slice(2, 4), 0), (slice(2, 4), 1)]
"""Lights up to 40 degrees and from 60 on; per texel and in the distribution."""


@pytest.mark.parametrize(("lights", "column"), COLUMNS)
def test_looking_up_by_r_or_by_angle_is_far_closer_to_the_truth(
    errors: dict[str, np.ndarray], lights: slice, column: int
) -> None:
    means = {name: float(found[lights, column].mean()) for name, found in errors.items()}
    assert means["shading"] < 1.05 * means["angular"], means
    for name in ("lit-texture", "radiance", "radiance, strong light"):
        assert means[name] > 1.5 * means["shading"], means


def test_looking_up_by_r_is_closest_in_all(errors: dict[str, np.ndarray]) -> None:
    means = {name: np.prod([found[part].mean() for part in COLUMNS]) ** 0.25 for name, found in errors.items()}
    assert min(means, key=means.__getitem__) == "shading", means
