"""The compiled kernels against the same formula on NumPy in float64: the bounds that hold the backends together."""

from __future__ import annotations

import os
import subprocess
import sys

import numba
import numpy as np
import pytest

import brdf
from brdf.errors import DirectionError
from brdf.formula import engine, kernels, machine_code
from helpers import random_directions, relative_error

COUNT = 30_000
WI, WO = random_directions(COUNT, 1), random_directions(COUNT, 2)

Z = np.array([0.0, 0.0, 1.0])


M = brdf.models
REFLECTANCES = {name: M.get(name) for name in M.names()} | {
    "anisotropic conductor": lambda: M.Microfacet(fresnel="conductor", alpha_x=0.1, alpha_y=0.4),
    "beckmann": lambda: M.Microfacet(ndf="beckmann", masking="smith-separable", fresnel="dielectric"),
    "sum": lambda: 0.5 * M.Lambertian() + M.GGX(alpha=0.05),
    "slice stack": lambda: brdf.SliceStack.bake(0.5 * M.Lambertian() + M.GGX(alpha=0.2)),
    "sgd gold-metallic-paint": lambda: brdf.load("gold-metallic-paint"),
}


SINGLE_BOUND = {"sgd gold-metallic-paint": 3e-5}
"""Where float32 is ill-conditioned: SGD's masking raises an angle, itself rounded, to a power of about 50."""


def on_numpy(m, wi, wo):
    """The formula on NumPy, whatever the size."""
    value = np.concatenate([m(a, b) for a, b in zip(np.array_split(wi, 4), np.array_split(wo, 4), strict=True)])
    assert COUNT // 4 < engine.SMALL <= COUNT
    return value


def compiled(m, wi, wo):
    """The kernel, whatever has been asked before."""
    return kernels.evaluate(m, wi, wo, clamp=True)


@pytest.mark.parametrize("name", REFLECTANCES)
def test_kernel_equals_numpy(name):
    m = REFLECTANCES[name]()
    reference = on_numpy(m, WI, WO)
    wi, wo = WI.astype(np.float32), WO.astype(np.float32)
    double, single = compiled(m, WI, WO), m(wi, wo)
    assert double.dtype == np.float64
    assert single.dtype == np.float32
    assert np.isfinite(single).all()
    # float32 input carries its own rounding: the reference is the formula at the rounded directions
    at_rounded = on_numpy(m, wi.astype(np.float64), wo.astype(np.float64))
    assert np.quantile(relative_error(double, reference), 0.999) <= 1e-12
    bound = SINGLE_BOUND.get(name, 1e-5)
    assert np.quantile(relative_error(single, at_rounded, floor=1e-4), 0.999) <= bound


def test_below_the_horizon_is_zero():
    m = brdf.models.GGX(alpha=0.3)
    down = WI * [1, 1, -1]
    assert not compiled(m, down, WO).any()
    assert not compiled(m, WI, WO * [1, 1, -1]).any()
    assert not m(down[:10], WO[:10]).any()


def test_wrong_lengths_are_refused_with_their_index():
    wi = WI.copy()
    wi[COUNT - 7] *= 1.01
    for evaluate in (lambda *w: brdf.models.Lambertian()(*w), lambda *w: compiled(brdf.models.Lambertian(), *w)):
        with pytest.raises(DirectionError, match=r"wi .*length 1\.01"):
            evaluate(wi, WO)
        wo = WO.copy()
        wo[3] = np.nan
        with pytest.raises(DirectionError, match=r"wo .*flat index 3 has length nan"):
            evaluate(WI, wo)


def test_strided_and_broadcast_inputs():
    m = brdf.models.GGX(alpha=0.3)
    interleaved = np.concatenate([WI, WO], 1)
    expected = compiled(m, WI, WO)
    np.testing.assert_array_equal(compiled(m, interleaved[:, :3], interleaved[:, 3:]), expected)
    np.testing.assert_array_equal(m(WI, Z), m(WI, np.broadcast_to(Z, WI.shape).copy()))


def test_float64_waits_until_compiling_pays(tmp_path, monkeypatch):
    monkeypatch.setenv("BRDF_CACHE", str(tmp_path))
    kernels.cache_folder.cache_clear()
    monkeypatch.setattr(kernels, "_kernels", {})
    monkeypatch.setattr(engine, "_asked", {})
    monkeypatch.setattr(engine, "WORTH_COMPILING", 2.5 * COUNT)
    m = brdf.models.Lambertian()
    try:
        m(WI, WO), m(WI, WO)
        assert not kernels.is_ready(m, "float64")
        m(WI, WO)
        assert kernels.is_ready(m, "float64")
        monkeypatch.setattr(kernels, "_kernels", {})
        assert kernels.is_ready(m, "float64")  # on disk
        assert not kernels.is_ready(brdf.models.GGX(), "float64")
    finally:
        kernels.cache_folder.cache_clear()


def test_results_do_not_depend_on_the_number_of_threads(monkeypatch):
    m = brdf.models.GGX(alpha=0.3)
    wi, wo = (np.tile(w, (4, 1)).astype("f4") for w in (WI, WO))
    many = m(wi, wo)
    monkeypatch.setenv("BRDF_THREADS", "1")
    np.testing.assert_array_equal(m(wi, wo), many)


def test_a_second_process_compiles_nothing(tmp_path):
    script = (
        "import numpy as np, brdf\n"
        "from numba.core import event\n"
        "with event.install_recorder('numba:compile') as recorder:\n"
        "    w = np.tile(np.float32([[0.6, 0.0, 0.8]]), (30000, 1)); value = brdf.models.Lambertian()(w, w)\n"
        "print(len(recorder.buffer), value[0, 0])"
    )
    environment = os.environ | {"BRDF_CACHE": str(tmp_path)}
    runs = [
        subprocess.run([sys.executable, "-c", script], env=environment, capture_output=True, text=True, check=True)
        for _ in range(2)
    ]
    compiled = [int(run.stdout.split()[0]) for run in runs]
    assert compiled[0] > 0
    assert compiled[1] == 0
    assert any(tmp_path.rglob("brdf_kernel_*.py"))


def test_a_process_compiles_ahead(tmp_path, monkeypatch):
    monkeypatch.setenv("BRDF_CACHE", str(tmp_path))
    monkeypatch.setenv("BRDF_THREADS", "2")
    kernels.cache_folder.cache_clear()
    monkeypatch.setattr(kernels, "_kernels", {})
    m = brdf.models.Lambertian()
    try:
        kernels.compile_ahead([m, m])
        (compiler,) = set(kernels._compilers.values())
        assert compiler.wait(timeout=120) == 0
        assert kernels.is_ready(m, "float32")
        wi = WI.astype("f4")
        np.testing.assert_allclose(m(wi, WO.astype("f4")), 0.5 / np.pi, rtol=1e-6)
        assert not kernels._compilers
        kernels.compile_ahead([m])
        assert not kernels._compilers  # nothing is left to do
    finally:
        kernels.cache_folder.cache_clear()


def test_an_index_without_machine_code_is_not_compiled(tmp_path):
    (tmp_path / "__pycache__").mkdir()
    (tmp_path / "__pycache__" / "m.kernel-1.py311.nbi").touch()
    assert not kernels._is_compiled(tmp_path / "m.py")
    (tmp_path / "__pycache__" / "m.kernel-1.py311.1.nbc").touch()
    assert kernels._is_compiled(tmp_path / "m.py")


def test_machine_code_has_a_place_where_the_package_is_read_only(tmp_path, monkeypatch):
    (tmp_path / "package").write_text("a file, in which no folder can be made")
    monkeypatch.setattr(machine_code, "_PACKAGE", tmp_path / "package")
    monkeypatch.setattr(machine_code, "cache_folder", lambda: tmp_path)
    monkeypatch.setattr(numba.config, "CACHE_DIR", "")
    assert machine_code.kept_on_disk.__wrapped__()
    assert str(tmp_path) == numba.config.CACHE_DIR
    function = numba.njit(numba.float64(numba.float64), cache=True)(lambda x: 2 * x)
    assert function(2.0) == 4.0
    assert list(tmp_path.glob("*/*.nbc"))


def test_an_unwritable_cache_is_survived(tmp_path, monkeypatch):
    blocked = tmp_path / "file"
    blocked.write_text("")
    monkeypatch.setenv("BRDF_CACHE", str(blocked))
    monkeypatch.setenv("XDG_CACHE_HOME", str(blocked))
    monkeypatch.setenv("HOME", str(blocked))
    kernels.cache_folder.cache_clear()
    try:
        assert kernels.cache_folder().is_dir()
    finally:
        kernels.cache_folder.cache_clear()
