"""A saved file carries its shader: what the page's reader makes of it is what Python prints."""

from __future__ import annotations

import base64
import gzip
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import brdf
from brdf import container
from brdf.models import GGX
from brdf.shaders import shader_of, stages
from brdf.shaders.embedded import PREFIX
from cards import texels
from every_kind import MODELS, TABLES
from javascript import node

READ = """
import { readFileSync, writeFileSync } from "node:fs";
import { parseSafetensors } from "WEB/formats/safetensors.js";
const found = {};
for (const file of process.argv.slice(2)) {
    try {
        const bytes = readFileSync(file);
        const { texels, ...rest } = await parseSafetensors(new Uint8Array(bytes).buffer, file);
        writeFileSync(file + ".bin", new Uint8Array(texels));
        found[file] = rest;
    } catch (error) {
        found[file] = { error: error.message };
    }
}
console.log(JSON.stringify(found));
"""

KINDS = MODELS | TABLES


@pytest.fixture(scope="module")
def read(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """What the reader of the page makes of a file of every kind."""
    folder = tmp_path_factory.mktemp("files")
    paths = {name: folder / f"{number}.safetensors" for number, name in enumerate(KINDS)}
    made = {name: make() for name, make in KINDS.items()}
    for name, path in paths.items():
        made[name].save(path)
    found = node(READ, *paths.values(), folder=folder)
    return {name: found[str(path)] | {"m": made[name], "texels": Path(f"{path}.bin")} for name, path in paths.items()}


@pytest.mark.parametrize("name", KINDS)
def test_every_kind_is_read_as_it_is_printed(read: dict[str, Any], name: str) -> None:
    m, found = read[name]["m"], read[name]
    assert "error" not in found, found["error"]
    shader = shader_of(m)
    assert found["text"] == stages.material(shader)
    assert found["nbytes"] == m.nbytes
    assert found["isotropic"] is m.isotropic
    assert found["kind"] == type(m).__name__
    described, data = found["shader"], found["texels"].read_bytes()
    given = {key: value for key, value in shader.description.items() if key not in ("textures", "name")}
    assert {key: described[key] for key in given} == json.loads(json.dumps(given))
    assert len(described["textures"]) == len(shader.description["textures"])
    for texture, printed in zip(described["textures"], shader.description["textures"], strict=True):
        assert {key: texture[key] for key in ("uniform", "target", "size")} == {
            key: printed[key] for key in ("uniform", "target", "size")
        }
        channels = 3 if texture["format"] == "RGBA" else None
        numbers, expected = (texels(d, b)[0][..., :channels] for d, b in ((texture, data), (printed, shader.texels)))
        np.testing.assert_array_equal(numbers, expected)


def test_a_stack_of_16_kilobytes_grows_by_3_at_most(tmp_path: Path) -> None:
    stack = brdf.SliceStack.bake(brdf.load("gold-metallic-paint"))
    stack.save(tmp_path / "with.safetensors")
    container.save(tmp_path / "without.safetensors", *stack.state())
    sizes = [(tmp_path / f"{name}.safetensors").stat().st_size for name in ("with", "without")]
    assert sizes[0] - sizes[1] <= 3072


def test_saved_twice_is_the_same_file(tmp_path: Path) -> None:
    for name in ("a", "b"):
        GGX(alpha=0.3).save(tmp_path / name)
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()


def test_a_file_with_tensors_for_the_shader_alone_loads(tmp_path: Path) -> None:
    m = KINDS["table, srgb8"]()
    m.save(tmp_path / "m.safetensors")
    assert any(name.startswith(PREFIX) for name in container.load(tmp_path / "m.safetensors")[1])
    restored = brdf.load(tmp_path / "m.safetensors")
    np.testing.assert_array_equal(restored.codes, m.codes)


def test_what_cannot_be_printed_is_saved_without(tmp_path: Path) -> None:
    class Huge(brdf.Reflectance):
        """Of more texels than cards take, all of them computed."""

        structure, textures = (), {"grid": np.linspace(0, 1, 30000, dtype=np.float32).reshape(2, 15000, 1)}

        def f(self, wi: Any, wo: Any) -> Any:
            from brdf.formula import texture2d

            return texture2d(self.grid, wi.x, wo.x)

        def _state(self) -> Any:
            return {}, {}

    Huge().save(tmp_path / "m.safetensors")
    assert "shader" not in container.load(tmp_path / "m.safetensors")[0]


def broken(path: Path, header: dict[str, Any] | bytes, body: bytes = b"") -> Path:
    text = header if isinstance(header, bytes) else json.dumps(header).encode()
    path.write_bytes(len(text).to_bytes(8, "little") + text + body)
    return path


def test_broken_files_are_refused_in_a_sentence(tmp_path: Path) -> None:
    f = tmp_path / "f.safetensors"
    whole = brdf.SliceStack.bake(GGX(alpha=0.3))
    whole.save(f)
    head = {"schema": 1, "kind": "Table"}
    container.save(tmp_path / "old", {"kind": "Table"}, {"codes": np.zeros((2, 2), np.float32)})
    files = {
        "empty": b"",
        "truncated": f.read_bytes()[:-100],
        "no json": b"\4\0\0\0\0\0\0\0{{{{",
        "two gigabytes": (2**31).to_bytes(8, "little") + b"{}",
        "no safetensors": b"\xff" * 64,
    }
    for name, data in files.items():
        (tmp_path / name).write_bytes(data)
    broken(tmp_path / "huge tensor", {"a": {"dtype": "F32", "shape": [1 << 29], "data_offsets": [0, 1 << 31]}})
    broken(tmp_path / "negative", {"a": {"dtype": "F32", "shape": [-1], "data_offsets": [0, -4]}})
    broken(tmp_path / "foreign", {"__metadata__": {"a": "b"}})
    broken(tmp_path / "newer", {"__metadata__": {"brdf": json.dumps({"schema": 99})}})
    broken(tmp_path / "null header", b"null")
    broken(tmp_path / "null tensor", {"a": None})
    broken(tmp_path / "null metadata", {"__metadata__": None})
    broken(tmp_path / "null description", {"__metadata__": {"brdf": "null"}})
    shader = gzip.compress(json.dumps({"text": "", "description": {"textures": []}}).encode())
    text = json.dumps(head | {"shader": base64.b64encode(shader).decode()})
    broken(tmp_path / "no parameters", {"__metadata__": {"brdf": text}})
    broken(tmp_path / "no gzip", {"__metadata__": {"brdf": json.dumps(head | {"shader": "AAAA"})}})
    expected = {
        "empty": "has 0 bytes, too few for a safetensors file (8).",
        "truncated": "; fetch the file again.",
        "no json": "is not a safetensors file: its header is not JSON.",
        "two gigabytes": "claims a header of 2147483648 bytes in a file of 10: it is truncated, or no",
        "no safetensors": "it is truncated, or no safetensors file.",
        "huge tensor": "its tensor 'a' claims bytes 0 to 2147483648 of 0; fetch the file again.",
        "negative": "its tensor 'a' claims bytes 0 to -4 of 0; fetch the file again.",
        "foreign": "is a safetensors file, but not one of brdf's: its header is missing.",
        "null header": "null header is not a safetensors file: its header is not JSON.",
        "null tensor": "null tensor: its tensor 'a' claims bytes NaN to NaN of 0; fetch the file again.",
        "null metadata": "null metadata is a safetensors file, but not one of brdf's",
        "null description": "null description is a safetensors file, but not one of brdf's",
        "no parameters": "no parameters: the shader in it cannot be read (it has no list of parameters)",
        "newer": "was written by a newer brdf; make the page with that one.",
        "no gzip": "the shader in it cannot be read (",
        "old": "carries no shader: an earlier brdf wrote it, or it has no formula. Save it again, or bake it: ",
    }
    found = node(READ, *(tmp_path / name for name in expected), folder=tmp_path)
    for name, text in expected.items():
        assert text in found[str(tmp_path / name)].get("error", ""), (name, found[str(tmp_path / name)])
        assert "\n" not in found[str(tmp_path / name)]["error"]
