"""Derivatives of traced formulas against central differences of the formulas themselves."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest

import brdf
from brdf.formula import derivative as derivative_module
from brdf.formula import ops
from brdf.formula.backends import backend_of
from brdf.formula.derivative import derivative
from brdf.formula.graph import Expr, Graph, TextureRef
from brdf.formula.textures import lookup
from brdf.formula.trace import component_names, parameter_values, trace
from helpers import random_directions

WI, WO = random_directions(200, 3, 0.05), random_directions(200, 4, 0.05)


def value_of(
    nodes: tuple[Expr, ...], symbols: dict[str, np.ndarray], textures: Mapping[str, np.ndarray] = {}
) -> list[np.ndarray]:
    """Evaluates graph nodes on NumPy."""
    known: dict[Expr, object] = {}
    special = {
        "add": lambda a, b: a + b, "sub": lambda a, b: a - b, "mul": lambda a, b: a * b, "div": lambda a, b: a / b,
        "neg": lambda a: -a, "lt": lambda a, b: a < b, "le": lambda a, b: a <= b, "and": lambda a, b: a & b,
        "or": lambda a, b: a | b, "not": np.logical_not,
    }  # fmt: skip
    for node in nodes[0].graph.nodes:
        if node.op in ("constant", "symbol"):
            known[node] = node.value if node.op == "constant" else symbols[node.value]
        elif node.op == "texture":
            coordinates = tuple(np.asarray(known[a]) for a in node.args)
            known[node] = lookup(textures[node.value.name], coordinates, backend_of())
        elif node.op == "channel":
            known[node] = known[node.args[0]][node.value]
        else:
            function = special.get(node.op) or getattr(ops, node.op)
            with np.errstate(all="ignore"):
                known[node] = function(*(known[a] for a in node.args))
    return [np.asarray(known[node], float) for node in nodes]


M = brdf.models
REFLECTANCES = {name: M.get(name) for name in M.names()} | {
    "anisotropic conductor": lambda: M.Microfacet(fresnel="conductor", alpha_x=0.2, alpha_y=0.4),
    "beckmann": lambda: M.Microfacet(ndf="beckmann", fresnel="dielectric", alpha=0.3),
}


@pytest.mark.parametrize("name", REFLECTANCES)
def test_derivatives_equal_central_differences(name):
    m = REFLECTANCES[name]()
    program = trace(m)
    names = [n for name, size in program.parameters for n in component_names(name, size)]
    values = dict(zip(names, parameter_values(m.values), strict=True))
    symbols = {f"{w}_{axis}": d[:, i] for w, d in (("wi", WI), ("wo", WO)) for i, axis in enumerate("xyz")}
    in_graph = {node.value: node for node in program.graph.nodes if node.op == "symbol"}
    for parameter in names:
        if parameter not in in_graph:
            continue
        exact = value_of(derivative(program.outputs, in_graph[parameter]), symbols | values, m.textures)
        step = 1e-6 * max(1e-2, abs(values[parameter]))
        high, low = (
            value_of(program.outputs, symbols | values | {parameter: values[parameter] + sign * step}, m.textures)
            for sign in (1, -1)
        )
        for channel in range(3):
            numeric = (high[channel] - low[channel]) / (2 * step)
            scale = np.abs(numeric) + 1e-4 * np.abs(
                high[channel] / values[parameter] if values[parameter] else high[channel]
            )
            error = np.abs(exact[channel] - numeric) / (scale + 1e-7)
            assert np.quantile(error, 0.98) < 2e-4, parameter  # kinks (clips) between the two steps are left out


UNARY = {"sqrt": 0.7, "exp": 0.7, "log": 0.7, "sin": 0.7, "cos": 0.7, "tan": 0.7, "asin": 0.7, "acos": 0.7, "atan": 0.7,
         "abs": -0.7, "erf": 0.7, "neg": 0.7}  # fmt: skip


def test_every_rule_is_right():
    """Each rule by itself at a point, so that none hides behind a model that does not use it."""
    tested = set(UNARY)
    h = 1e-6
    for op, at in UNARY.items():
        graph = Graph()
        x = graph.symbol("x")
        y = graph.call(op, x)
        exact, high, low = (
            value_of(nodes, {"x": np.array(v)})[0]
            for nodes, v in ((derivative((y,), x), at), ((y,), at + h), ((y,), at - h))
        )
        np.testing.assert_allclose(exact, (high - low) / (2 * h), rtol=1e-8, err_msg=op)
    for op in ("add", "sub", "mul", "div", "pow", "atan2", "minimum", "maximum"):
        graph = Graph()
        x = graph.symbol("x")
        y = graph.call(op, x * x + 0.3, 2.0 - x)
        exact, high, low = (
            value_of(nodes, {"x": np.array(v)})[0]
            for nodes, v in ((derivative((y,), x), 0.7), ((y,), 0.7 + h), ((y,), 0.7 - h))
        )
        np.testing.assert_allclose(exact, (high - low) / (2 * h), rtol=1e-8, err_msg=op)
        tested.add(op)
    tested.add("where")
    graph = Graph()
    x = graph.symbol("x")
    slope = derivative((graph.call("where", x < 1.0, x * x, 3.0 * x),), x)
    assert [value_of(slope, {"x": np.array(v)})[0] for v in (0.5, 2.0)] == [1.0, 3.0]
    assert tested == set(derivative_module._RULES)


@pytest.mark.parametrize("place", [0.05, 0.3, 0.61, 0.8, 1.2])
def test_derivative_of_a_lookup_is_the_slope_of_the_interpolation(place):
    data = np.random.default_rng(0).random((8, 3, 2))
    graph = Graph()
    x = graph.symbol("x")
    fetched = tuple(graph.texture(TextureRef("t", data.shape), x * x, 0.5 * x))
    exact = value_of(derivative(fetched, x), {"x": np.array(place)}, {"t": data})
    high, low = (value_of(fetched, {"x": np.array(place + step)}, {"t": data}) for step in (1e-6, -1e-6))
    np.testing.assert_allclose(exact, (np.array(high) - low) / 2e-6, rtol=1e-7, atol=1e-9)
    assert np.all(np.abs(exact) > 0.01) or place < 0.1  # in the margin both coordinates are clamped
