"""Names, fits and provenance of the shipped materials."""

from __future__ import annotations

from importlib import resources

import numpy as np
import pytest

from brdf import materials
from brdf.errors import UnknownNameError
from brdf.materials import catalogue
from brdf.models import SGD
from brdf.reflectance import Reflectance


def test_the_hundred_names() -> None:
    names = catalogue.names()
    assert len(names) == 100
    assert names == sorted(set(names))
    assert {"gold-metallic-paint", "blue-metallic-paint2", "special-walnut-224", "teflon"} <= set(names)
    assert set(names) <= set(materials.names())
    assert all(materials.fits(name)[0] == "bagher_sgd" for name in names)


def test_a_row_is_the_published_one() -> None:
    m = materials.get("alum-bronze")
    assert isinstance(m, SGD)
    np.testing.assert_array_equal(m.kd, [0.0478786, 0.0313514, 0.0200638])
    np.testing.assert_array_equal(m.ks, [0.0364976, 0.664975, 0.268836])
    np.testing.assert_array_equal(m.F1, [5.05524, 0.182842, 0.476088])
    np.testing.assert_allclose(np.exp(m.log_c), [1.12717e-07, 1.06401e-07, 5.27952e-08], rtol=1e-12)


def test_huge_rates_survive() -> None:
    """Eight materials have c beyond single precision, one 1.6e109; all values handed to a kernel fit in it."""
    largest = {name: materials.get(name).log_c.max() for name in catalogue.names()}
    assert max(largest.values()) == pytest.approx(np.log(1.63655e109))
    assert sum(value > np.log(3.4e38) for value in largest.values()) >= 8
    for name in catalogue.names():
        for key, value in materials.get(name).values.items():
            assert np.isfinite(np.float32(value)).all(), (name, key)


def test_provenance() -> None:
    m = materials.get("gold-metallic-paint@bagher_sgd")
    assert m.name == "gold-metallic-paint@bagher_sgd"
    assert materials.get("gold-metallic-paint").name == "gold-metallic-paint"
    assert m.source.startswith("bagher_sgd: ")
    assert "Bagher2012" in m.source
    assert "9807fb3" in m.source
    assert (
        repr(m)
        == repr(materials.get("gold-metallic-paint"))
        == repr(materials.get("gold-metallic-paint", "bagher_sgd"))
    )
    assert materials.published("bagher_sgd").model == type(m).__name__
    licence = resources.files("brdf.materials").joinpath("data/LICENSE.bbm").read_text("utf-8")
    assert "Pieter Peers" in licence


@pytest.mark.parametrize("fit", catalogue._FITS)
def test_every_fit_of_one_material(fit: str) -> None:
    m = materials.get(f"gold-metallic-paint@{fit}")
    assert m.name == f"gold-metallic-paint@{fit}"
    assert m.source.startswith(f"{fit}: ")
    assert materials.published(fit).citation in m.source
    kinds = {type(part).__name__ for part in (m, *m.children.values())}
    kinds |= {type(inner).__name__ for part in m.children.values() for inner in part.children.values()}
    assert materials.published(fit).model in kinds


def test_unknown_names() -> None:
    with pytest.raises(UnknownNameError, match="unknown material 'gold-metalic-paint': did you mean 'gold-metallic-pa"):
        materials.get("gold-metalic-paint")
    with pytest.raises(UnknownNameError, match="unknown fit of chrome 'bager_sgd': did you mean 'bagher_sgd'"):
        materials.get("chrome@bager_sgd")
    with pytest.raises(UnknownNameError, match="unknown fit of chrome 'ngan_wart': did you mean 'ngan_ward"):
        materials.get("chrome@ngan_wart")
    with pytest.raises(UnknownNameError, match="unknown material 'x'"):
        materials.fits("x")
    with pytest.raises(UnknownNameError, match="unknown fit 'x': known: bagher_sgd, low_"):
        materials.published("x")


@pytest.mark.parametrize("name", ["ss440", "chrome@ngan_he", "chrome@low_lowsmooth_E2"])
def test_a_material_saves_and_restores(name: str, tmp_path: object) -> None:
    m = materials.get(name)
    m.save(f"{tmp_path}/m.safetensors")
    back = Reflectance.restore(f"{tmp_path}/m.safetensors")
    assert (back.name, back.source, back.state()[0]) == (m.name, m.source, m.state()[0])
