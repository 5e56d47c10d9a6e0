"""`brdf reproduce`."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import pytest

from brdf.reproduce import Column, Report
from brdf.reproduce.documents import images
from brdf.reproduce.documents.images.settings import Settings

Command = Callable[..., Any]


def few(report: Report, settings: Settings) -> None:
    report.section("s")
    report.table("t", "A table", ["way", Column("error", "dB", ".1f", "ours")], [["a", 1.25]])
    report.table("long", "A long table", ["way"], [[str(number)] for number in range(99)])
    report.claim("It holds", {"1.25": settings.materials is not None})


def test_it_prints_tables_and_claims(brdf: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(images, "run", few)
    outcome = brdf("reproduce", "images", "--quick", "-o", "out")
    assert outcome.code == 0, outcome
    assert "way  error, dB" in outcome.out
    assert "99 rows, see index.html" in outcome.out
    assert "“It holds”: holds\n  yes  1.25" in outcome.out
    assert outcome.out.strip().endswith("out/index.html")
    again = brdf("reproduce", "images", "-o", "out", "--force", "--json")
    assert json.loads(again.out)["tables"]["t"]["rows"] == [["a", 1.25]]
    assert json.loads(again.out)["claims"][0]["verdict"] == "does not hold"


def test_it_lists_the_documents(brdf: Command) -> None:
    assert "images" in json.loads(brdf("reproduce", "--list", "--json").out)
    assert "Image-based isotropic reflectance" in brdf("reproduce", "--list").out


def test_mistakes_are_one_line(refused: Callable[..., str]) -> None:
    assert "give the document to reproduce: fits, images" in refused("reproduce")
    assert "did you mean 'images'" in refused("reproduce", "imagse")
