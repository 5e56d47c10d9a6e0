"""Turned and transposed reflectances: the same values at other directions."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.representations.synthetic_rgl import tensors

import brdf
from brdf.combinators import QuarterTurned, SpatiallyVarying, Transposed
from brdf.errors import ReflectanceError
from brdf.models import GGX, Mirror, OpenPBR, SmoothDielectric
from brdf.representations.adaptive import Adaptive
from helpers import random_directions

WI, WO = random_directions(200, 1), random_directions(200, 2)
ACROSS, ALONG = GGX(alpha_x=0.15, alpha_y=0.4), GGX(alpha_x=0.4, alpha_y=0.15)


def test_a_quarter_turn_exchanges_the_widths() -> None:
    np.testing.assert_allclose(QuarterTurned(ACROSS)(WI, WO), ALONG(WI, WO), rtol=1e-9)


def test_the_tangent_turns_towards_the_bitangent() -> None:
    m = Adaptive(tensors())
    turned = np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])  # rows: where x, y and z go
    np.testing.assert_allclose(QuarterTurned(m)(WI @ turned, WO @ turned), m(WI, WO), rtol=1e-6)
    np.testing.assert_allclose(QuarterTurned(m).raw(WI @ turned, WO @ turned), m.raw(WI, WO), rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize("m", [OpenPBR(coat_weight=0.5), Adaptive(tensors())], ids=["formula", "measurement"])
def test_light_and_viewer_are_exchanged(m: brdf.Reflectance) -> None:
    np.testing.assert_allclose(Transposed(m)(WI, WO), m(WO, WI), rtol=1e-6)
    assert np.abs(m(WI, WO) / m(WO, WI) - 1).max() > 0.01


def test_what_varies_varies_on() -> None:
    m, uv = SpatiallyVarying(GGX(), alpha=[[0.1, 0.4]]), np.random.default_rng(1).random((200, 2))
    np.testing.assert_allclose(QuarterTurned(m)(WI, WO, uv), m(WI, WO, uv), rtol=1e-9)


def test_it_is_saved_and_read(tmp_path: Path) -> None:
    QuarterTurned(ACROSS).save(tmp_path / "m.safetensors")
    read = brdf.load(tmp_path / "m.safetensors")
    assert not read.isotropic
    np.testing.assert_allclose(read(WI, WO), ALONG(WI, WO), rtol=1e-6)


@pytest.mark.parametrize("m", [Mirror(), SmoothDielectric()])
def test_only_values_are_moved(m: brdf.Reflectance) -> None:
    with pytest.raises(ReflectanceError, match="transmits or mirrors; only values can be moved"):
        QuarterTurned(m)
