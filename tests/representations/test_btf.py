"""Images over light and view directions: exact at the nodes and for what is linear, honest outside."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from brdf import BTF, laws
from brdf.errors import ParameterError
from brdf.geometry.directions import from_spherical
from brdf.models import Lambertian
from brdf.reflectance import Reflectance
from helpers import random_directions

THETA, PHI = (
    np.radians([0, 40, 40, 40, 40, 75, 75, 75, 75, 75, 75]),
    np.radians([0, *range(0, 360, 90), *range(5, 360, 60)]),
)
NODES = from_spherical(THETA, PHI)
RNG = np.random.default_rng(0)
IMAGES = RNG.uniform(0.01, 0.3, (11, 11, 3, 4, 3)).astype(np.float32)


def test_nodes_and_texel_centres_are_what_was_given() -> None:
    m = BTF(NODES, NODES, IMAGES)
    light, view, row, column = (RNG.integers(0, n, 200) for n in (11, 11, 3, 4))
    uv = np.stack([(column + 0.5) / 4, 1 - (row + 0.5) / 3], -1)
    np.testing.assert_allclose(m(NODES[light], NODES[view], uv), IMAGES[light, view, row, column], rtol=1e-5)


def test_linear_in_both_directions_and_in_place_is_met_exactly() -> None:
    slope = lambda w: 1 + 0.4 * w[..., 0] - 0.3 * w[..., 1]  # noqa: E731
    rows, columns = 1 - (np.arange(8) + 0.5) / 8, (np.arange(6) + 0.5) / 6
    place = 0.2 + 0.5 * columns + 0.1 * rows[:, None]
    images = slope(NODES)[:, None, None, None] * slope(NODES)[:, None, None] * place
    m = BTF(NODES, NODES, np.repeat(images[..., None], 3, -1))
    wi, wo = random_directions(500, 1, 0.6), random_directions(500, 2, 0.6)
    uv = RNG.uniform(0.1, 0.9, (500, 2))
    expected = slope(wi) * slope(wo) * (0.2 + 0.5 * uv[:, 0] + 0.1 * uv[:, 1])
    np.testing.assert_allclose(m(wi, wo, uv)[:, 1], expected, rtol=1e-5)


def test_outside_the_measured_directions_the_rim_counts() -> None:
    m = BTF(NODES, NODES, IMAGES)
    uv = (0.125, 1 - 0.5 / 3)
    beyond = from_spherical(np.radians(89), PHI[6])
    np.testing.assert_allclose(m(beyond, NODES[0], uv), IMAGES[6, 0, 0, 0], rtol=1e-5)


def test_a_diffuser_and_its_albedo() -> None:
    m = BTF(NODES, NODES, np.full((11, 11, 2, 2, 3), 0.5 / np.pi))
    wi, wo = random_directions(100, 5), random_directions(100, 6)
    np.testing.assert_allclose(m(wi, wo, RNG.random((100, 2))), Lambertian()(wi, wo), rtol=1e-6)
    np.testing.assert_allclose(m.albedo(NODES[2]), 0.5, atol=2e-3)


@pytest.mark.parametrize("law", ["positivity", "sampling", "density", "weight", "energy"])
def test_laws_hold(law: str) -> None:
    result = next(found for found in laws.ALL if found.name == law)(BTF(NODES, NODES, IMAGES))
    assert result.status == "holds", result


def test_saved_and_restored(tmp_path: Path) -> None:
    m = BTF(NODES, NODES[:7], IMAGES[:, :7])
    m.save(tmp_path / "m.safetensors")
    wi, wo, uv = random_directions(50, 1), random_directions(50, 2), RNG.random((50, 2))
    np.testing.assert_array_equal(Reflectance.restore(tmp_path / "m.safetensors")(wi, wo, uv), m(wi, wo, uv))


def test_bad_input() -> None:
    with pytest.raises(ParameterError, match=r"must be \(11, 11, rows, columns, 3\), got \(11, 10, 3, 4, 3\)"):
        BTF(NODES, NODES, IMAGES[:, :10])
    with pytest.raises(ParameterError, match="lights of a BTF must be at least 3"):
        BTF(NODES[:2], NODES, IMAGES[:2])
    with pytest.raises(ParameterError, match="views of a BTF must lie above"):
        BTF(NODES, -NODES, IMAGES)
    with pytest.raises(ParameterError, match="must be finite"):
        BTF(NODES, NODES, np.full_like(IMAGES, np.nan))
