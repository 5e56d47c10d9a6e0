"""The document on published fits: its stand-ins are the networks, its numbers the metrics'."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import brdf
from brdf.metrics import METRICS
from brdf.reproduce.documents.fits import measuring, tables
from brdf.reproduce.documents.fits.measuring import METRIC, Score
from brdf.reproduce.documents.fits.settings import Settings
from helpers import random_directions
from networks import nbrdf

TINY = Settings(materials=3, fitted=0, pairs=1500, starts=1, pixels=12)


@pytest.fixture
def weights(data: Path, monkeypatch: pytest.MonkeyPatch) -> dict:
    monkeypatch.setenv("BRDF_DATA", str(data))
    found = measuring.network_weights()
    assert found is not None
    return dict(found)


def test_the_networks_are_those_of_the_tests(weights: dict) -> None:
    wi, wo = random_directions(300, 1, 0.1), random_directions(300, 2, 0.1)
    for name in ("red-plastic", "gold-metallic-paint"):
        np.testing.assert_allclose(
            measuring.network(weights, name)(wi, wo), nbrdf(weights, name, wi.copy(), wo), rtol=1e-5, atol=1e-7
        )


def test_published_rows_are_scored_in_every_metric(weights: dict, tmp_path: Path) -> None:
    report = brdf.reproduce("fits", tmp_path / "fits", settings=TINY)
    assert {table.name for table in report.tables} == {"errors", "winners", "winners-ngan", "materials", "people"}
    errors, winners = report.tables[:2]
    assert len(errors.rows) >= 12
    assert sum(row[1] for row in winners.rows) == 3
    assert (tmp_path / "fits" / "index.html").is_file()
    names = measuring.chosen(weights, 3)
    some = measuring.samples(measuring.network(weights, names[0]), TINY)
    m = brdf.materials.get(names[0], "bagher_sgd")
    cosine = some.wi[:, 2:]
    weight = some.weight[:, 0] / some.weight[:, 0].sum()
    score = measuring.measured(weights, Settings(materials=3, fitted=0, pairs=1500))[0]
    values = some.values * cosine, m(some.wi, some.wo) * cosine
    row = next(s for s in measuring.measured(weights, TINY) if s.material == names[0] and s.fit == "bagher_sgd")
    assert row.published[METRIC] == pytest.approx(METRICS[METRIC](*values, weight), rel=1e-5)
    assert score.ours is None


def test_without_the_networks_a_sentence_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("BRDF_DATA", raising=False)
    report = brdf.reproduce("fits", tmp_path / "fits", settings=TINY)
    assert report.sections[0].text.startswith("Nothing was measured")


def test_verdicts_follow_from_the_scores() -> None:
    def score(fit: str, published: float, ours: float) -> Score:
        errors = [dict.fromkeys(METRICS, value) for value in (published, ours)]
        return Score("x", fit, *errors)

    report = brdf.reproduce.Report("fits", "", "")
    report.section("")
    tables.claims(report, [score("ngan_ward", 0.1, 0.05), score("ngan_lafortune", 0.2, 0.3)])
    first, second = report.claims
    assert first.verdict == "holds"
    assert second.verdict == "does not hold"
    assert "1 of 2 cases (50.0%)" in next(iter(second.checks))


def test_metrics_stand_beside_people() -> None:
    """One metric in the order of the published judgements, one in the opposite order."""
    order = list(tables.PEOPLE)
    errors = [dict.fromkeys(measuring.EVERY, 1.0 + k) | {METRIC: 9.0 - k} for k in range(len(order))]
    scores = [Score("x", fit, row, None) for fit, row in zip(order, errors, strict=True)]
    report = brdf.reproduce.Report("fits", "", "")
    report.section("")
    tables.people(report, scores)
    (table,) = report.tables
    assert [row[0] for row in table.rows[:-1]] == order
    last = dict(zip([c.title for c in table.columns], table.rows[-1], strict=True))
    assert last[METRIC] == pytest.approx(-1)
    assert last[measuring.AROUND] == pytest.approx(1)
