"""Declared parameters: what is accepted, what is refused and with which words, what follows what."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from brdf import Reflectance
from brdf.errors import ParameterError, UnknownNameError
from brdf.formula import Vec, texture1d
from brdf.models import GGX, SGD, Lambertian, Microfacet, OrenNayar
from brdf.models.terms import ndf
from brdf.parameters import Parameter, Parameterised, Texture, choice, number, rgb, texture, width


class Lobe(Parameterised):
    """Two widths after a leader, a colour and a bare number."""

    alpha = width("width", default=0.2)
    alpha_x = width("width along x", follows="alpha")
    alpha_y = width("width along y", follows="alpha")
    tint = rgb("colour", default=(0.1, 0.2, 0.3), low=0.0)
    order = number("order", default=2.0, low=-1.0, high=5.0, unit="1/m")


def test_defaults_and_types() -> None:
    lobe = Lobe()
    assert lobe.alpha == 0.2
    assert type(lobe.order) is float
    assert lobe.tint.dtype == np.float64
    np.testing.assert_array_equal(lobe.tint, [0.1, 0.2, 0.3])
    assert list(lobe.values) == ["alpha", "tint", "order"]


def test_one_number_means_all_three() -> None:
    np.testing.assert_array_equal(Lobe(tint=0.7).tint, [0.7, 0.7, 0.7])
    np.testing.assert_array_equal(Lobe(tint=np.float32(0.5)).tint, [0.5, 0.5, 0.5])


def test_values_cannot_be_changed_in_place() -> None:
    given = np.array([0.1, 0.2, 0.3])
    lobe = Lobe(tint=given)
    given[0] = 9
    assert lobe.tint[0] == 0.1
    with pytest.raises(ValueError, match="read-only"):
        lobe.tint[0] = 0.5


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"order": 5.5}, r"order must lie in \[-1, 5\], got 5.5"),
        ({"order": -2}, r"order must lie in \[-1, 5\], got -2"),
        ({"order": float("nan")}, r"order must lie in \[-1, 5\], got nan"),
        ({"tint": (0.1, float("nan"), 0.3)}, r"tint must lie in \[0, inf\), got \(0.1, nan, 0.3\)"),
        ({"tint": (0.1, -0.2, 0.3)}, r"tint must lie in \[0, inf\), got \(0.1, -0.2, 0.3\)"),
        ({"tint": (0.1, 0.2)}, r"tint must be a number or 3 numbers, got shape \(2,\)"),
        ({"tint": np.ones((3, 3))}, r"tint must be a number or 3 numbers, got shape \(3, 3\)"),
        ({"tint": "red"}, "tint must be a number or 3 numbers, got 'red'"),
        ({"tint": [[1, 2], [3]]}, r"tint must be a number or 3 numbers, got \[\[1, 2\], \[3\]\]"),
        ({"order": (1, 2, 3)}, r"order must be a number, got shape \(3,\)"),
        ({"order": 1j}, "order must be a number, got 1j"),
        ({"alpha": 0.0}, r"alpha must lie in \[0.0001, 1\], got 0"),
        ({"alpha": 0.1, "alpha_x": 0.2, "alpha_y": 0.3}, "alpha has no effect beside alpha_x and alpha_y"),
    ],
)
def test_refusals(given: dict[str, object], message: str) -> None:
    with pytest.raises(ParameterError, match=f"^{message}$"):
        Lobe(**given)


def test_infinity_lies_within_open_bounds_only() -> None:
    with pytest.raises(ParameterError, match="order must lie in"):
        Lobe(order=float("inf"))


def test_unknown_parameter_offers_the_nearest() -> None:
    with pytest.raises(UnknownNameError, match=r"^unknown parameter of Lobe 'alpa': did you mean 'alpha'"):
        Lobe(alpa=0.1)
    with pytest.raises(UnknownNameError, match=r"^unknown parameter of Lambertian 'x': known: albedo.$"):
        Lambertian(x=1)


def test_followers_take_the_leader_s_value() -> None:
    assert (Lobe(alpha=0.4).alpha_x, Lobe(alpha=0.4).alpha_y) == (0.4, 0.4)
    half = Lobe(alpha=0.4, alpha_x=0.1)
    assert (half.alpha_x, half.alpha_y) == (0.1, 0.4)
    both = Lobe(alpha_x=0.1, alpha_y=0.3)
    assert both.values.keys() == {"alpha_x", "alpha_y", "tint", "order"}
    with pytest.raises(AttributeError, match="alpha"):
        _ = both.alpha


def test_isotropy_follows_the_widths() -> None:
    assert GGX(alpha=0.3).isotropic
    assert GGX(alpha_x=0.3, alpha_y=0.3).isotropic
    assert not GGX(alpha=0.3, alpha_x=0.1).isotropic


def test_parts_bring_their_parameters() -> None:
    m = Microfacet(ndf="beckmann", alpha=0.3, fresnel="conductor", k=3.0)
    assert m.choices == {"ndf": "beckmann", "masking": "smith", "fresnel": "conductor"}
    assert m.ndf == "beckmann"
    assert m.alpha == m.alpha_x == 0.3
    np.testing.assert_array_equal(m.k, [3, 3, 3])
    assert set(m.values) == {"alpha", "eta", "k"}
    assert set(m.declarations()) == {"alpha", "alpha_x", "alpha_y", "eta", "k"}


def test_parameters_of_the_other_choice() -> None:
    with pytest.raises(ParameterError, match=r"^k has no effect with fresnel='schlick'; it belongs to fresnel='conduc"):
        Microfacet(k=3.0)
    with pytest.raises(ParameterError, match=r"^F0 has no effect with fresnel='dielectric'; it belongs"):
        Microfacet(fresnel="dielectric", F0=0.04)


@pytest.mark.parametrize("wrong", ["gx", 3, None, ["ggx"]])
def test_unknown_option(wrong: object) -> None:
    with pytest.raises(UnknownNameError, match=r"^unknown ndf "):
        Microfacet(ndf=wrong)


def test_replaced_values() -> None:
    m = SGD(kd=0.3)
    changed = m.replaced(kd=(0.1, 0.2, 0.3), p=0.7)
    np.testing.assert_array_equal(changed.kd, [0.1, 0.2, 0.3])
    np.testing.assert_array_equal(changed.p, 0.7)
    np.testing.assert_array_equal(changed.K, m.K)
    np.testing.assert_array_equal(m.kd, 0.3)
    with pytest.raises(ParameterError, match="kd must lie in"):
        m.replaced(kd=2)


def test_replaced_leaders_and_followers() -> None:
    assert GGX(alpha=0.2).replaced(alpha_x=0.1, alpha_y=0.3).values.keys() == {"alpha_x", "alpha_y", "F0"}
    assert GGX(alpha_x=0.1, alpha_y=0.3).replaced(alpha=0.2).alpha_x == 0.2
    assert GGX(alpha=0.1, alpha_x=0.3).replaced(alpha_y=0.2).values.keys() == {"alpha_x", "alpha_y", "F0"}
    assert GGX(alpha_x=0.1, alpha_y=0.3).replaced(alpha_y=0.2).alpha_x == 0.1
    assert GGX(alpha=0.1).replaced(alpha_x=0.3).alpha_y == 0.1


def test_replaced_choice_forgets_the_old_part_and_keeps_the_others() -> None:
    m = Microfacet(alpha=0.3, F0=0.9).replaced(fresnel="dielectric", eta=1.7)
    assert (m.alpha, m.eta) == (0.3, 1.7)
    assert OrenNayar(sigma=0.7).replaced(interreflection="included").sigma == 0.7


def test_structure_tells_formulas_apart() -> None:
    assert GGX(alpha=0.2).structure == GGX(alpha=0.3).structure
    assert GGX(alpha=0.2).structure != GGX(alpha_x=0.2, alpha_y=0.3).structure
    assert Microfacet().structure != Microfacet(fresnel="dielectric").structure
    assert OrenNayar().structure != OrenNayar(interreflection="included").structure


def test_repr_shows_choices_and_values() -> None:
    assert repr(Lambertian(albedo=(0.1, 0.2, 0.3))) == "Lambertian(albedo=(0.1, 0.2, 0.3))"
    assert repr(GGX(alpha=0.2, F0=1.0)) == "GGX(alpha=0.2, F0=(1, 1, 1))"
    shown = repr(Microfacet(ndf="beckmann"))
    assert shown == "Microfacet(ndf='beckmann', masking='smith', fresnel='schlick', alpha=0.2, F0=(0.04, 0.04, 0.04))"


def test_declarations_are_documented() -> None:
    assert isinstance(Lobe.order, Parameter)
    assert (Lobe.order.unit, Lobe.order.low, Lobe.order.high, Lobe.order.name) == ("1/m", -1.0, 5.0, "order")
    assert ndf.GGX.alpha_x.follows == "alpha"


def test_a_parameter_named_like_a_method_can_be_called() -> None:
    for m in (Lambertian(albedo=(0.2, 0.5, 0.7)), OrenNayar(albedo=(0.2, 0.5, 0.7), sigma=0.0)):
        np.testing.assert_array_equal(m.albedo, (0.2, 0.5, 0.7))
        albedo = m.albedo([[0.0, 0.0, 1.0], [0.6, 0.0, 0.8]])
        np.testing.assert_allclose(albedo, [(0.2, 0.5, 0.7)] * 2, rtol=1e-6)
    assert (0.5 * m).replaced(scale=0.25).scale[0] == 0.25


class Ramp(Parameterised):
    """A part with a texture that is given and one that follows from a number."""

    steepness = number("steepness", default=2.0)
    curve: Any = texture("values over the cosine", default=(0.0, 1.0), channels=1, low=0.0, high=4.0)

    def derived_textures(self) -> dict[str, np.ndarray]:
        return {"line": np.linspace(0, self.steepness, 5, dtype=np.float32)[:, None]}

    def value(self, cosine: Any) -> Any:
        return texture1d(self.curve, cosine)[0] + texture1d(self.line, cosine)[0]


class Ramped(Parameterised, Reflectance):
    """A reflectance that has textures through its part alone."""

    ramp: Any = choice("ramp", "ramp", {"ramp": Ramp, "none": None})

    def f(self, wi: Vec, wo: Vec) -> Vec:
        value = self.ramp.value(wo.z)
        return Vec(value, value, value)

    def _state(self) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
        return {}, {}


def test_textures_of_a_part_reach_the_formula_on_every_path() -> None:
    m = Ramped(curve=[1.0, 3.0], steepness=1.0)
    # samples lie at texel centres: 1 at 1/4, 3 at 3/4; the line runs from 0 at 1/10 to 1 at 9/10
    wo = np.array([0.8, 0.0, 0.6])
    expected = 1 + 2 * (0.6 - 0.25) / 0.5 + (0.6 - 0.1) / 0.8
    np.testing.assert_allclose(m(wo, wo), expected, rtol=1e-6)
    many = np.tile(wo, (30_000, 1))
    np.testing.assert_allclose(m(many, many), expected, rtol=1e-6)
    both = 0.5 * m + m
    np.testing.assert_allclose(both(wo, wo), 1.5 * expected, rtol=1e-6)
    np.testing.assert_allclose(both(many, many)[-1], 1.5 * expected, rtol=1e-6)
    assert m.textures.keys() == {"curve", "line"}
    assert m.given_textures.keys() == {"curve"}
    np.testing.assert_array_equal(m.curve[:, 0], [1, 3])


def test_textures_shape_the_structure_and_survive_replacement() -> None:
    m = Ramped(curve=[1.0, 3.0], steepness=1.0)
    assert m.structure == Ramped(curve=[0.0, 2.0], steepness=4.0).structure
    assert m.structure != Ramped(curve=[0.0, 2.0, 3.0]).structure
    changed = m.replaced(steepness=3.0)
    np.testing.assert_array_equal(changed.curve, m.curve)
    assert changed.textures["line"][-1, 0] == 3
    assert repr(m) == "Ramped(ramp='ramp', steepness=1, curve=array(2, 1))"
    assert isinstance(Ramp.curve, Texture)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ([1.0, 5.0], r"curve must hold numbers in \[0, 4\]"),
        ([1.0, float("nan")], r"curve must hold numbers in \[0, 4\]"),
        ([1.0], r"curve must have shape \(n, 1\) with n >= 2, got \(1,\)"),
        (np.ones((4, 3)), r"curve must have shape \(n, 1\) with n >= 2, got \(4, 3\)"),
        (3.0, r"curve must have shape \(n, 1\) with n >= 2, got \(\)"),
        ("red", "curve must be an array of numbers, got str"),
        ([[1], [2, 3]], "curve must be an array of numbers, got list"),
    ],
)
def test_texture_refusals(given: object, message: str) -> None:
    with pytest.raises(ParameterError, match=f"^{message}$"):
        Ramped(curve=given)


def test_a_texture_of_the_other_choice() -> None:
    with pytest.raises(ParameterError, match=r"^curve has no effect with ramp='none'; it belongs to ramp='ramp'$"):
        Ramped(ramp="none", curve=[1, 2])


@pytest.mark.parametrize("name", ["alpha", "F0", "ndf"])
def test_a_parameter_cannot_be_assigned(name: str) -> None:
    m = GGX(alpha=0.2)
    with pytest.raises(AttributeError, match=rf"replaced\({name}="):
        setattr(m, name, 0.5)
    assert m.alpha == 0.2


@pytest.mark.parametrize("value", ["0.2", None, 1j, [None]])
def test_what_is_no_number_is_refused(value: object) -> None:
    with pytest.raises(ParameterError, match="alpha must be a number, got"):
        GGX(alpha=value)


def test_self_is_a_parameter_name_like_any_other() -> None:
    with pytest.raises(UnknownNameError, match="'self'"):
        GGX(self=3)
