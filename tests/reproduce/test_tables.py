"""The document on parameterised tables: its numbers are the ones that follow from its equations."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import brdf
from brdf.representations.baking import alpha_search
from brdf.reproduce import Report
from brdf.reproduce.documents.tables import density, filters, measuring, options, pictures
from brdf.reproduce.documents.tables.settings import SETTINGS, Settings, chosen

TINY = Settings(
    materials=2, budgets=(4, 64), pairs=2048, searched=0, converted=6, resolution=8, resolutions=(6, 8), azimuths=4,
    shown=1, frame=(64, 48), samples=4, timed=(48, 36), repeats=1,
)  # fmt: skip


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> tuple[Report, Path]:
    folder = tmp_path_factory.mktemp("reproduce") / "tables"
    with pytest.MonkeyPatch.context() as patch:
        patch.delenv("BRDF_DATA", raising=False)
        patch.setattr(alpha_search, "PAIRS", 512)
        patch.setattr(measuring, "STEPS", 6)
        return brdf.reproduce("tables", folder, settings=TINY), folder


def test_the_run_is_whole(made: tuple[Report, Path]) -> None:
    report, folder = made
    written = {path.name for path in folder.iterdir()}
    assert {file for figure in report.figures for file in figure.files()} <= written
    assert {figure.name for figure in report.figures} >= {f"figure-{n}" for n in (2, 3, 4, 5, 7)} | {"figure-6-error"}
    assert {table.name for table in report.tables} >= {
        "nodes", "wasted", "figure-3", "figure-4", "figure-5", "figure-6-error", "figure-6-time", "figure-7",
        "error-by-bytes", "materials", "conversion",
    }  # fmt: skip
    results = json.loads((folder / "results.json").read_text("utf-8"))
    numbers = [cell for table in results["tables"].values() for row in table["rows"] for cell in row]
    assert all(cell is None or cell == cell for cell in numbers)  # no NaN
    assert len(report.claims) >= 10


def test_without_a_folder_of_measured_files_a_sentence_says_so(made: tuple[Report, Path]) -> None:
    (section,) = (section for section in made[0].sections if section.title == "Measured files")
    assert section.text.startswith("None were measured in this run")
    assert not section.items


def test_the_share_of_the_grid_below_the_horizon(made: tuple[Report, Path]) -> None:
    """Of even angles 0.382709, in closed form; normal and triangle bases have none."""
    (table,) = (table for table in made[0].tables if table.name == "wasted")
    shares = {row[0]: row[2] for row in table.rows}
    assert shares["half vector, even angles"] == pytest.approx(38.2709, abs=1e-3)
    assert all(shares[basis] == pytest.approx(0, abs=1e-9) for basis in ("normal", "sheared", "stark"))


def test_more_bytes_are_better_and_half_vectors_best(made: tuple[Report, Path]) -> None:
    (table,) = (table for table in made[0].tables if table.name == "error-by-bytes")
    median = {row[1]: row[2:] for row in table.rows if row[0] == "median"}
    for small, large, *_ in median.values():
        assert large < small  # type: ignore[operator]
    assert median[options.HALF_LOG][1] < 0.2 * median[options.UNIFORM][1]  # type: ignore[operator]


def test_options_fill_their_bytes() -> None:
    m = brdf.load("nickel@bagher_sgd")
    alphas = {"intensity": (1.0, 0.0), "measured": (0.7, 0.7, 0.1)}
    for name, bake in options.tables(m, 16, alphas):
        assert 0.6 < bake().nbytes / (16 * 1024) < 1.02, name


def test_the_brightest_table_crowds_its_azimuths_at_the_mirror() -> None:
    found = measuring.intensities_of(brdf.load("nickel@bagher_sgd"))
    assert found.best[1] == 0
    assert found.bezier[found.best] > max(found.uniform, found.bezier[0.6, 0.6])
    assert found.identity == pytest.approx(found.bezier[1.0, 1.0], rel=1e-6)


def test_the_papers_alpha_for_even_angles() -> None:
    assert density.from_even() == pytest.approx(0.0078, abs=1e-4)


def test_creases_show_with_linear_filtering_and_are_gone_with_cubic() -> None:
    report = Report("x", "X", "")
    report.section("s")
    creases = filters.present(report, Settings(frame=(96, 96)))
    assert creases["nearest"] > 5 * creases["linear"]
    assert max(creases[how] for how in ("catmull-rom", "b-spline", "prefiltered-b-spline")) < 0.4


def test_the_same_values_make_the_same_picture() -> None:
    """Light paths are those of the reflectance it is compared with: no noise stands between them."""
    m = brdf.load("GGX:alpha=.3")
    view = pictures.View({"env": "studio", "size": (48, 36), "samples": 4})
    true = view.image(m)
    assert view.of(brdf.load("GGX:alpha=.3"), m, true).rms == 0
    double = view.of(2 * m, m, true)
    assert double.rms == pytest.approx(1, rel=1e-5)
    wi, wo = view.pairs(m)
    assert wi.shape == wo.shape
    np.testing.assert_allclose(np.linalg.norm(wi, axis=1), 1, atol=1e-5)


def test_the_runs_measure_materials_of_every_kind() -> None:
    assert len(chosen(SETTINGS["full"])) == 100
    assert len(set(chosen(SETTINGS["quick"]))) == 8
