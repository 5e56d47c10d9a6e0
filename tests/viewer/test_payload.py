"""What a page carries: read again, it is what was put in."""

from __future__ import annotations

import numpy as np
import pytest
from tests.representations.synthetic_rgl import tensors

import brdf
import containers
from brdf.errors import ParameterError, SceneError, UnknownNameError
from brdf.models import GGX, Lambertian, Mirror
from brdf.render import Directional, Environment, Mesh, Point
from brdf.render import mesh as meshes_of
from brdf.representations.adaptive import Adaptive
from brdf.representations.tables.merl import from_merl
from brdf.shaders import shader_of, stages
from brdf.viewer import environments, meshes
from brdf.viewer.blob import Blob, container
from brdf.viewer.payload import View, payload

RNG = np.random.default_rng(5)


@pytest.mark.parametrize("bits", [8, 16, 32])
@pytest.mark.parametrize("kind", ["noise", "ramp", "empty"])
def test_numbers_come_back(bits: int, kind: str) -> None:
    high = 1 << bits
    noise = RNG.integers(0, high, (101, 3))
    given = {"noise": noise, "ramp": np.arange(300).reshape(100, 3) * 7 % high, "empty": noise[:0]}[kind]
    blob = Blob()
    blob.add(b"x")
    place = blob.add_numbers(given, bits)
    assert place["offset"] == 4
    np.testing.assert_array_equal(containers.numbers(place, blob.joined()), given)
    if kind == "ramp":
        assert place["order"] > 0


def test_infinities_become_null_and_the_blob_is_aligned() -> None:
    blob = Blob()
    blob.add(b"abc")
    data = container({"psnr": float("inf"), "list": [float("nan"), 1.5], "name": "ü"}, blob)
    found, rest = containers.read(data)
    assert found == {"psnr": None, "list": [None, 1.5], "name": "ü"}
    assert rest == b"abc\0"


@pytest.mark.parametrize("name", ["teapot", "plane"])
def test_meshes_come_back_within_a_step(name: str) -> None:
    mesh, blob = meshes_of.load(name), Blob()
    about, data = meshes.described(mesh, blob), blob.joined()
    corners = containers.numbers(about["corners"], data)
    assert corners.shape == mesh.faces.shape
    least, greatest = np.array(about["least"]), np.array(about["greatest"])
    steps = containers.numbers(about["positions"], data)[corners] / meshes.LEVELS
    tolerance = (greatest - least) / meshes.LEVELS
    assert (np.abs(least + steps * (greatest - least) - mesh.vertices[mesh.faces]) <= tolerance).all()
    folded = containers.numbers(about["normals"], data)[corners] / meshes.LEVELS * 2 - 1
    normal = np.concatenate([folded, 1 - np.abs(folded).sum(-1, keepdims=True)], -1)
    below = np.maximum(-normal[..., 2:], 0)
    normal[..., :2] -= np.where(normal[..., :2] >= 0, below, -below)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    assert np.abs(normal - mesh.normals).max() < 1e-4
    uv = containers.numbers(about["uvs"], data)[corners] / meshes.LEVELS
    assert mesh.uvs is not None
    uv = np.array(about["uv_least"]) + uv * (np.array(about["uv_greatest"]) - about["uv_least"])
    assert np.abs(uv - mesh.uvs).max() < 1e-4
    assert about["nudge"] == mesh.nudge


def test_a_mesh_without_texture_coordinates_and_the_exact_sphere() -> None:
    corners = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0)], np.float32)
    flat = Mesh("flat", corners, np.array([[0, 1, 2]], np.int32), np.full((1, 3, 3), (0, 0, 1), np.float32))
    about = meshes.described(flat, Blob())
    assert not about["has_uv"]
    assert "uvs" not in about
    assert meshes.described(meshes_of.load("sphere"), Blob()) == {"name": "sphere", "kind": "sphere"}


def test_the_studio_is_kept_exactly_and_others_within_a_step() -> None:
    studio = View().chosen_env
    assert studio is not None
    dim = np.geomspace(1e-9, 1e4, 8 * 16 * 3).reshape(8, 16, 3).astype(np.float32)
    dim[0, 0] = 0
    for pixels, tolerance in ((studio.pixels, 0.0), (dim, 2**-8)):
        blob = Blob()
        about = environments.described(Environment(pixels, name="e"), blob)
        rgbe = containers.numbers(about["pixels"], blob.joined())
        radiance = np.ldexp(rgbe[:, :3].astype(float), rgbe[:, 3:] - 136).reshape(pixels.shape)
        assert (np.abs(radiance - pixels) <= tolerance * pixels.max(-1, keepdims=True)).all()


def test_large_environments_are_averaged_down() -> None:
    about = environments.described(Environment(np.ones((512, 1024, 3))), Blob())
    assert (about["width"], about["height"]) == (256, 128)


def test_a_page_has_the_materials_stages_shapes_and_lights() -> None:
    a, b = GGX(alpha=0.2), Lambertian(albedo=0.5)
    about, blob = containers.read(payload([a, b]))
    shader = shader_of(a)
    assert about["version"] == 1
    assert about["title"] == "GGX · Lambertian"
    assert about["materials"][0]["shader"] == shader.description
    assert about["materials"][0]["text"] == stages.material(shader)
    assert about["materials"][0]["texels"] is None
    assert about["comparison"]["psnr"] == pytest.approx(brdf.metrics.psnr(a, b))
    assert [mesh["name"] for mesh in about["meshes"]] == ["teapot", "sphere", "plane"]
    assert [environment["name"] for environment in about["environments"]] == ["studio", "constant 1"]
    assert all(stages.MATERIAL in about["stages"][name]["fragment"] for name in ("mesh", "sphere", "evaluate"))
    assert about["state"]["environment"] == "studio"
    stack = brdf.SliceStack.bake(a, method="points")
    about, blob = containers.read(payload([stack]))
    place = about["materials"][0]["texels"]
    assert blob[place["offset"] : place["offset"] + place["bytes"]] == shader_of(stack).texels
    assert about["comparison"] is None


def test_lights_are_as_the_renderer_takes_them() -> None:
    view = View(mesh="plane", lights=["directional:theta=30,phi=45,power=3", Point((1, 2, 3))], tone="clip")
    assert view.state == {
        "mesh": "plane",
        "lights": [
            {"kind": "directional", "theta": 30.0, "phi": 45.0, "power": [3.0, 3.0, 3.0]},
            {"kind": "point", "position": [1.0, 2.0, 3.0], "power": [1.0, 1.0, 1.0]},
        ],
        "environment": None,
        "turn": 0.0,
        "exposure": 0.0,
        "tone": "clip",
        "shadows": True,
    }
    turned = View(env=Environment(np.ones((8, 16, 3)), rotation=30))
    assert turned.state["turn"] == pytest.approx(30)
    both = View(lights=Directional(), env=0.5)
    assert both.state["environment"] == "constant 0.5"
    assert len(both.state["lights"]) == 1


def test_the_mask_of_a_measured_table() -> None:
    bins = RNG.choice([-1, 0.5], (90, 90, 180, 1)) * np.ones(3)
    measured = from_merl(bins.astype(np.float32))
    about, blob = containers.read(payload([measured]))
    (material,) = about["materials"]
    place = material["mask"]
    bits = np.unpackbits(np.frombuffer(blob, np.uint8, place["bytes"], place["offset"]), bitorder="little")
    assert material["mask_shape"] == [90, 90, 181]
    np.testing.assert_array_equal(bits[: measured.measured.size].reshape(90, 90, 181), measured.measured)


def test_what_has_no_formula_is_baked_and_says_so() -> None:
    measured = Adaptive(tensors())
    about, _ = containers.read(payload([measured]))
    (material,) = about["materials"]
    assert material["note"].startswith("Shown by its 16 KB slice stack, PSNR ")
    assert material["kind"] == "Adaptive"
    assert material["nbytes"] == measured.nbytes


def test_mirrors_say_what_is_missing() -> None:
    about, _ = containers.read(payload([Mirror()]))
    assert about["materials"][0]["note"] == "Its mirror part, a delta distribution, is not shown."


def test_mistakes() -> None:
    with pytest.raises(ParameterError, match="nothing to show"):
        payload([])
    with pytest.raises(SceneError, match="at most 8 lights, got 9"):
        View(lights=[Directional()] * 9)
    with pytest.raises(UnknownNameError, match="did you mean 'teapot'"):
        View(mesh="teapott")
    with pytest.raises(UnknownNameError, match="unknown tone curve 'film'"):
        View(tone="film")
