"""Tracing: inputs, names, and refusal of branches."""

from __future__ import annotations

import pytest

from brdf import models
from brdf.errors import FormulaError
from brdf.formula import dot, normalize
from brdf.formula.trace import component_names, parameter_values, trace
from brdf.models.model import REGISTRY
from brdf.parameters import albedo


def test_locals_keep_their_names():
    program = trace(models.Microfacet(fresnel="conductor"))
    names = set(program.graph.names.values())
    assert {"h_x", "h_y", "h_z", "D", "F_x", "F_z", "stretched", "cos2"} <= names
    by_name = {name: node for node, name in program.graph.names.items()}
    assert by_name["cos2"].op == "mul"
    assert by_name["D"].op == "div"


def test_a_method_called_twice_names_its_locals_twice():
    names = [*trace(models.SGD()).graph.names.values()]
    assert names.count("theta") == names.count("log_z_x") == 2


def test_parameters_come_in_the_order_of_their_values():
    m = models.Microfacet(fresnel="conductor", alpha_x=0.1, alpha_y=0.3, k=(1, 2, 3)) + 0.5 * models.Lambertian()
    program = trace(m)
    names = [n for name, size in program.parameters for n in component_names(name, size)]
    values = dict(zip(names, parameter_values(m.values), strict=True))
    assert values["lobe1_alpha_y"] == 0.3
    assert values["lobe1_k_b"] == 3.0
    assert values["lobe2_scale_g"] == 0.5


def test_a_formula_that_branches_is_refused():
    class Branching(models.Model):
        """Breaks the rule."""

        tint = albedo("colour")

        def f(self, wi, wo):
            return self.tint if dot(wi, wo) > 0 else -self.tint

    REGISTRY.pop("Branching")
    with pytest.raises(FormulaError, match="use where"):
        trace(Branching())


def test_a_formula_that_returns_a_scalar_is_refused():
    class Scalar(models.Model):
        """Returns one number."""

        tint = albedo("colour")

        def f(self, wi, wo):
            return dot(wi, normalize(wo))

    REGISTRY.pop("Scalar")
    with pytest.raises(FormulaError, match="three components"):
        trace(Scalar())


def test_every_model_is_traced_to_three_outputs():
    for name in models.names():
        program = trace(models.get(name)())
        assert len(program.outputs) == 3
        assert isinstance(program.graph.names, dict)
