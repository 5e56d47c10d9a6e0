"""Tables of one basis made into tables of another at twice the resolution: what that adds to the source's own error."""

from __future__ import annotations

from typing import NamedTuple

import pytest

import brdf
from brdf.metrics.importance import ErrorsAgainst, importance_pairs
from brdf.representations.baking.bake import bake_points
from brdf.representations.tables.layouts import BASES, named_layout, shape_of

N = 16
MATTE = "OrenNayar:albedo=.5,sigma=.5"
GLOSSY = "Lambertian:albedo=.3/.2/.1 + GGX:alpha=.3,F0=.04"

GRAZING = "marschner"
"""Its first axis ends where either direction grazes: the last cell holds all of grazing light at once."""


class Conversion(NamedTuple):
    """Relative RMS of f cos."""

    source: float  # of the source from the reflectance: its linear interpolation error
    converting: float  # of what it becomes, from the source
    direct: float  # of a table like that, baked from the reflectance


def conversion(text: str, source: str, target: str) -> Conversion:
    m, pairs = brdf.load(text), importance_pairs(8192, 5)
    layouts = [
        named_layout(basis, "bezier", shape_of(basis, n), "float32") for basis, n in ((source, N), (target, 2 * N))
    ]
    table = bake_points(m, layouts[0])
    made = bake_points(table, layouts[1])
    against, own = ErrorsAgainst(m, pairs), ErrorsAgainst(table, pairs)
    return Conversion(against(table)[0], own(made)[0], against(bake_points(m, layouts[1]))[0])


@pytest.mark.parametrize("text", [MATTE, GLOSSY])
@pytest.mark.parametrize("basis", BASES)
def test_within_a_basis_little_is_added(basis, text):
    found = conversion(text, basis, basis)
    assert found.converting < 0.3 * found.source


@pytest.mark.parametrize("target", [basis for basis in BASES if basis != GRAZING])
@pytest.mark.parametrize("source", BASES)
def test_a_smooth_reflectance_is_converted_within_the_interpolation_error(source, target):
    found = conversion(MATTE, source, target)
    assert found.converting < found.source


@pytest.mark.parametrize("target", [basis for basis in BASES if basis != GRAZING])
@pytest.mark.parametrize("source", BASES)
def test_a_glossy_one_within_that_of_the_source_or_of_the_target(source, target):
    """No basis holds what fits another one: the error is bounded by the coarser of the two grids."""
    found = conversion(GLOSSY, source, target)
    assert found.converting < 1.25 * max(found.source, found.direct)
    assert found.converting < found.source or found.direct > found.source


@pytest.mark.parametrize("source", ["half", "stark"])
def test_the_grazing_cell_is_what_marschners_grid_lacks(source):
    """Into it a conversion costs more than the source has lost, as much as baking there directly does."""
    found = conversion(GLOSSY, source, GRAZING)
    assert found.source < found.converting < 1.25 * found.direct
