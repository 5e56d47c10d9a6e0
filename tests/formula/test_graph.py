"""The graph: sharing, folding, simplification, and what it refuses."""

from __future__ import annotations

import math

import pytest

from brdf.errors import FormulaError
from brdf.formula import Vec, exp, maximum, sqrt, texture2d, where
from brdf.formula.graph import Graph, TextureRef


@pytest.fixture
def graph():
    return Graph()


def test_equal_expressions_are_one_node(graph):
    x, y = graph.symbol("x"), graph.symbol("y")
    assert x + y is y + x
    assert sqrt(x * y) is sqrt(y * x)
    assert x - y is not y - x


def test_constants_fold(graph):
    value = exp(graph.constant(0.5) * 2.0)
    assert value.op == "constant"
    assert value.value == math.exp(1.0)


@pytest.mark.parametrize(
    "simplify",
    [
        lambda x: x + 0.0,
        lambda x: 0.0 + x,
        lambda x: x - 0.0,
        lambda x: x * 1.0,
        lambda x: x / 1.0,
        lambda x: (-x).__neg__(),
        lambda x: x**1,
    ],
)
def test_what_does_nothing_is_dropped(graph, simplify):
    x = graph.symbol("x")
    assert simplify(x) is x


def test_whole_powers_are_products(graph):
    x = graph.symbol("x")
    assert x**2 is x * x
    assert x**5 is (x * x) * (x * x) * x
    assert (x**-1).op == "div"
    assert (x**2.5).op == "pow"
    assert (x**40).op == "pow"


def test_branching_says_to_use_where(graph):
    x = graph.symbol("x")
    with pytest.raises(FormulaError, match="use where"):
        bool(x > 0)
    assert where(x > 0, x, -x).op == "where"


def test_numpy_functions_are_refused(graph):
    with pytest.raises(FormulaError, match=r"brdf\.formula"):
        math.sqrt(graph.symbol("x"))


def test_foreign_objects_are_refused(graph):
    with pytest.raises(FormulaError, match="str"):
        graph.symbol("x") + "1"


def test_vectors_and_scalars_mix(graph):
    x = graph.symbol("x")
    v = x * Vec(1.0, 2.0, x)
    assert v.x is x
    assert v.z is x * x
    assert (1.0 - v).y is 1.0 - x * 2.0
    with pytest.raises(ValueError, match="components"):
        Vec(1.0, 2.0) + Vec(1.0, 2.0, 3.0)


def test_texture_wants_a_coordinate_an_axis(graph):
    reference = TextureRef("t", (4, 5, 3))
    x = graph.symbol("x")
    assert len(texture2d(reference, x, maximum(x, 0.5))) == 3
    with pytest.raises(FormulaError, match="one coordinate an axis"):
        graph.texture(reference, x)
