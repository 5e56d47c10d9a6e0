"""The page's evaluation of a material: the numbers that the same shader gives in Python."""

from __future__ import annotations

import base64
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import brdf
from brdf.shaders import Shader, shader_of, stages
from cards import GLCard
from every_kind import MODELS, TABLES
from helpers import random_directions, relative_error

if TYPE_CHECKING:
    from playwright.sync_api import Page

COUNT = 1000

EVALUATED = """async ([source, stage, wi, wo]) => {
    const { Material } = await import("./material.js");
    const { Directions, Evaluator } = await import("./evaluate.js");
    const decoded = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const floats = (text) => new Float32Array(decoded(text).buffer);
    const encoded = (values) => btoa(Array.from(new Uint8Array(values.slice().buffer), (b) =>
        String.fromCharCode(b)).join(""));
    const gl = document.createElement("canvas").getContext("webgl2");
    const material = new Material(gl, { ...source, texels: decoded(source.texels) });
    const evaluator = new Evaluator(gl, { evaluate: stage });
    const first = encoded(evaluator.evaluate(material, floats(wi), floats(wo)));
    const kept = [new Directions(floats(wi)), new Directions(floats(wo))];
    const again = encoded(evaluator.evaluate(material, ...kept));
    const lost = gl.getExtension("WEBGL_lose_context");
    const waited = (name) => new Promise((done) => gl.canvas.addEventListener(name, (event) => {
        event.preventDefault();
        setTimeout(done, 0);
    }, { once: true }));
    const gone = waited("webglcontextlost"), back = waited("webglcontextrestored");
    lost.loseContext();
    await gone;
    lost.restoreContext();
    await back;
    material.forget();
    evaluator.forget();
    const restored = encoded(evaluator.evaluate(material, ...kept));
    return [first, again, restored, gl.getError()];
}"""


def source(shader: Shader) -> dict[str, Any]:
    texels = base64.b64encode(shader.texels).decode()
    return {"shader": shader.description, "text": stages.material(shader), "texels": texels}


def stage() -> dict[str, str]:
    return {"vertex": stages.vertex("sphere"), "fragment": stages.evaluation()}


def text64(numbers: np.ndarray[Any, Any]) -> str:
    return base64.b64encode(np.ascontiguousarray(numbers, "f4").tobytes()).decode()


@pytest.mark.parametrize("name", ["GGX", "varying", "table, rgb9e5", "slice stack", "sphere images, bytes"])
def test_the_page_evaluates_what_python_evaluates(modules: Page, gl: GLCard, tmp_path: Path, name: str) -> None:
    m = (MODELS | TABLES)[name]()
    wi, wo = (random_directions(COUNT, seed).astype("f4") for seed in (1, 2))
    uv = np.random.default_rng(3).random((COUNT, 2)).astype("f4")
    lists = [text64(np.concatenate([w, uv[:, i : i + 1]], 1)) for i, w in enumerate((wi, wo))]
    *values, error = modules.evaluate(EVALUATED, [source(shader_of(m)), stage(), *lists])
    assert error == 0
    first, again, restored = (np.frombuffer(base64.b64decode(value), "f4").reshape(-1, 4) for value in values)
    expected = gl.evaluate(brdf.export(m, tmp_path / "m.glsl").files[0], wi, wo, uv, "300 es")
    assert expected.any()
    assert relative_error(first[:, :3], expected, 1e-6).max() < 3e-6
    np.testing.assert_array_equal(again, first)
    np.testing.assert_array_equal(restored, first)


def test_a_shader_that_does_not_compile_is_named_by_its_line(modules: Page) -> None:
    given = source(shader_of(brdf.models.GGX())) | {"text": "vec3 colour = blue;\n"}
    one = text64(np.array([[0, 0, 1, 0]]))
    with pytest.raises(Exception, match=r"A shader does not compile: .*blue.* in line \d+: vec3 colour = blue;"):
        modules.evaluate(EVALUATED, [given, stage(), one, one])
