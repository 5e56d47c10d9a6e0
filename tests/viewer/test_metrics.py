"""The page's own PSNR: that of `brdf.metrics`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

import brdf
from brdf.metrics import psnr, sphere_pairs
from brdf.viewer.payload import stage_texts
from javascript import node
from page_sources import source

if TYPE_CHECKING:
    from pathlib import Path

    from playwright.sync_api import Page

COMPARED = """async ([sources, stages, sizes]) => {
    const { Material } = await import("./material.js");
    const { Evaluator } = await import("./evaluate.js");
    const { Comparer } = await import("./metrics.js");
    const gl = document.createElement("canvas").getContext("webgl2");
    const decoded = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const [a, b] = sources.map((source) => new Material(gl, { ...source, texels: decoded(source.texels) }));
    const evaluator = new Evaluator(gl, stages);
    return sizes.map((size) => {
        const comparer = new Comparer(evaluator, size);
        const found = [comparer.psnr(a, b), comparer.psnr(a, a)];
        comparer.dispose();
        return found.map(String);
    });
}"""


@pytest.mark.parametrize(("first", "second"), [("stack", "gold-metallic-paint"), ("GGX:alpha=.1", "GGX:alpha=.12")])
def test_is_that_of_python(modules: Page, first: str, second: str) -> None:
    gold = brdf.load("gold-metallic-paint")
    a, b = (brdf.SliceStack.bake(gold) if name == "stack" else brdf.load(name) for name in (first, second))
    found = modules.evaluate(COMPARED, [[source(a), source(b)], stage_texts(), [64, 128]])
    for size, (between, itself) in zip((64, 128), found, strict=True):
        assert float(between) == pytest.approx(psnr(a, b, size), abs=0.05)
        assert itself == "Infinity"


def test_directions_are_those_of_python(tmp_path: Path) -> None:
    script = """
    import { litPixels } from "WEB/metrics.js";
    const { wi, wo, cosines } = litPixels(24);
    console.log(JSON.stringify([wi, wo, cosines].map((list) => Array.from(list))));
    """
    wi, wo, cosines = (np.array(list_) for list_ in node(script, folder=tmp_path))
    expected = sphere_pairs(24)
    for given, directions in zip((wi, wo), expected, strict=True):
        np.testing.assert_allclose(given.reshape(-1, 4)[:, :3], directions, atol=1e-6)
    np.testing.assert_allclose(cosines, np.pi * expected[0][:, 2], atol=1e-5)
