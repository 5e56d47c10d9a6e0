"""The first document: its numbers are the ones that follow from its equations."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import brdf
from brdf.reproduce import Report
from brdf.reproduce.documents.images import candidates, scenes, spheres
from brdf.reproduce.documents.images.settings import Settings

TINY = Settings(
    materials=2, sphere=20, texture=32, largest=64, budgets=(4, 16), fitted=(), picture=48, frame=(48, 36), repeats=1
)


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> tuple[Report, Path]:
    folder = tmp_path_factory.mktemp("reproduce") / "images"
    return brdf.reproduce("images", folder, settings=TINY), folder


def test_the_run_is_whole(made: tuple[Report, Path]) -> None:
    report, folder = made
    written = {path.name for path in folder.iterdir()}
    assert {file for figure in report.figures for file in figure.files()} <= written
    assert {table.name for table in report.tables} >= {
        "figure-4", "table-1", "light-cost", "error-by-pictures", "error-by-bytes", "models", "materials",
    }  # fmt: skip
    results = json.loads((folder / "results.json").read_text("utf-8"))
    numbers = [cell for table in results["tables"].values() for row in table["rows"] for cell in row]
    assert all(cell is None or cell == cell for cell in numbers)  # no NaN
    assert len(report.claims) >= 6


def test_the_papers_frames_stand_beside_ours(made: tuple[Report, Path]) -> None:
    (table,) = (table for table in made[0].tables if table.name == "table-1")
    assert [row[2] for row in table.rows] == [388, 384, 383, 380, 325, 324, 324, 323]
    assert all(cell > 0 for row in table.rows for cell in row[3:])  # type: ignore[operator]


def test_more_pictures_and_more_bytes_are_better(made: tuple[Report, Path]) -> None:
    tables = {table.name: table for table in made[0].tables}
    monotone = next(row for row in tables["error-by-pictures"].rows if row[:2] == ["mean", candidates.MONOTONE])
    assert monotone[-1] > monotone[2] + 3  # type: ignore[operator]
    stack = next(row for row in tables["error-by-bytes"].rows if row[:2] == ["mean", candidates.STACK_AT_NODES])
    assert stack[2] is None or stack[2] < stack[3]  # type: ignore[operator]


def test_figure_4_has_the_errors_that_follow_from_the_equations() -> None:
    """White diffuser: Eq. 2 is exact but for the shortening, half angles bend the shade by 0.02."""
    report = Report("x", "X", "")
    report.section("s")
    full, half, paper, whole, monotone, _ = spheres.blending(report, Settings(picture=256)).values()
    assert full["matte RMSE"] < 0.004
    assert full["matte worst"] < 0.05
    assert half["matte RMSE"] > 0.015
    assert paper["matte RMSE"] < 0.009
    assert paper["matte worst"] < 0.05
    assert whole["matte worst"] > 2 * paper["matte worst"]
    assert [way["highlights"] for way in (full, half, paper, monotone)] == [2, 1, 1, 1]
    assert monotone["psnr"] > paper["psnr"] > max(full["psnr"], half["psnr"])


def test_candidates_fit_into_their_budgets() -> None:
    m = brdf.load("nickel@bagher_sgd")
    made = list(candidates.by_bytes(m, (4, 16), ()))
    assert {candidate.key for candidate in made} == {4, 16}
    for candidate in made:
        assert 0.7 < candidate.reflectance.nbytes / (candidate.key * 1024) < 1.02, candidate


def test_pictures_of_the_sweep_are_those_baked_at_their_angles() -> None:
    m = brdf.load("nickel@bagher_sgd")
    swept = {(c.method, c.key): c.reflectance for c in candidates.by_pictures(m, 16, (3, 4))}
    baked = brdf.SphereImages.bake(m, (0, 60, 120), 16, storage=candidates.STORAGE, blend="monotone")
    one = swept[candidates.MONOTONE, 3]
    assert isinstance(one, brdf.SphereImages)
    np.testing.assert_array_equal(one.images, baked.images)
    assert one.structure == baked.structure
    dark = brdf.SphereImages.bake(m, (0, 45, 90, 135), 16, storage=candidates.STORAGE, dilate=False)
    dark = dark.with_blend("full", guard=False, mask=False)
    literal = swept["Eq. 2, full angles", 4]
    assert isinstance(literal, brdf.SphereImages)
    np.testing.assert_array_equal(literal.images, dark.images)
    assert literal.structure == dark.structure


def test_a_light_of_the_papers_costs_microseconds() -> None:
    assert scenes.slope([1000 / fps for fps in scenes.PAPER_FPS["bunny"]]) == pytest.approx(0.0023, abs=0.0002)
    assert scenes.slope([1, 2, 4, 8]) == pytest.approx(1)


def test_the_quick_run_measures_materials_of_every_kind() -> None:
    from brdf.reproduce.documents.images.settings import SETTINGS, chosen

    assert len(chosen(SETTINGS["full"])) == 100
    assert len(set(chosen(SETTINGS["quick"]))) == 8
