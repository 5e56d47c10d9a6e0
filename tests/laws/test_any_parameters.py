"""Laws for parameters drawn within their declared bounds, for shipped rows, and for every representation."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

import brdf
from brdf import laws, materials, models
from brdf.parameters import Parameter
from brdf.reflectance import Reflectance

LAWS = {law.name: law for law in laws.ALL}
FEW = settings(
    max_examples=3, deadline=None, derandomize=True, database=None, suppress_health_check=list(HealthCheck),
    phases=[Phase.generate],  # a failure names its parameters; making them smaller would take minutes
)  # fmt: skip


def numbers(declared: Parameter, inside: bool) -> st.SearchStrategy[Any]:
    """Values within the bounds, the bounds among them unless `inside`; what has none stays within a tenth and ten."""
    low = declared.low if np.isfinite(declared.low) else 0.1
    high = declared.high if np.isfinite(declared.high) else max(10.0, 2 * low)
    if inside:
        span = min(high - low, 10.0)
        low, high = low + 0.05 * span, low + 0.95 * span
    one = st.floats(low, high, allow_nan=False)
    if inside:
        one = one.filter(lambda value: abs(value) > 1e-3)  # powers have their kink at 0
    return one if declared.size == 1 else st.tuples(*[one] * declared.size)


def drawn(model: type[models.Model], inside: bool = False) -> st.SearchStrategy[Reflectance]:
    """Models with a choice of each kind and every parameter that comes with it."""

    def with_values(choices: dict[str, str]) -> st.SearchStrategy[Reflectance]:
        declared = model(**choices).declarations()
        given_values = {
            k: numbers(p, inside) for k, p in declared.items() if p.follows is None and p.default is not None
        }
        return st.fixed_dictionaries(given_values).map(lambda values: model(**choices, **values))

    choices = {name: st.sampled_from(sorted(c.options)) for name, c in model._choices.items()}
    return st.fixed_dictionaries(choices).flatmap(with_values)


@pytest.mark.parametrize("law", ["positivity", "gradients", "pole"])
@pytest.mark.parametrize("name", models.names())
def test_law_holds_within_the_bounds(name: str, law: str) -> None:
    @FEW
    @given(drawn(models.get(name), inside=law == "gradients"))
    def holds(m: Reflectance) -> None:
        result = LAWS[law](m)
        assert result.status != "breaks", (m, result)

    holds()


@pytest.mark.parametrize("name", [n for n in models.names() if models.get(n).lossless is not None])
def test_promised_furnaces_are_white_whatever_else_is_chosen(name: str) -> None:
    @FEW
    @given(drawn(models.get(name)))
    def holds(m: Reflectance) -> None:
        result = LAWS["furnace"](m)
        assert result.passed, (m, result)

    holds()


@pytest.mark.parametrize("law", ["positivity", "reciprocity"])
def test_shipped_rows(law: str) -> None:
    for name in materials.names():
        if "bagher_sgd" in materials.fits(name):
            result = LAWS[law](materials.get(name, "bagher_sgd"))
            assert result.status == "holds", (name, result)


@pytest.fixture(scope="module")
def represented(data: Path) -> dict[str, Reflectance]:
    exact = 0.5 * models.Lambertian() + models.GGX(alpha=0.3)
    return {
        "Table": brdf.Table.bake(exact, shape=(32, 16, 16)),
        "SliceStack": brdf.SliceStack.bake(exact),
        "Adaptive": brdf.load(data / "rgl" / "cc_green_malachite_rgb.bsdf"),
        "Scattered": brdf.load(data / "gonio" / "cornell" / "garnet_red.brdf"),
    }


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("kind", ["Table", "SliceStack", "Adaptive", "Scattered"])
def test_representations(represented: dict[str, Reflectance], kind: str, law: str) -> None:
    result = LAWS[law](represented[kind])
    assert result.status == "holds", result
