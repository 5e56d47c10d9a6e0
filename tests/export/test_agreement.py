"""Exported shaders, run on a software driver, against the formula on NumPy in float64: every model, every kind."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest

import brdf
from brdf import materials
from brdf.formula.printers.shader import helpers
from brdf.reflectance import Reflectance
from cards import HEADERS, GLCard, WebCard
from every_kind import MODELS, TABLES
from lobes import random_pairs

COUNT = 6000
MODEL_BOUND, TABLE_BOUND = 2e-4, 5e-4
"""Relative, for 99.9 % of the numbers."""

LEAST = 1e-6
"""Values [1/sr] below this are compared absolutely."""


def _pairs() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(COUNT, 3) float32 directions, a quarter of each below the horizon, and places."""
    rng = np.random.default_rng(2)
    wi, wo = random_pairs(COUNT, 3)
    for w in (wi, wo):
        w[:, 2] *= np.where(rng.random(COUNT) < 0.25, -1, 1)
    return wi.astype("f4"), wo.astype("f4"), rng.random((COUNT, 2)).astype("f4")


WI, WO, UV = _pairs()


@cache
def made(name: str) -> tuple[Reflectance, np.ndarray, float]:
    """The reflectance, its values in float64 at the rounded directions, and the bound on the error."""
    m = (MODELS | TABLES)[name]()
    return m, m(WI.astype("f8"), WO.astype("f8"), UV.astype("f8")), MODEL_BOUND if name in MODELS else TABLE_BOUND


def errors(value: np.ndarray, reference: np.ndarray) -> np.ndarray:
    assert np.isfinite(value).all()
    return np.abs(value - reference) / np.maximum(np.abs(reference), LEAST)


@pytest.mark.parametrize("name", [*MODELS, *TABLES])
def test_glsl_agrees_with_numpy(name: str, gl: GLCard, tmp_path: Path) -> None:
    m, reference, bound = made(name)
    shader = brdf.export(m, tmp_path / "m.glsl").files[0]
    value = gl.evaluate(shader, WI, WO, UV)
    assert np.quantile(errors(value, reference), 0.999) <= bound
    np.testing.assert_array_equal(gl.evaluate(shader, WI, WO, UV, "300 es"), value)


@pytest.mark.parametrize("name", [*MODELS, *TABLES])
def test_wgsl_agrees_with_numpy(name: str, web: WebCard, tmp_path: Path) -> None:
    m, reference, bound = made(name)
    value = web.evaluate(brdf.export(m, tmp_path / "m.wgsl").files[0], WI, WO, UV)
    assert np.quantile(errors(value, reference), 0.999) <= bound


@pytest.mark.parametrize("filter", ["linear", "nearest", "catmull-rom", "b-spline"])
def test_hardware_filters_linear_tables_alone(filter: str, gl: GLCard, tmp_path: Path) -> None:
    m = brdf.Table.bake(MODELS["beckmann, dielectric"](), shape=(16, 12, 8), filter=filter)
    shader = brdf.export(m, tmp_path / "m.glsl").files[0]
    assert ("#ifdef HARDWARE_FILTER" in shader.read_text()) == (filter == "linear")
    exact = gl.evaluate(shader, WI, WO, UV)
    shader.write_text("#define HARDWARE_FILTER\n" + shader.read_text())
    assert np.quantile(errors(gl.evaluate(shader, WI, WO, UV, linear=True), exact), 0.999) <= 1e-4


@pytest.mark.parametrize("size", [(16384, 1), (1, 16383), (2048, 1, 1), (1, 2047, 1), (1, 1, 1999)])
def test_texels_are_found_by_their_centres(size: tuple[int, ...], gl: GLCard) -> None:
    axes, count = len(size), max(size)
    place = ", ".join("index" if n == count else "0" for n in size)
    texel = f"texel{axes}(t, ivec{axes}({place})).x"
    main = f"uniform sampler{axes}D t;\nin int index;\nout float value;\nvoid main() {{ value = {texel}; }}\n"
    with gl.context as context:
        program = context.program("\n".join([HEADERS["330 core"], helpers("glsl", main), main]), varyings=["value"])
        make = context.texture if axes == 2 else context.texture3d
        texture = make(size, 1, np.arange(count, dtype="f4").tobytes(), dtype="f4")
        texture.filter = context.NEAREST, context.NEAREST
        texture.use(0)
        program["t"].value = 0
        out = context.buffer(reserve=4 * count)
        given = context.buffer(np.arange(count, dtype="i4"))
        array = context.vertex_array(program, [(given, "1i", "index")])
        array.transform(out, context.POINTS, count)
        found = np.frombuffer(out.read(), np.float32)
        for thing in (array, given, out, texture, program):
            thing.release()
    np.testing.assert_array_equal(found, np.arange(count))


def test_every_shipped_material_compiles_and_agrees(gl: GLCard, tmp_path: Path) -> None:
    few = slice(0, COUNT, 20)
    wi, wo, uv = WI[few], WO[few], UV[few]
    worst = {}
    for name in materials.names():
        m = materials.get(name)
        value = gl.evaluate(brdf.export(m, tmp_path / "m.glsl").files[0], wi, wo, uv)
        worst[name] = np.quantile(errors(value, m(wi.astype("f8"), wo.astype("f8"))), 0.99)
    assert {name: error for name, error in worst.items() if error > MODEL_BOUND} == {}
