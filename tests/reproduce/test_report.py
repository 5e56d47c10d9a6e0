"""The framework: what a document adds is what is written, and nothing half-written stays."""

from __future__ import annotations

import json
import math
import re
from html.parser import HTMLParser
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import brdf
from brdf.errors import FileError, UnknownNameError
from brdf.reproduce import Column, Panel, Report, run
from brdf.reproduce.charts import curves


def filled() -> Report:
    report = Report("sample", "A sample", "Somebody & somebody else.", {"size": 8})
    report.section("Numbers", "Words with <angle brackets>.")
    ramp = np.linspace(0, 255, 8 * 8 * 3).reshape(8, 8, 3).astype(np.uint8)
    report.figure("ramp", "A ramp", {"first": [Panel(ramp, "a"), Panel(ramp, "b")], "second": [Panel(ramp, "c")]})
    report.figure("alone", "One picture", Panel(ramp))
    report.figure("curve", "A curve", curves({"one": ([1, 2], [3, 4])}, "x", "y", {1: "one", 2: "two"}, x_scale="log"))
    report.table(
        "frames",
        "Frames",
        ["mesh", Column("frames", "fps", "d", "paper"), Column("frames", "fps", ".2f", "ours")],
        [["teapot", 388, 12.3456], ["sphere", None, math.inf]],
        "Counted.",
        "Ours are fewer.",
    )
    report.claim("It is fast", {"12 of 388": False, "drawn at all": True})
    return report


class Links(HTMLParser):
    """What a page loads or leads to."""

    def __init__(self) -> None:
        super().__init__()
        self.found: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found += [value or "" for name, value in attrs if name in ("src", "href")]
        assert tag not in ("script", "link", "iframe")


def test_everything_is_written_and_a_page_needs_no_other_file(tmp_path: Path) -> None:
    report = filled()
    report.write(tmp_path)
    named = {"ramp-1.png", "ramp-2.png", "ramp-3.png", "alone.png", "curve.svg", "curve.png"}
    assert {path.name for path in tmp_path.iterdir()} == named | {"index.html", "results.json", "results.md"}
    page = (tmp_path / "index.html").read_text("utf-8")
    links = Links()
    links.feed(page)
    assert len([link for link in links.found if link.startswith("data:image/png;base64,")]) == 4
    assert all(link.startswith(("data:", "#")) for link in links.found)
    assert "&lt;angle brackets&gt;" in page
    assert "Somebody &amp; somebody else." in page
    for text in ("388", "12.35", "exact", "–", "Ours are fewer.", "Counted.", "holds in part", "✗ 12 of 388"):
        assert text in page
    assert "currentColor" in page
    assert "#010203" not in page


def test_the_results_hold_every_number_with_its_unit_and_whose_it_is(tmp_path: Path) -> None:
    filled().write(tmp_path)
    results = json.loads((tmp_path / "results.json").read_text("utf-8"))
    table = results["tables"]["frames"]
    assert table["rows"] == [["teapot", 388, 12.3456], ["sphere", None, "exact"]]
    assert [column["whose"] for column in table["columns"]] == ["", "paper", "ours"]
    assert table["columns"][1]["unit"] == "fps"
    assert results["claims"][0]["verdict"] == "holds in part"
    assert results["brdf"] == brdf.__version__
    assert results["machine"]["cores"] >= 1
    assert results["settings"] == {"size": 8}


def test_the_text_has_the_tables_and_the_claims(tmp_path: Path) -> None:
    filled().write(tmp_path)
    text = (tmp_path / "results.md").read_text("utf-8")
    assert "| mesh | frames, paper, fps | frames, ours, fps |\n| --- | ---: | ---: |\n| teapot | 388 | 12.35 |" in text
    assert "“It is fast” **Holds in part.**\n\n- no: 12 of 388\n- yes: drawn at all" in text


def test_the_same_report_gives_the_same_bytes(tmp_path: Path) -> None:
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        filled().write(tmp_path / name)
    for path in (tmp_path / "one").iterdir():
        assert path.read_bytes() == (tmp_path / "two" / path.name).read_bytes(), path.name


@pytest.mark.parametrize(
    ("held", "verdict"), [((True, True), "holds"), ((True, False), "holds in part"), ((False, False), "does not hold")]
)
def test_a_verdict_follows_from_the_checks(held: tuple[bool, ...], verdict: str) -> None:
    report = Report("x", "X", "")
    report.section("s")
    report.claim("c", {str(number): one for number, one in enumerate(held)})
    assert report.claims[0].verdict == verdict


def test_charts_keep_their_words_as_words() -> None:
    from brdf.reproduce.pictures import svg

    drawn = svg(curves({"one curve": ([1, 2], [3, 4])}, "memory", "error"))
    assert re.findall(r">(one curve|memory|error)<", drawn)
    assert "<dc:date>" not in drawn


# ---- folders -----------------------------------------------------------------------------------------------------


def document(fails: bool = False) -> SimpleNamespace:
    def made(report: Report, settings: dict[str, bool]) -> None:
        report.section("only")
        report.claim("c", {"one": settings["quick"]})
        if fails:
            raise RuntimeError("broken")

    return SimpleNamespace(
        TITLE="A", SOURCE="B", SETTINGS={"full": {"quick": False}, "quick": {"quick": True}}, run=made
    )


def test_a_document_is_run_with_its_settings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(run, "_document", lambda name: document())
    for quick in (False, True):
        report = brdf.reproduce("a", tmp_path / str(quick), quick=quick)
        assert report.claims[0].verdict == ("holds" if quick else "does not hold")
    assert (tmp_path / "True" / "index.html").stat().st_mode & 0o044
    assert (tmp_path / "True").stat().st_mode & 0o055


def test_a_failure_leaves_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(run, "_document", lambda name: document(fails=True))
    with pytest.raises(RuntimeError):
        brdf.reproduce("a", tmp_path / "out")
    assert list(tmp_path.iterdir()) == []


def test_an_existing_folder_is_kept_unless_an_earlier_run_wrote_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(run, "_document", lambda name: document())
    out = tmp_path / "out"
    brdf.reproduce("a", out)
    (out / "old").touch()
    with pytest.raises(FileError, match="exists; choose another folder with -o, or replace it with --force"):
        brdf.reproduce("a", out)
    brdf.reproduce("a", out, force=True)
    assert not (out / "old").exists()
    (out / "results.json").unlink()
    with pytest.raises(FileError, match="was not written by this command"):
        brdf.reproduce("a", out, force=True)
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


def test_a_folder_that_cannot_be_written_is_one_line(tmp_path: Path) -> None:
    with pytest.raises(FileError, match="cannot be written"):
        brdf.reproduce("images", tmp_path / "missing" / "out")


def test_an_unknown_document_names_the_known_ones() -> None:
    with pytest.raises(UnknownNameError, match="unknown document 'image': did you mean 'images'"):
        brdf.reproduce("image")


@pytest.mark.parametrize("name", ["short", "slice stack, baked at the nodes (ours)"])
def test_legends_stay_in_their_chart(name: str) -> None:
    figure = curves({f"{number} {name}": ([0, 1], [0, number]) for number in range(7)}, "x", "y")
    figure.draw_without_rendering()
    box, legend = figure.bbox, figure.legends[0].get_window_extent()
    assert box.x0 <= legend.x0
    assert legend.x1 <= box.x1
    assert legend.y1 <= figure.axes[0].get_window_extent().y0
