"""The figure of tables that were tried: what it marks."""

from __future__ import annotations

import pytest

from brdf import plot
from brdf.errors import ParameterError
from brdf.metrics import Errors
from brdf.models import Lambertian
from brdf.representations.baking.budget import Candidate, Search
from brdf.representations.tables.table import Table


def search(size, errors):
    """A search of made-up errors, best first."""
    tried = tuple(Candidate(name, size - k, Errors(*e), lambda: None) for k, (name, e) in enumerate(errors.items()))
    return Search("made up", size, tried, Table.bake(Lambertian(albedo=0.5), shape=4))


SEARCHES = [
    search(1024, {"adaptive half": (1e-3, 1e-4), "bezier, half": (1e-2, 1e-3), "bezier measured, half": (5e-3, 2e-3)}),
    search(4096, {"adaptive half": (1e-4, 1e-5), "bezier, half": (4e-3, 4e-4), "stack": (2e-4, 5e-6)}),
]


def test_kinds_are_joined_by_the_best_of_each_budget():
    relative, display = plot.candidates(SEARCHES).axes
    lines = {axes: {line.get_label(): line for line in axes.get_lines()} for axes in (relative, display)}
    assert list(lines[relative]["bezier"].get_ydata()) == [5e-3, 4e-3]
    assert list(lines[display]["bezier"].get_ydata()) == [1e-3, 4e-4]
    assert list(lines[relative]["chosen"].get_ydata()) == [1e-3, 1e-4]
    assert sorted(lines[display]["frontier"].get_ydata()) == [5e-6, 1e-5, 1e-4, 1e-3, 2e-3]
    assert relative.get_yscale() == display.get_xscale() == "log"


def test_one_search_alone_is_drawn_and_none_is_refused():
    assert len(plot.candidates(SEARCHES[0]).axes) == 2
    with pytest.raises(ParameterError, match="at least one search"):
        plot.candidates([])
