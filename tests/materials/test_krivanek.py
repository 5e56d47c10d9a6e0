"""The lecture's table of albedos: values as printed in it, documented as shipped."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from brdf.errors import UnknownNameError
from brdf.materials import krivanek, providers

UP = np.array([0.0, 0.0, 1.0])


@pytest.mark.parametrize(
    ("name", "percent"),
    [
        ("espresso-maker", 3.2),
        ("recycle-bin", (1, 5, 25)),
        ("wood", (65, 41.5, 26.5)),
        ("wood@low", (50, 30, 19)),
        ("plant-leaf-yellow@high", (31, 42, 16)),
        ("light-switch-cover-top@across", 9.3),
    ],
)
def test_reflects_what_was_measured(name: str, percent: object) -> None:
    m = providers.get(krivanek.PREFIX + name)
    np.testing.assert_allclose(m(UP, UP), np.broadcast_to(np.asarray(percent) / 100 / np.pi, 3), rtol=1e-12)
    np.testing.assert_allclose(m.albedo(UP), np.broadcast_to(np.asarray(percent) / 100, 3), rtol=1e-6)
    assert "Krivanek2009" in m.source


def test_the_glossy_part_is_named_as_left_out() -> None:
    assert "total reflectance about 90 %" in krivanek.get("krivanek/espresso-maker").source
    assert "total" not in krivanek.get("krivanek/plate").source


def test_all_rows_are_materials_between_black_and_white() -> None:
    assert len(krivanek.names()) == 24
    for name in krivanek.names():
        for variant in krivanek.variants(name):
            albedo = providers.get(name, variant).values["albedo"]
            assert (albedo > 0).all()
            assert (albedo < 1).all()


def test_the_documented_table_is_the_shipped_one() -> None:
    text = (Path(__file__).parents[2] / "docs" / "krivanek.md").read_text("utf-8")
    assert krivanek.markdown() in text


def test_unknown_names() -> None:
    with pytest.raises(UnknownNameError, match="unknown variant of krivanek/wood 'hi'"):
        krivanek.get("krivanek/wood", "hi")
    with pytest.raises(UnknownNameError, match="did you mean 'krivanek/plate'"):
        krivanek.variants("krivanek/plat")
