"""What an export writes, and what it refuses."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest
from tests.representations.synthetic_rgl import tensors

import brdf
from brdf import io
from brdf.errors import FileError, FormulaError, ParameterError, ReflectanceError, UnknownFormatError
from brdf.formula import Vec, texture2d
from brdf.models import GGX, SGD, Mirror
from brdf.parameters import Parameterised, texture
from brdf.representations.adaptive import Adaptive
from brdf.shaders.texels import images
from cards import HEADERS, GLCard, WebCard, texels
from helpers import random_directions

RNG = np.random.default_rng(4)


def example(text: str, start: str) -> str:
    """The lines of a shader's comment from the one that starts so to the end of the function."""
    commented = re.search(rf"^//     {start}.*?^//     }}$", text, re.M | re.S)
    return re.sub("^//     ", "", commented[0], flags=re.M)


@pytest.fixture
def ggx(tmp_path: Path) -> str:
    return brdf.export(GGX(alpha=0.125), tmp_path / "m.glsl").files[0].read_text("utf-8")


def test_the_glsl_of_ggx_reads_like_the_formula(ggx: str) -> None:
    body = ggx[ggx.index("\nvec3 brdf_GGX(vec3 wi, vec3 wo) {") :]
    for line in (
        "    if (wi.z <= 0.0 || wo.z <= 0.0) return vec3(0.0);",
        "    vec3 F = F0 + (1.0 - F0) * (t2 * (t3 * t3));",
        "    float stretched = t4 * t4 + t5 * t5 + h.z * h.z;",
        "    return max(F * (D * visibility / 4.0), 0.0);",
    ):
        assert f"{line}\n" in body
    assert "uniform float alpha;  // 0.125, in [0.0001, 1]: width of the distribution\n" in ggx
    assert "uniform vec3 F0;  // 0.04, 0.04, 0.04, in [0, 1]: reflectance at normal incidence\n" in ggx
    assert "1/sr, without the cosine" in ggx
    assert "#version" not in re.sub("//.*", "", ggx)
    assert "precision highp sampler3D;" in ggx


def test_the_description_holds_the_values_in_full(tmp_path: Path) -> None:
    done = brdf.export(GGX(alpha=0.1).named("My paint, No. 3"), tmp_path / "m.wgsl")
    assert done.function == "brdf_My_paint_No_3"
    assert [path.name for path in done.files] == ["m.wgsl", "m.wgsl.json"]
    description = json.loads(done.files[1].read_text("utf-8"))
    assert description["parameters"][0] == {
        "name": "alpha", "uniform": "alpha", "size": 1, "value": 0.1, "low": 1e-4, "high": 1.0, "unit": "1",
        "doc": "width of the distribution",
    }  # fmt: skip
    assert description["uniform_offsets"] == {"alpha": 0, "F0": 16}
    assert description["uniform_bytes"] == 32


@pytest.mark.parametrize("header", HEADERS)
@pytest.mark.parametrize("name", ["plain", "two-sided", "varying"])
def test_the_example_in_the_comment_compiles(name: str, header: str, gl: GLCard, tmp_path: Path) -> None:
    from every_kind import MODELS

    m = GGX() if name == "plain" else MODELS[name]()
    text = brdf.export(m, tmp_path / "m.glsl").files[0].read_text("utf-8")
    main = example(text, "in vec3 normal")
    varyings = "normal, tangent, to_light, to_viewer"
    place = "in vec2 uv;\n" if m.varies else ""
    vertex = f"""{HEADERS[header]}
        in vec3 position; out vec3 {varyings}; {place.replace("in", "out")}
        void main() {{ normal = tangent = to_light = to_viewer = position; gl_Position = vec4(position, 1.0); }}"""
    with gl.context:
        gl.context.program(vertex, fragment_shader=HEADERS[header] + text + place + main)


def test_the_example_of_wgsl_compiles(web: WebCard, tmp_path: Path) -> None:
    text = brdf.export(GGX(), tmp_path / "m.wgsl").files[0].read_text("utf-8")
    main = example(text, "@group.1")
    web.device.create_shader_module(code=text + main)


@pytest.mark.parametrize(
    ("samples", "kind"),
    [
        (np.arange(24) % 256 / np.float32(255), "8-bit"),
        (np.arange(24) * 40 % 1024 / np.float32(1023), "10-bit"),
        (RNG.normal(size=24).astype("f2"), "half"),
        (RNG.normal(size=24), "float"),
    ],
)
@pytest.mark.parametrize("channels", [1, 2, 3, 4])
def test_textures_keep_their_numbers_in_few_bits(samples: np.ndarray, kind: str, channels: int) -> None:
    data = np.resize(samples, (4, 3, 2, channels)).astype(np.float32)
    (image,) = images(data, {0: "grid"}, channels)
    assert image.size == (2, 3, 4)
    if kind != "10-bit" or channels == 3:
        assert image.kind == kind
    pixel_format, pixel_type = image.pixel_format
    described = {
        "offset": 0,
        "bytes": len(image.texels),
        "size": image.size,
        "format": pixel_format,
        "type": pixel_type,
    }
    np.testing.assert_array_equal(texels(described, image.texels)[0][..., :channels], data)


def test_a_slice_stack_keeps_its_size(tmp_path: Path) -> None:
    stack = brdf.SliceStack.bake(GGX(alpha=0.3), method="points")
    shader, _, data = brdf.export(stack, tmp_path / "m.glsl").files
    assert data.stat().st_size == stack.codes.nbytes < 1 << 14
    assert "uniform sampler3D grid;" in shader.read_text("utf-8")


class Made(Parameterised, brdf.Reflectance):
    """Base of reflectances made for a test."""

    def _state(self):
        return {}, {}


class LastChannels(Made):
    planes = texture("six channels", np.zeros((2, 2, 6)), 2, 6)

    def f(self, wi, wo):
        found = texture2d(self.planes, wi.z, wo.z)
        return Vec(found[3], found[5], found[4] * wi.z)


def test_groups_of_channels_that_are_not_used_are_left_out(gl: GLCard, tmp_path: Path) -> None:
    m = LastChannels(planes=RNG.random((5, 4, 6)))
    shader = brdf.export(m, tmp_path / "m.glsl").files[0]
    assert "uniform sampler2D planes_1;" in shader.read_text()
    assert "planes_0" not in shader.read_text()
    wi, wo = (random_directions(50, seed).astype("f4") for seed in (1, 2))
    np.testing.assert_allclose(gl.evaluate(shader, wi, wo, wi[:, :2]), m(wi, wo), rtol=2e-6)


def test_more_channels_than_four_become_several_textures(tmp_path: Path) -> None:
    data = RNG.random((5, 4, 6)).astype(np.float32)
    first, second = images(data, {0: "planes_0", 1: "planes_1"}, 3)
    for image, part in ((first, data[..., :3]), (second, data[..., 3:])):
        found = np.frombuffer(image.texels, "<f4").reshape(5, 4, 4)
        np.testing.assert_array_equal(found[..., :3], part)
    assert first.size == (4, 5)


# ---- mistakes ----------------------------------------------------------------------------------------------------


def test_another_extension_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UnknownFormatError, match=r"exports are .glsl, .wgsl, .html, .gltf, .mtlx, .pbrt, .py or .xml"):
        brdf.export(GGX(), tmp_path / "m.hlsl")


def test_what_has_no_formula_says_to_bake_first(tmp_path: Path) -> None:
    with pytest.raises(ReflectanceError, match=r"no formula to write as a shader; bake it first, as in `brdf convert"):
        brdf.export(Adaptive(tensors()), tmp_path / "m.glsl")
    assert list(tmp_path.iterdir()) == []


def test_a_function_name_that_is_none_is_refused(tmp_path: Path) -> None:
    for name in ("1st", "a b", "gl__x", "", "mix", "linear3"):
        with pytest.raises(ParameterError, match="letters, digits, single underscores, no gl_ in front"):
            brdf.export(GGX(), tmp_path / "m.glsl", name)
    with pytest.raises(ParameterError, match="must differ from the parameters' F0, alpha"):
        brdf.export(GGX(), tmp_path / "m.glsl", "alpha")


def test_names_and_sources_cannot_break_the_text(gl: GLCard, tmp_path: Path) -> None:
    wild = GGX().named("Löw–GGX\nvoid main() {}", "C:\\folder\\ */ × 2")
    shader = brdf.export(wild, tmp_path / "m.glsl").files[0]
    assert "vec3 brdf_Low_GGX_void_main(vec3 wi, vec3 wo) {" in shader.read_text("ascii")
    wi = np.array([[0, 0, 1]], "f4")
    np.testing.assert_allclose(gl.evaluate(shader, wi, wi, wi[:, :2]), wild(wi, wi), rtol=1e-6)


def test_textures_too_large_for_cards_are_refused() -> None:
    with pytest.raises(ReflectanceError, match="2 x 2 x 2049 texels does not fit graphics cards"):
        next(images(np.zeros((2049, 2, 2, 3), np.float32), {0: "grid"}, 3))


def test_numbers_beyond_single_precision_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match=r"Lambda = .* is beyond single precision"):
        brdf.export(SGD(Lambda=1e39), tmp_path / "m.glsl")

    class Faint(Made):
        def f(self, wi, wo):
            return Vec(wi.x, wi.y, wi.z * 1e-40)

    with pytest.raises(FormulaError, match="holds the constant 1e-40, which a shader's numbers cannot; rescale it"):
        brdf.export(Faint(), tmp_path / "m.glsl")


def test_a_folder_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(FileError, match="cannot be written"):
        brdf.export(GGX(), tmp_path / "none" / "m.glsl")


def test_a_mirror_says_what_is_left_out(tmp_path: Path) -> None:
    assert "a delta distribution, has no values" in brdf.export(Mirror(), tmp_path / "m.glsl").files[0].read_text()


def test_measured_rgl_is_told_to_bake(data: Path, tmp_path: Path) -> None:
    with pytest.raises(ReflectanceError, match="bake it first"):
        brdf.export(io.read(next((data / "rgl").glob("*.bsdf"))), tmp_path / "m.wgsl")
