"""Names that end strings and comments: every file that an export writes can be read all the same."""

from __future__ import annotations

import json
import re
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

import brdf
from brdf import io
from brdf.export.target import one_line, title
from brdf.models import GGX, GltfMetallicRoughness
from brdf.reflectance import Reflectance
from cards import HEADERS, GLCard, WebCard

NAMES = (
    'a """ b',
    "two\nlines\r\nand\u2028three\x85four",
    "*/ } /*",
    "--> ]]> <b> & </script>",
    "ends in \\",
    "ends in '''",
    'ends in "',
    "Grün 青\x00\u202e",
    "\n",
)


def nasty(name: str) -> Reflectance:
    return GltfMetallicRoughness(base_color=0.3).named(name, f"a file {name}")


@pytest.mark.parametrize("name", NAMES)
def test_scripts_for_blender(name: str, tmp_path: Path) -> None:
    path = brdf.export(nasty(name), tmp_path / "m.py").files[0]
    scope = {"__name__": "read"}
    exec(compile(path.read_text("utf-8"), path.name, "exec"), scope)
    assert scope["NAME"] == title(nasty(name))


@pytest.mark.parametrize("name", NAMES)
def test_materials_for_pbrt(name: str, tmp_path: Path) -> None:
    path = brdf.export(nasty(name), tmp_path / "m.pbrt").files[0]
    comment, statement = path.read_text("utf-8").splitlines()
    assert comment.startswith(f"# {title(nasty(name))}; ")
    assert re.match(r'MakeNamedMaterial "\w+" "string type"', statement, re.ASCII)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("extension", [".mtlx", ".xml"])
def test_xml(name: str, extension: str, tmp_path: Path) -> None:
    root = ET.parse(brdf.export(nasty(name), tmp_path / f"m{extension}").files[0]).getroot()
    names = [value for node in root for key, value in node.attrib.items() if key in ("name", "id")]
    assert names
    assert all(re.fullmatch(r"\w+", found, re.ASCII) for found in names)


@pytest.mark.parametrize("name", NAMES)
def test_gltf(name: str, tmp_path: Path) -> None:
    path = brdf.export(nasty(name), tmp_path / "m.gltf").files[0]
    assert json.loads(path.read_text("utf-8"))["materials"][0]["name"] == title(nasty(name))


@pytest.mark.parametrize("name", NAMES)
def test_measurements_beside(name: str, tmp_path: Path) -> None:
    beside = brdf.export(nasty(name), tmp_path / "m.xml").files[1]
    assert io.read(beside).source == f"RGL file {beside.name}"


@pytest.mark.parametrize("name", NAMES)
def test_shaders(name: str, gl: GLCard, web: WebCard, tmp_path: Path) -> None:
    m = GGX().named(name, f"a file {name}")
    shaders = {kind: brdf.export(m, tmp_path / f"m{kind}").files[0] for kind in (".glsl", ".wgsl")}
    vertex = HEADERS["300 es"] + "in vec3 p; void main() { gl_Position = vec4(p, 1.0); }"
    main = "out vec4 colour; void main() { colour = vec4(FUNCTION(vec3(0.0, 0.0, 1.0), vec3(0.0, 0.0, 1.0)), 1.0); }"
    text = shaders[".glsl"].read_text("ascii")
    described = json.loads(Path(f"{shaders['.glsl']}.json").read_text("utf-8"))
    assert described["name"] == name
    with gl.context:
        fragment = HEADERS["300 es"] + text + main.replace("FUNCTION", described["function"])
        gl.context.program(vertex, fragment_shader=fragment)
    web.device.create_shader_module(code=shaders[".wgsl"].read_text("ascii"))
    for path in shaders.values():
        head = path.read_text("ascii").split("\n\n")[0]
        assert all(line.startswith("//") for line in head.split("\n"))


@pytest.mark.parametrize("name", NAMES)
def test_pages(name: str, tmp_path: Path) -> None:
    text = brdf.export(GGX().named(name), tmp_path / "m.html").files[0].read_text("utf-8")
    plain = brdf.export(GGX(), tmp_path / "plain.html").files[0].read_text("utf-8")
    assert text.count("</script>") == plain.count("</script>")


def test_one_line() -> None:
    assert one_line(" a\n\tb\u2028c\x00 ") == "a b c?"
    assert title(GGX().named("\n")) == "GGX"
