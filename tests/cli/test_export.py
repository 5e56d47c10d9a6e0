"""`brdf export`: files written, what is printed, what is refused."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Command = Callable[..., Any]
Refused = Callable[..., str]


def test_a_model_becomes_a_shader_and_its_description(brdf: Command, tmp_path: Path) -> None:
    outcome = brdf("export", "GGX:alpha=0.2,F0=1/.78/.34", "gold.glsl")
    assert outcome.code == 0
    assert outcome.out.splitlines()[0] == str((tmp_path / "gold.glsl").resolve())
    assert sorted(path.name for path in tmp_path.iterdir()) == ["gold.glsl", "gold.glsl.json"]
    assert "uniform vec3 F0;  // 1, 0.78, 0.34" in (tmp_path / "gold.glsl").read_text("utf-8")


def test_json_names_the_function_and_the_files(brdf: Command, tmp_path: Path) -> None:
    found = json.loads(brdf("export", "GGX", "m.wgsl", "--function", "shade", "--budget", "4K", "--json").out)
    assert found["function"] == "shade"
    assert found["files"] == {
        name: (tmp_path / name).stat().st_size for name in ("m.wgsl", "m.wgsl.json", "m.wgsl.bin")
    }
    assert "fn shade(wi: vec3f, wo: vec3f) -> vec3f {" in (tmp_path / "m.wgsl").read_text("utf-8")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (
            ("GGX", "m.hlsl"),
            "m.hlsl: exports are .glsl, .wgsl, .html, .gltf, .mtlx, .pbrt, .py or .xml; choose one",
        ),
        (("GGX", "none/m.glsl"), "brdf: none/m.glsl: cannot be written (No such file or directory); choose another"),
        (("GGX", "m.glsl", "--function", "1st"), "a function's name has letters, digits, single underscores"),
        (("GGX", "m.glsl", "--as", "tabel"), "did you mean 'table'"),
        (("GXG", "m.glsl"), "did you mean 'GGX'"),
        (("GGX", "GGX", "m.glsl"), "a shader is written of one reflectance, got 2; a page, .html, takes several"),
        (("GGX", "m.glsl", "--mesh", "sphere"), "'mesh' is how a page starts and has no effect with .glsl"),
        (("GGX", "m.html", "--function", "shade"), "a page has no function to name"),
        (("GGX", "m.mtlx", "--function", "shade"), ".mtlx has no function to name"),
        (("GGX", "GGX", "m.gltf"), "a renderer's file is written of one reflectance, got 2"),
        (("SmoothConductor", "m.gltf"), "SmoothConductor transmits or mirrors"),
        (("GGX", "m.html", "--tone", "film"), "unknown tone curve 'film'"),
        (("GGX", "m.html", "--light", "spot:1/2/3"), "unknown light 'spot'"),
    ],
)
def test_mistakes_are_one_line(refused: Refused, tmp_path: Path, arguments: tuple[str, ...], message: str) -> None:
    assert message in refused("export", *arguments)
    assert list(tmp_path.iterdir()) == []


def test_measured_without_a_formula_is_baked_on_request(brdf: Command, refused: Refused, data: Path) -> None:
    measured = next((data / "rgl").glob("*.bsdf"))
    assert "bake it first" in refused("export", measured, "m.glsl")


def test_materials_become_a_page(brdf: Command, tmp_path: Path) -> None:
    outcome = brdf("export", "GGX:alpha=0.2", "Lambertian", "two.html", "--mesh", "sphere", "--env", "0.5", "--json")
    assert json.loads(outcome.out) == {"files": {"two.html": (tmp_path / "two.html").stat().st_size}}
    assert "<title>GGX:alpha=0.2 · Lambertian</title>" in (tmp_path / "two.html").read_text("utf-8")


@pytest.mark.parametrize("verb", ["export", "convert"])
def test_a_renderers_file_says_how_far_it_is(brdf: Command, tmp_path: Path, verb: str) -> None:
    model = "GltfMetallicRoughness:roughness=.4,metallic=.2,base_color=.2/.3/.4"
    found = json.loads(brdf(verb, model, "m.gltf", "--json").out)
    assert found["files"] == {"m.gltf": (tmp_path / "m.gltf").stat().st_size}
    assert found["psnr_mean"] is None  # no difference at all
    printed = brdf(verb, model, "n.gltf").out
    assert printed.splitlines()[0] == str((tmp_path / "n.gltf").resolve())
    assert "PSNR" in printed
