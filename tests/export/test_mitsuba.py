"""The Mitsuba plug-in: exact values, draws that fit their density, LLVM found or refused before it ends the process."""

from __future__ import annotations

import os
import subprocess
import sys

import numpy as np
import pytest

import brdf
from brdf.errors import ParameterError, ReflectanceError
from brdf.export import llvm, mitsuba
from brdf.models import GGX, Lambertian
from helpers import random_directions

pytest.importorskip("mitsuba")
PLASTIC = Lambertian(albedo=(0.1, 0.2, 0.3)) + GGX(alpha=0.2)
REFLECTANCES = {
    "plastic": lambda: PLASTIC,
    "brushed": lambda: GGX(alpha_x=0.1, alpha_y=0.4, F0=0.9),
    "gold": lambda: brdf.load("gold-metallic-paint"),
    "stack": lambda: brdf.SliceStack.bake(PLASTIC, method="points"),
    "openpbr": lambda: brdf.models.OpenPBR(coat_weight=0.5),
}


@pytest.fixture
def mi():
    import mitsuba as module

    before = module.variant()
    yield mitsuba.set_variant("scalar_rgb")
    if before:
        module.set_variant(before)


@pytest.mark.parametrize("name", REFLECTANCES)
def test_values_are_the_reflectance_times_the_cosine(mi, name):
    m = REFLECTANCES[name]()
    bsdf, interaction = mitsuba.bsdf(m), mi.SurfaceInteraction3f()
    for light, viewer in zip(random_directions(30, 1), random_directions(30, 2), strict=True):
        interaction.wi = mi.Vector3f(*viewer.tolist())
        value = np.array(bsdf.eval(mi.BSDFContext(), interaction, mi.Vector3f(*light.tolist())))
        np.testing.assert_allclose(value, m(light, viewer) * light[2], rtol=1e-4, atol=1e-7)


def test_nothing_below_the_horizon(mi):
    bsdf, interaction = mitsuba.bsdf(PLASTIC), mi.SurfaceInteraction3f()
    interaction.wi = mi.Vector3f(0, 0, 1)
    below = mi.Vector3f(0.6, 0, -0.8)
    assert not np.array(bsdf.eval(mi.BSDFContext(), interaction, below)).any()
    assert bsdf.pdf(mi.BSDFContext(), interaction, below) == 0


def test_draws_give_the_albedo_with_the_density_they_claim(mi):
    bsdf, interaction, context = mitsuba.bsdf(PLASTIC), mi.SurfaceInteraction3f(), mi.BSDFContext()
    view = np.array([0.6, 0, 0.8])
    interaction.wi = mi.Vector3f(*view)
    rng, weights = np.random.default_rng(1), []
    for u in rng.random((2500, 3)):
        drawn, weight = bsdf.sample(context, interaction, u[0], mi.Point2f(u[1], u[2]))
        weights.append(np.array(weight))
        if drawn.pdf > 0:
            assert drawn.pdf == pytest.approx(bsdf.pdf(context, interaction, drawn.wo), rel=1e-4)
            value = np.array(bsdf.eval(context, interaction, drawn.wo))
            np.testing.assert_allclose(weights[-1] * drawn.pdf, value, rtol=1e-4, atol=1e-7)
    spread = np.std(weights, axis=0) / 50
    np.testing.assert_allclose(np.mean(weights, axis=0), PLASTIC.albedo(view), atol=4 * spread.max())
    z, phi = np.meshgrid((np.arange(40) + 0.5) / 40, (np.arange(60) + 0.5) / 60 * 2 * np.pi)
    s = np.sqrt(1 - z * z)
    grid = np.stack([s * np.cos(phi), s * np.sin(phi), z], -1).reshape(-1, 3)
    total = 2 * np.pi * np.mean([bsdf.pdf(context, interaction, mi.Vector3f(*w.tolist())) for w in grid])
    assert 0.9 < total < 1.02


def test_scenes_name_it_as_brdf_load_does(mi):
    bsdf = mi.load_dict({"type": "brdf", "material": "GGX:alpha=0.3,F0=0.5"})
    assert "GGX" in str(bsdf)
    xml = mi.load_string('<bsdf version="3.0.0" type="brdf"><string name="material" value="chrome"/></bsdf>')
    assert str(xml) == "BRDF[chrome]"


def test_the_proposal_follows_the_width():
    assert mitsuba.proposal(GGX(alpha=0.05)).alpha == pytest.approx(0.05, rel=0.5)
    assert mitsuba.proposal(GGX(alpha=0.05)).share > mitsuba.proposal(Lambertian()).share


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: brdf.models.SmoothConductor(), "take Mitsuba's own dielectric or conductor"),
        (lambda: brdf.SpatiallyVarying(GGX(), alpha=np.full((2, 2), 0.3)), "give its value at one place"),
    ],
)
def test_what_it_cannot_be(mi, make, said):
    with pytest.raises(ReflectanceError, match=said):
        mitsuba.require_plain(make())


def test_variants():
    with pytest.raises(ParameterError, match="has no variant 'cpu'; it has scalar_rgb"):
        mitsuba.set_variant("cpu")
    with pytest.raises(ParameterError, match="needs a variant of RGB or luminance, not 'scalar_spectral'"):
        mitsuba.set_variant("scalar_spectral")


@pytest.mark.parametrize(
    ("name", "version"),
    [
        ("libLLVM-14.so.1", 14),
        ("libLLVM.so.19.1", 19),
        ("libLLVM-15.0.6.so", 15),
        ("libLLVM.21.dylib", 21),
        ("LLVM-C.dll", None),
        ("libLLVM.so", None),
    ],
)
def test_versions_by_name(tmp_path, name, version):
    assert llvm.version_of(tmp_path / name) == version


def test_old_libraries_are_refused(tmp_path, monkeypatch):
    monkeypatch.setenv(llvm.VARIABLE, str(tmp_path / "libLLVM-15.so.1"))
    with pytest.raises(ParameterError, match="is LLVM 15; Mitsuba needs 19 or newer"):
        llvm.require_llvm()
    monkeypatch.delenv(llvm.VARIABLE)
    monkeypatch.setattr(llvm, "candidates", lambda: [tmp_path / "libLLVM-15.so.1"])
    with pytest.raises(ParameterError, match=r"found only LLVM 15: install one \(Debian: libllvm19\)"):
        llvm.require_llvm()
    monkeypatch.setattr(llvm, "candidates", lambda: [tmp_path / f"libLLVM.so.{v}.1" for v in (15, 19, 21)])
    assert llvm.require_llvm().name == "libLLVM.so.21.1"
    assert os.environ[llvm.VARIABLE].endswith("21.1")


def has_llvm() -> bool:
    return any((llvm.version_of(path) or 0) >= llvm.LEAST for path in llvm.candidates())


COMPILED = """
import numpy as np, brdf
from brdf.export import mitsuba
mi = mitsuba.set_variant("llvm_ad_rgb")
rng = np.random.default_rng(1)
w = rng.normal(size=(2, 3, 2000)).astype("f4")
w[:, 2] = abs(w[:, 2]) + 0.02
w /= np.linalg.norm(w, axis=1, keepdims=True)
for m in (brdf.load("gold-metallic-paint"), brdf.SliceStack.bake(brdf.models.GGX(alpha=0.3))):
    interaction = mi.SurfaceInteraction3f()
    interaction.wi = mi.Vector3f(*w[1])
    value = np.array(mitsuba.bsdf(m).eval(mi.BSDFContext(), interaction, mi.Vector3f(*w[0]))).T
    np.testing.assert_allclose(value, m(w[0].T, w[1].T) * w[0, 2][:, None], rtol=1e-3, atol=1e-5)
"""


def test_compiled_variants(monkeypatch):
    """In a process of its own where an LLVM that works is installed; refused where not, so that no process ends."""
    monkeypatch.delenv(llvm.VARIABLE, raising=False)
    if has_llvm():
        subprocess.run([sys.executable, "-c", COMPILED], check=True)
    else:
        with pytest.raises(ParameterError, match="need LLVM 19 or newer"):
            mitsuba.set_variant("llvm_ad_rgb")
