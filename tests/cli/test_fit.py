"""`brdf fit`: what it prints and writes."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import brdf as package

Command = Callable[..., Any]
TRUTH = "Lambertian:albedo=.2 + Ward:ks=.3,alpha=.15"
DATA = "Lambertian:albedo=.3"


def test_the_fitted_material_is_written(brdf: Command, tmp_path: Path) -> None:
    outcome = brdf("fit", TRUTH, "--model", "Ward", "--budget", "2", "-o", "x.safetensors")
    assert outcome.code == 0
    assert "lobe2_alpha" in outcome.out
    assert "cosine-weighted L2" in outcome.out
    assert outcome.out.splitlines()[-1] == str(tmp_path / "x.safetensors")
    made = package.load(str(tmp_path / "x.safetensors"))
    assert made.values["lobe2_alpha"] == package.load(TRUTH).values["lobe2_alpha"] or (
        abs(made.values["lobe2_alpha"] - 0.15) < 1e-4
    )


def test_json_and_a_report(brdf: Command, tmp_path: Path) -> None:
    outcome = brdf("fit", TRUTH, "--model", "Ward", "--budget", "2", "--json", "--report", "r.html")
    found = json.loads(outcome.out)
    assert abs(found["parameters"]["lobe2_alpha"]["value"] - 0.15) < 1e-4
    assert found["report"] == "r.html"
    page = (tmp_path / "r.html").read_text("utf-8")
    assert page.startswith("<!DOCTYPE html>")
    assert page.count("<image") >= 9  # eight spheres and the map of residuals
    assert (tmp_path / found["file"]).is_file()


def test_files_are_named_after_what_was_given(brdf: Command, tmp_path: Path) -> None:
    package.load(TRUTH).save(tmp_path / "a.safetensors")
    for lobes in ("1", "2"):
        assert brdf("fit", "a.safetensors", "--model", "Ward", "--budget", "1", "--lobes", lobes).code == 0
    made = {path.name for path in tmp_path.iterdir()}
    assert made == {"a.safetensors", "a-Ward.safetensors", "a-Ward-2-lobes.safetensors"}


def test_photographs_of_a_ball(brdf: Command, data: Path, tmp_path: Path) -> None:
    outcome = brdf("fit", data / "spheres" / "diligent_ball", "--model", "Ward", "--budget", "2", "--json")
    found = json.loads(outcome.out)
    assert found["data"] == "diligent_ball"
    assert 0.01 < found["parameters"]["lobe2_alpha"]["value"] < 0.2


def test_mistakes(refused: Callable[..., str], tmp_path: Path) -> None:
    assert "did you mean 'Ward'" in refused("fit", TRUTH, "--model", "Wart")
    assert "--lobes must be 1 to 3 or auto, got 'many'" in refused("fit", TRUTH, "--model", "Ward", "--lobes", "many")
    assert "Missing option '--model'".lower() in refused("fit", TRUTH).lower()
    (tmp_path / "folder").mkdir()
    assert "folder: holds nothing to fit to" in refused("fit", "folder", "--model", "Ward")
    (tmp_path / "empty.binary").touch()
    assert "empty.binary" in refused("fit", "empty.binary", "--model", "Ward")
    assert "no such file" in refused("fit", "nowhere/x.binary", "--model", "Ward")
    refused("fit", TRUTH, "--model", "Ward", "-o", "nowhere/x.safetensors")
    refused("fit", TRUTH, "--model", "Ward", "--metric", "l7")
    assert "written as .safetensors" in refused("fit", TRUTH, "--model", "Ward", "-o", "r.png")
    for option, wrong in (("--lobes", "²"), ("--budget", "²"), ("--seed", "-1"), ("--jobs", "0"), ("--metric", "l7")):
        assert option.strip("-") in refused("fit", TRUTH, "--model", "Ward", option, wrong)
        assert option.strip("-") in refused("fit", TRUTH, DATA, "--model", "Ward", option, wrong)
    for nothing in ("", ","):
        assert "no model is named" in refused("fit", TRUTH, "--model", nothing)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["empty.binary", "folder"]


def test_several_make_a_folder_with_a_table_and_a_page(brdf: Command, tmp_path: Path) -> None:
    arguments = ("fit", TRUTH, DATA, "--model", "Ward,Lambertian", "--budget", "1")
    outcome = brdf(*arguments, "-o", "many")
    assert outcome.code == 0
    assert "nearest" in outcome.out
    page = (tmp_path / "many" / "index.html").read_text("utf-8")
    assert page.count("data:image/png") == 6  # two spheres of the data, four of the fits
    assert (tmp_path / "many" / "fits.csv").read_text("utf-8").count("\n") == 5
    assert "4 of 4 fits were there already" in brdf(*arguments, "-o", "many").out


def test_what_fails_is_told_when_the_rest_is_done(brdf: Command, tmp_path: Path) -> None:
    (tmp_path / "empty.binary").touch()
    outcome = brdf("fit", TRUTH, "empty.binary", "--model", "Ward", "--budget", "1", "-o", "many", "--json")
    assert outcome.code == 2
    assert "empty.binary" in outcome.err
    assert len(json.loads(outcome.out)["fits"]) == 1


def test_several_failures_are_told_in_order(brdf: Command, tmp_path: Path) -> None:
    for name in ("a.binary", "b.binary"):
        (tmp_path / name).touch()
    outcome = brdf("fit", "a.binary", "b.binary", "--model", "Ward", "-o", "many")
    assert (outcome.code, outcome.out) == (2, "")
    first, second, last = outcome.err.splitlines()
    assert first.startswith("brdf: a.binary, Ward: ")
    assert second.startswith("brdf: b.binary, Ward: ")
    assert last == "brdf: 2 of 2 fits failed, named above"


def test_files_of_one_name_are_told_apart(brdf: Command, tmp_path: Path) -> None:
    paths = [tmp_path / sub / "x.safetensors" for sub in ("s1", "s2")]
    for path, albedo in zip(paths, (0.2, 0.5), strict=True):
        path.parent.mkdir()
        package.models.Lambertian(albedo=albedo).save(path)
    outcome = brdf("fit", *paths, "--model", "Lambertian,Ward", "--budget", "1", "-o", "many", "--seed", "1")
    assert sum(int(line.split()[-1]) for line in outcome.out.splitlines()[2:4]) >= 2  # each is nearest to something
    page = (tmp_path / "many" / "index.html").read_text("utf-8")
    assert page.count("data:image/png") == 6
    assert all(f"<h3>{path}</h3>" in page for path in paths)
    rows = list(csv.DictReader((tmp_path / "many" / "fits.csv").read_text("utf-8").splitlines()))
    assert [row["path"] for row in rows] == [str(path) for path in paths for _ in range(2)]


def test_photographs_of_a_ball_among_many(brdf: Command, data: Path, tmp_path: Path) -> None:
    ball = data / "spheres" / "diligent_ball"
    outcome = brdf("fit", ball, DATA, "--model", "Ward", "--budget", "1", "-o", "many", "--jobs", "2", "--json")
    assert outcome.code == 0, outcome
    assert [one["data"] for one in json.loads(outcome.out)["fits"]] == ["diligent_ball", DATA]


def test_a_report_of_no_known_format_is_refused_before_the_work(brdf: Command, tmp_path: Path) -> None:
    outcome = brdf("fit", TRUTH, "--model", "Ward", "--report", "r.docx")
    assert outcome.code == 2
    assert "r.docx: figures are written as" in outcome.err
    assert not list(tmp_path.iterdir())
