"""Formulas on arrays that refuse to meet our vectors, as Dr.Jit's compiled ones do."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

import brdf
from brdf.formula import backends
from helpers import random_directions

M = brdf.models
REFLECTANCES = {
    "sgd": lambda: brdf.load("gold-metallic-paint"),
    "openpbr": lambda: M.OpenPBR(coat_weight=0.5, fuzz_weight=0.3),
    "disney": lambda: M.Disney(roughness=0.3, clearcoat=1.0, anisotropic=0.5),
    "stack": lambda: brdf.SliceStack.bake(M.GGX(alpha=0.3)),
    "sum": lambda: 0.5 * M.OrenNayar() + M.Microfacet(fresnel="conductor", alpha=0.2),
}


class Strict:
    """An array that meets arrays of its kind and numbers alone."""

    def __init__(self, data):
        self.data = np.asarray(data)


def _binary(name):
    def apply(self, other):
        if not isinstance(other, (Strict, int, float)) or isinstance(other, np.generic):
            raise RuntimeError(f"{name}: unsupported {type(other)}")
        return Strict(getattr(self.data, name)(other.data if isinstance(other, Strict) else other))

    return apply


for _name in ("add", "radd", "sub", "rsub", "mul", "rmul", "truediv", "rtruediv", "lt", "le", "gt", "ge", "and", "or"):
    setattr(Strict, f"__{_name}__", _binary(f"__{_name}__"))
Strict.__neg__ = lambda self: Strict(-self.data)
Strict.__invert__ = lambda self: Strict(~self.data)


class Strict3(Strict):
    def __init__(self, x, y, z):
        self.components = (x, y, z)

    def __getitem__(self, index):
        return self.components[index]


@pytest.fixture
def strict(monkeypatch):
    plain = backends._numpy()

    def lifted(function):
        return lambda *a: Strict(function(*(x.data if isinstance(x, Strict) else x for x in a)))

    names = {
        name: lifted(function) for name, function in vars(plain).items() if name not in ("gather", "stack", "integer")
    }
    names["integer"] = lambda a: Strict(np.asarray(a.data, int))
    names["gather"] = lambda rows, index: [Strict(column[index.data]) for column in rows.T]
    monkeypatch.setitem(backends._BACKENDS, __name__.partition(".")[0], lambda: SimpleNamespace(**names))


@pytest.mark.parametrize("name", REFLECTANCES)
def test_values(name, strict):
    m = REFLECTANCES[name]()
    wi, wo = random_directions(300, 1), random_directions(300, 2)
    wi[:20, 2] *= -1
    value = m(*(Strict3(*map(Strict, w.T)) for w in (wi, wo)))
    np.testing.assert_allclose(np.stack([c.data for c in value.components], -1), m(wi, wo), rtol=1e-9, atol=1e-12)
