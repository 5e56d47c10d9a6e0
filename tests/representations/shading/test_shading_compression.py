"""Compressed shading maps: fits against known curves, components against known ranks, errors as published."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import brdf
from brdf import ShadingMap
from brdf.color import luminance
from brdf.errors import ParameterError, ReflectanceError, UnknownNameError
from brdf.formula import engine
from brdf.models import GGX, Lambertian
from brdf.representations.shading import compression as compression
from brdf.representations.shading import fits as fits
from brdf.representations.shading.planes import Planes
from brdf.representations.shading.principal import principal_components
from brdf.representations.shading.slices import Slices
from lobes import random_pairs
from mesostructures import ACQUIRED, BETWEEN, HEIGHTS, photographs

SIZE = 48
RNG = np.random.default_rng(8)
X = np.arange(1, 8) / 7
CURVE = np.array([0.02, 0.08, 0.2, 0.35, 0.5, 0.7, 1])
"""Samples of one texel at X; with the black one before them there are 8."""
METHODS = [*compression.METHODS]


def fitted(kernel, samples: np.ndarray, *options) -> np.ndarray:
    """(2, T, 3): both numbers of each texel and channel."""
    samples = np.ascontiguousarray(samples, np.float32)
    out = np.empty((len(samples), 6), np.float32)
    kernel(0, len(samples), samples, *options, out)
    return np.stack([out[:, :3], out[:, 3:]])


def one(kernel, *options) -> tuple[float, float]:
    first, second = fitted(kernel, np.broadcast_to(CURVE[None, :, None], (1, 7, 3)), *options)[:, 0, 1]
    return float(first), float(second)


def rms_of(fit: np.ndarray) -> float:
    """The black sample, which every fit meets, counts, as in the published figures."""
    return float(np.sqrt(np.sum((fit - CURVE) ** 2) / 8))


# ---- the fits, value by value ------------------------------------------------------------------------------------


def test_brute_force_on_a_known_curve() -> None:
    k, K = one(fits.searched, fits.powers_table(X), False)
    assert (k, K) == (1, pytest.approx(1.99, abs=1e-6))
    assert rms_of(k * X**K) == pytest.approx(0.0162774, abs=2e-7)


def test_brute_force_of_both_numbers_on_a_known_curve() -> None:
    k, K = one(fits.searched, fits.powers_table(X), True)
    assert (k, K) == (pytest.approx(0.982803, abs=2e-6), pytest.approx(1.95, abs=1e-6))
    assert rms_of(k * X**K) == pytest.approx(0.0146968, abs=2e-7)


def test_logarithms_and_newton_on_a_known_curve() -> None:
    logarithms = np.log(X).astype(np.float32)
    assert one(fits.solved, logarithms, 0) == (1, pytest.approx(1.982178, abs=2e-6))
    assert one(fits.solved, logarithms, 12) == (1, pytest.approx(1.991201, abs=2e-6))
    assert one(fits.solved, logarithms, 2)[1] == pytest.approx(1.9912, abs=2e-5)


def test_quadratic_on_a_known_curve() -> None:
    operator = np.linalg.pinv(np.stack([X, X * X], -1)).astype(np.float32)
    p, q = one(fits.projected, operator)
    assert (p, q) == (pytest.approx(0.0374510, abs=1e-6), pytest.approx(0.9456863, abs=1e-6))
    assert rms_of(p * X + q * X**2) == pytest.approx(0.0144665, abs=2e-7)


def test_exact_powers_are_recovered() -> None:
    K, k = RNG.uniform(0.1, 9.5, (400, 3)), RNG.uniform(0.05, 1, (400, 3))
    samples = k[:, None] * X[:, None] ** K[:, None]
    table = fits.powers_table(X)
    for found in (
        fitted(fits.searched, samples, table, False),
        fitted(fits.searched, samples, table, True),
        fitted(fits.solved, samples, np.log(X).astype(np.float32), 2),
    ):
        np.testing.assert_allclose(found[1], K, atol=0.006)
        np.testing.assert_allclose(found[0], k, rtol=5e-3)


def test_black_and_odd_texels_stay_finite_and_within_bounds() -> None:
    samples = np.zeros((4, 7, 3))
    samples[1, -1] = 0.5  # dark until the last
    samples[2] = np.linspace(1, 0.2, 7)[:, None]  # a highlight that moves on
    samples[3, :-1] = 1e-8
    samples[3, -1] = 1
    table = fits.powers_table(X)
    for found in (
        fitted(fits.searched, samples, table, False),
        fitted(fits.searched, samples, table, True),
        fitted(fits.solved, samples, np.log(X).astype(np.float32), 2),
    ):
        assert np.isfinite(found).all()
        assert (found[0, 0] == 0).all()
        assert (found[1, 0] == 1).all()
        assert ((found[1] >= fits.LEAST - 1e-6) & (found[1] <= fits.MOST)).all()
        np.testing.assert_allclose(found[1, 2], fits.LEAST, atol=1e-6)
        np.testing.assert_allclose(found[1, 1], fits.MOST, atol=1e-5)


# ---- components --------------------------------------------------------------------------------------------------


def test_components_are_those_of_the_singular_value_decomposition() -> None:
    vectors = (RNG.standard_normal((40_000, 9)) * np.linspace(3, 0.1, 9) + 2).astype("f4")
    found = principal_components(vectors, 4)
    centred = vectors - vectors.mean(0, dtype="f8")
    _, _, expected = np.linalg.svd(centred[:], full_matrices=False)
    np.testing.assert_allclose(np.abs(np.einsum("cd,cd->c", found.basis, expected[:4])), 1, atol=1e-6)
    np.testing.assert_allclose(found.coefficients, centred @ found.basis.T, atol=2e-5)
    np.testing.assert_allclose(found.mean, vectors.mean(0, dtype="f8"), rtol=1e-6)


def test_pictures_of_few_components_come_back_up_to_rounding() -> None:
    base = RNG.uniform(0, 1, (32, 32, 3))
    pictures = 0.2 * np.arange(1, 7)[:, None] + np.einsum("rcm,mnk->rcnk", base, RNG.uniform(0, 1, (3, 6, 3)))
    pictures = pictures * np.arange(1, 7)[:, None]
    slices = Slices(pictures.astype("f4"))
    assert compression.rms(compression.compressed(slices, 3), slices) < 0.003
    assert compression.rms(compression.compressed(slices, 2), slices) > 0.01


def test_eight_bits_reach_both_ends_of_each_plane() -> None:
    planes = RNG.uniform(-3, 5, (20, 20, 4)).astype("f4")
    planes[..., 3] = 0.7
    codes, low, span = Planes.quantised(planes)
    assert (codes.min((0, 1)) == 0).all()
    assert (codes.max((0, 1)) == [255, 255, 255, 0]).all()
    assert np.abs(low + span * codes / 255 - planes).max() <= (span.max() / 255) * 0.501


# ---- whole maps --------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def maps() -> dict[tuple[str, str], ShadingMap]:
    return {
        (name, mode): ShadingMap.from_images(photographs(name, SIZE), ACQUIRED, mode=mode)
        for name in HEIGHTS
        for mode in ("native", "paper")
    }


def test_components_keep_the_averages(maps: dict[tuple[str, str], ShadingMap]) -> None:
    for h in maps.values():
        for size in (1, 3, 6):
            small = h.compress(size)
            assert small.stack.bytes_per_texel == size
            np.testing.assert_allclose(small.stack.nodes, h.stack.nodes, rtol=1e-6)
            if size == 6:  # values below 0 count as 0, which adds a little in the darkest pictures
                shown = [luminance(small.picture(node)).mean() for node in h.stack.nodes]
                np.testing.assert_allclose(shown, h.stack.nodes, rtol=0.04)


@pytest.mark.parametrize("method", METHODS)
def test_the_formula_evaluates_what_is_stored(method: str, maps: dict[tuple[str, str], ShadingMap]) -> None:
    h = maps["plastic", "native"].compress(method=method)
    uv = np.stack(np.meshgrid((np.arange(SIZE) + 0.5) / SIZE, 1 - (np.arange(SIZE) + 0.5) / SIZE), -1)
    for r in (0.0, 1e-4, 0.03, h.stack.highest, 2 * h.stack.highest):
        np.testing.assert_allclose(h.lookup(r, uv), h.picture(r), rtol=1e-5, atol=1e-6)


@pytest.mark.parametrize("method", METHODS)
def test_kernel_and_formula_agree(method: str, maps: dict[tuple[str, str], ShadingMap]) -> None:
    h = maps["cloth", "native"].compress(method=method)
    wi, wo = (w.astype(np.float32) for w in random_pairs(engine.SMALL))
    uv = RNG.random((len(wi), 2), dtype=np.float32)
    some = np.arange(0, len(wi), 97)
    expected = h(*(a[some].astype("f8") for a in (wi, wo, uv)))
    np.testing.assert_allclose(h(wi, wo, uv)[some], expected, rtol=2e-3, atol=2e-5)


def test_errors_are_as_published(maps: dict[tuple[str, str], ShadingMap]) -> None:
    """Geometric means over materials: the paper's fit as its Table 1; ours well below; more bytes, less error."""
    tables = {
        key: {(row.method, row.bytes_per_texel): row for row in h.compression_table(photographs(key[0], SIZE, BETWEEN))}
        for key, h in maps.items()
    }

    def mean(mode: str, method: str, size: float, which: str = "rms") -> float:
        found = [getattr(table[method, size], which) for (_, m), table in tables.items() if m == mode]
        return float(np.exp(np.mean(np.log(found))))

    assert mean("paper", "power-brute-force", 6) < 0.065
    assert mean("native", "pca", 6) <= 0.007
    assert mean("native", "pca", 6, "held_out_rms") <= 0.017
    assert mean("native", "pca", 6, "held_out_rms") < mean("paper", "pictures", 21, "held_out_rms")
    assert mean("native", "power-joint", 6) < mean("native", "power-brute-force", 6)
    assert mean("native", "power", 6) == pytest.approx(mean("native", "power-brute-force", 6), rel=0.02)
    by_size = [mean("native", "pca", size) for size in range(1, 7)]
    assert by_size == sorted(by_size, reverse=True)
    for method in ("quadratic", "power-joint", "power", "power-brute-force"):
        assert mean("native", "pca", 3) < mean("native", method, 6)
    assert all(table["pictures", 30.0].rms < 1e-6 for (_, mode), table in tables.items() if mode == "native")


@pytest.mark.parametrize("method", METHODS)
def test_saved_and_loaded(method: str, maps: dict[tuple[str, str], ShadingMap], tmp_path: Path) -> None:
    h = maps["suede", "native"].compress(method=method).replaced(brdf=GGX(alpha=0.4) + Lambertian())
    h.save(tmp_path / "h.safetensors")
    wi, wo = random_pairs(40)
    uv = RNG.random((40, 2))
    np.testing.assert_array_equal(brdf.load(tmp_path / "h.safetensors")(wi, wo, uv), h(wi, wo, uv))
    assert SIZE * SIZE * 6 < h.nbytes < SIZE * SIZE * 6 + 1000


def test_what_is_refused(maps: dict[tuple[str, str], ShadingMap]) -> None:
    h = maps["stone", "native"]
    with pytest.raises(UnknownNameError, match="unknown compression method 'power_joint': did you mean 'power-joint'"):
        h.compress(method="power_joint")
    for size in (0, 7, 2.5, True):
        with pytest.raises(ParameterError, match=r"bytes_per_texel must be a whole number in \[1, 6\]"):
            h.compress(size)
    with pytest.raises(ParameterError, match="quadratic takes 6 bytes a texel, got 4; 'pca' goes down to 1"):
        h.compress(4, "quadratic")
    with pytest.raises(ReflectanceError, match="this shading map is compressed"):
        h.compress().compress()
    with pytest.raises(ReflectanceError, match="this shading map is compressed"):
        h.compress().mipmaps()
