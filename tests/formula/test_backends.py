"""The same formula on other libraries' arrays, when the caller passes them."""

from __future__ import annotations

import numpy as np
import pytest

import brdf
from helpers import random_directions, relative_error

WI, WO = random_directions(400, 5).astype("f4"), random_directions(400, 6).astype("f4")
WI[:20, 2] *= -1


M = brdf.models
REFLECTANCES = {
    "sum": lambda: 0.5 * M.OrenNayar() + M.Microfacet(fresnel="conductor", alpha=0.2),
    "beckmann": lambda: M.Microfacet(ndf="beckmann", fresnel="dielectric"),
    "sgd": lambda: brdf.load("gold-metallic-paint"),
    "textured": lambda: brdf.SliceStack.bake(M.GGX(alpha=0.3)),
}


@pytest.mark.parametrize("name", REFLECTANCES)
@pytest.mark.parametrize("library", ["jax", "torch", "drjit"])
def test_foreign_arrays(name, library):
    m = REFLECTANCES[name]()
    module = pytest.importorskip(library, reason=f"{library} is optional: arrays of it work when it is installed")
    if library == "jax":
        jnp = pytest.importorskip("jax.numpy")
        value = m(jnp.asarray(WI), jnp.asarray(WO))
        assert isinstance(value, module.Array)
    elif library == "torch":
        value = m(module.from_numpy(WI), module.from_numpy(WO))
        assert isinstance(value, module.Tensor)
    else:
        llvm = pytest.importorskip("drjit.scalar")
        vector = llvm.Array3f
        value = np.array(
            [list(m(vector(*map(float, i)), vector(*map(float, o)))) for i, o in zip(WI[:60], WO[:60], strict=True)]
        )
    value = np.asarray(value)
    expected = m(WI, WO)[: len(value)]
    assert np.quantile(relative_error(value, expected, floor=1e-4), 0.995) < 1e-4
    assert not value[:20].any()


def test_gradients_flow_through_torch():
    torch = pytest.importorskip("torch", reason="torch is optional: arrays of it work when it is installed")
    wi = torch.from_numpy(WI[20:40].astype("f8")).requires_grad_()
    brdf.models.GGX(alpha=0.3)(wi, torch.from_numpy(WO[20:40].astype("f8"))).sum().backward()
    assert torch.isfinite(wi.grad).all()
    assert wi.grad.abs().max() > 0
