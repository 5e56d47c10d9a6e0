"""The document on shading maps: its numbers are those that follow from the equations, and the goals hold."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import brdf
from brdf.capture import simulate, simulate_btf
from brdf.color import luminance
from brdf.geometry.directions import from_spherical
from brdf.render import mesh as meshes
from brdf.reproduce import Report
from brdf.reproduce.documents.mesostructure import compression, full_btf, prediction, samples, stacks, techniques
from brdf.reproduce.documents.mesostructure.claims import MARGIN
from brdf.reproduce.documents.mesostructure.settings import Settings
from brdf.reproduce.documents.mesostructure.vertices import teapot

TINY = Settings(
    materials=("suede", "plastic"), size=32, btf=16, full_btf=16, rings=((0.0, 1), (60.0, 4)), picture=(40, 30),
    timed=32, photograph=64, repeats=1,
)  # fmt: skip


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> tuple[Report, Path]:
    folder = tmp_path_factory.mktemp("reproduce") / "mesostructure"
    with pytest.MonkeyPatch.context() as without:
        without.delenv("BRDF_DATA", raising=False)
        return brdf.reproduce("mesostructure", folder, settings=TINY), folder


@pytest.fixture(scope="module")
def sample() -> samples.Sample:
    return samples.simulated(Settings(materials=("plastic",), size=48))[0]


def test_the_run_is_whole(made: tuple[Report, Path]) -> None:
    report, folder = made
    written = {path.name for path in folder.iterdir()}
    assert {file for figure in report.figures for file in figure.files()} <= written
    assert {f"figure-{number}" for number in range(1, 8)} <= {figure.name for figure in report.figures}
    results = json.loads((folder / "results.json").read_text("utf-8"))
    numbers = [cell for table in results["tables"].values() for row in table["rows"] for cell in row]
    assert all(cell is None or cell == cell for cell in numbers)  # no NaN
    assert len(report.claims) >= 10


def test_the_papers_table_stands_beside_ours(made: tuple[Report, Path]) -> None:
    (table,) = (table for table in made[0].tables if table.name == "table-1")
    assert [row[:2] for row in table.rows[:2]] == [["suede", 0.064878], ["plastic", 0.049011]]
    assert all(0 < cell < 0.1 for row in table.rows for cell in row[2:])  # type: ignore[operator]


def test_averages_are_exact_in_the_report(made: tuple[Report, Path]) -> None:
    (table,) = (table for table in made[0].tables if table.name == "averages")
    assert all(row[4] < MARGIN for row in table.rows)  # type: ignore[operator]


def test_without_photographs_of_a_real_sample_it_says_so(made: tuple[Report, Path]) -> None:
    (table,) = (table for table in made[0].tables if table.name == "prediction")
    assert "BRDF_DATA" in table.verdict
    assert [row[0] for row in table.rows] == ["suede", "plastic", "all"]


@pytest.mark.parametrize("technique", techniques.TECHNIQUES)
def test_techniques_show_what_the_map_itself_shows(technique: str, sample: samples.Sample) -> None:
    h = sample.native.replaced(**techniques.TECHNIQUES[technique])
    wi, wo = from_spherical(np.radians([50, 20]), np.radians([0, 70]))
    centres = (np.arange(48) + 0.5) / 48
    uv = np.stack(np.meshgrid(centres, 1 - centres), -1)
    r = h.sigma * float(luminance(h.children["brdf"].f_cos(wi, wo)))
    np.testing.assert_allclose(techniques.shown(h, r, wi[2]), h.f_cos(wi, wo, uv), rtol=1e-6, atol=1e-9)


def test_the_paper_read_literally_extrapolates_below_zero(sample: samples.Sample) -> None:
    """Its two photographs nearest to black both lie above it."""
    literal = stacks.literal(sample)
    a, images = sample.taken.averages, sample.taken.images.astype("f8")
    expected = images[-1] - (images[-2] - images[-1]) * (a[-1] / (a[-2] - a[-1]))
    np.testing.assert_allclose(literal[0], expected, atol=1e-9)
    assert literal[0].min() < -0.02 * sample.white
    np.testing.assert_allclose(literal[-1], images[0], rtol=1e-6)


def test_one_exponent_for_all_channels_is_never_better(sample: samples.Sample) -> None:
    even = samples.slices_of(sample.even)
    separate = compression.rms(compression.compressed(even, method=compression.PAPER), even)
    shared = compression.shared_exponent(even) / sample.white
    assert separate < 1.02 * shared  # eight bits may cost that much
    gray = type(even)(np.repeat(luminance(even.pictures)[..., None], 3, -1).astype("f4"))
    same = compression.rms(compression.compressed(gray, method=compression.PAPER), gray)
    white = float(np.quantile(gray.pictures[:, :, -1], 0.995))
    assert compression.shared_exponent(gray) / white == pytest.approx(same, rel=0.02)


def test_components_of_a_btf_come_close_and_cost_what_they_take() -> None:
    lights = from_spherical(*np.radians([(0, 0), (30, 0), (30, 120), (30, 240), (60, 60)]).T)
    btf = simulate_btf("stone", lights, lights, 12)
    close, size = full_btf.components(btf)
    assert size == 12 * 12 * 3 * full_btf.COMPONENTS + 4 * (25 * 17 + 2 * 48)
    errors = [samples.relative(close.images[pair], btf.images[pair])[0] for pair in np.ndindex(5, 5)]
    assert 1e-4 < np.mean(errors) < 0.03


def test_errors_are_relative_and_histograms_ignore_places() -> None:
    rng = np.random.default_rng(3)
    truth = rng.uniform(0, 1, (20, 20, 3))
    moved = truth[::-1]
    texel, histogram = samples.relative(moved, truth)
    assert texel > 0.5
    assert histogram == pytest.approx(0, abs=1e-12)
    assert samples.relative(1.1 * truth, truth)[0] == pytest.approx(0.1 * np.sqrt(np.mean(truth**2)) / truth.mean())


def test_decibels_of_several_pictures_are_those_of_all_their_pixels() -> None:
    assert samples.decibels([0.1, 0.1]) == pytest.approx(20)
    assert samples.decibels([0.1, 0]) == pytest.approx(20 + 10 * np.log10(2))


def test_a_photograph_left_out_is_predicted_by_the_others() -> None:
    taken = simulate("leather", (0, 20, 40, 60), 32)
    found = prediction.left_out(taken)
    assert list(found) == [20, 40]
    kept = simulate("leather", (0, 40, 60), 32).shading_map()
    error = samples.rms(samples.predicted(kept, 20.0), taken.images[1])
    assert found[20.0] == pytest.approx(error / prediction.white(samples.slices_of(taken.shading_map())), rel=1e-6)


def test_a_real_sample_is_predicted(data: Path) -> None:
    """Eight photographs of a relief in 43 x 64 pixels, one left out at a time."""
    real = brdf.capture.flat(data / prediction.REAL)
    assert samples.decibels(prediction.left_out(real).values()) > 29


def test_the_finest_teapot_is_the_shipped_one() -> None:
    ours, shipped = teapot(20), meshes.load("teapot")
    assert len(ours.faces) == len(shipped.faces)
    corners = [mesh.vertices[mesh.faces].reshape(-1, 3) for mesh in (ours, shipped)]
    np.testing.assert_allclose(corners[0], corners[1], atol=1e-5)
    np.testing.assert_allclose(ours.normals, shipped.normals, atol=1e-4)


def test_goals_on_all_simulated_materials() -> None:
    """Prediction in between, and 6 bytes a texel: geometric means, small pictures."""
    every = samples.simulated(Settings(size=48))
    assert len(every) == 10
    predicted = [
        samples.decibels(samples.rms(samples.predicted(sample.native, angle), picture) / sample.white
                         for angle, picture in zip(sample.between.elevations, sample.between.images, strict=True))
        for sample in every
    ]  # fmt: skip
    assert np.mean(predicted) >= 35
    for images, goal in (("taken", 0.007), ("between", 0.017)):
        found = samples.over(every, lambda sample, images=images: compression.rms_at(
            sample.native.compress().stack, getattr(sample, images).images, sample.white))  # fmt: skip
        assert found <= goal
