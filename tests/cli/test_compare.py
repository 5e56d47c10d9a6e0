"""`brdf compare`: numbers, tables, the figure, remarks."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

import brdf as package

Command = Callable[..., Any]

A, B, C = "Lambertian:albedo=.5", "Lambertian:albedo=.45", "GGX:alpha=.3"


def test_two_are_compared_in_every_metric(brdf: Command) -> None:
    out = brdf("compare", A, B, "--no-figure").out
    c = package.compare(package.load(A), package.load(B))
    assert f"{A} → {B}" in out.splitlines()[0]
    for what, value in c.rows():
        assert any(line.startswith(what) and line.endswith(value) for line in out.splitlines()), what


def test_several_are_ranked(brdf: Command, tmp_path: Path) -> None:
    lines = brdf("compare", A, C, B, A, "--no-figure").out.splitlines()
    assert lines[0].startswith(A)
    assert [line.split()[0] for line in lines[3:]] == [A, B, C]
    assert "inf" in lines[3]
    assert list(tmp_path.iterdir()) == []


def test_json_has_everything(brdf: Command, tmp_path: Path) -> None:
    found = json.loads(brdf("compare", A, B, C, "--json", "-o", "x.svg").out)
    assert found["reference"] == A
    assert found["file"] == "x.svg"
    assert [c["other"] for c in found["comparisons"]] == [B, C]
    expected = package.compare(package.load(A), package.load(C))
    assert found["comparisons"][1] == json.loads(json.dumps(expected.numbers()))
    assert len(found["comparisons"][1]["psnr_by_angle"]) == len(found["light_angles"])


def test_the_figure_is_written_under_the_name_of_the_reference(brdf: Command, tmp_path: Path) -> None:
    outcome = brdf("compare", "gold-metallic-paint", B)
    path = tmp_path / "gold-metallic-paint-compared.png"
    assert outcome.out.splitlines()[-1] == str(path)
    with Image.open(path) as picture:
        assert picture.width == 600


@pytest.mark.parametrize("extension", ["svg", "pdf", "html"])
def test_the_figure_in_other_formats(brdf: Command, tmp_path: Path, extension: str) -> None:
    assert brdf("compare", A, B, "-o", f"x.{extension}").code == 0
    assert (tmp_path / f"x.{extension}").stat().st_size > 1000


def test_fits_of_one_material_are_told_apart(brdf: Command) -> None:
    fit = "gold-metallic-paint@ngan_ward"
    assert f"gold-metallic-paint → {fit}" in brdf("compare", "gold-metallic-paint", fit, "--no-figure").out


def test_a_figure_of_many_shows_the_nearest(brdf: Command) -> None:
    many = [f"Lambertian:albedo=.{k}" for k in range(1, 8)]
    outcome = brdf("compare", "Lambertian:albedo=.9", *many)
    assert outcome.code == 0
    assert outcome.err == "brdf: the figure shows the nearest 6 of 7 materials\n"
    assert len(outcome.out.splitlines()) == 3 + 7 + 1


@pytest.mark.parametrize(
    ("material", "said"),
    [("Mirror", "Mirror mirrors like a polished surface"), ("SmoothDielectric", "SmoothDielectric transmits")],
)
def test_what_a_comparison_does_not_show_is_said(brdf: Command, material: str, said: str) -> None:
    outcome = brdf("compare", material, material, "--no-figure")
    assert outcome.code == 0
    assert said in outcome.err
