"""The viewer in a page: the pictures that the renderer in Python makes, and a state that others may write."""

from __future__ import annotations

import base64
import io
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from PIL import Image as Pictures

import brdf
from brdf.models import GGX, Lambertian
from brdf.render import Camera, Environment, Mesh
from brdf.render import environment as environments
from brdf.render import mesh as meshes
from brdf.render.mesh import corner_normals
from brdf.viewer.payload import View, payload
from cards import GLCard

if TYPE_CHECKING:
    from playwright.sync_api import Page

GOLD = GGX(alpha=0.3, F0=(1.0, 0.78, 0.34))
SATIN = 0.5 * Lambertian(albedo=(0.2, 0.3, 0.5)) + GGX(alpha=0.4)
LIGHTS = ("directional:theta=40,phi=50,power=1.5", "point:-3/4/2,power=20/18/14")

MOUNTED = """async ([data, options, width, height]) => {
    const { mount } = await import("./viewer.js");
    const root = document.createElement("div");
    root.style.cssText = `position: absolute; left: 0; top: 0; width: ${width}px; height: ${height}px`;
    document.body.replaceChildren(root);
    const style = document.createElement("link");
    style.rel = "stylesheet";
    style.href = "style.css";
    await new Promise((done) => { style.onload = done; document.head.append(style); });
    const bytes = Uint8Array.from(atob(data), (c) => c.charCodeAt(0));
    window.viewer = mount(root, bytes.buffer, options);
}"""

PNG = """async () => {
    const bytes = new Uint8Array(await (await viewer.png()).arrayBuffer());
    return btoa(Array.from(bytes, (b) => String.fromCharCode(b)).join(""));
}"""


def mounted(page: Page, data: bytes, width: int = 160, height: int = 120, **options: Any) -> None:
    options = {"embedded": True} | options
    page.evaluate(MOUNTED, [base64.b64encode(data).decode(), options, width, height])
    finished(page)


def finished(page: Page) -> None:
    page.wait_for_function("viewer.root.dataset.state === 'done'", timeout=60_000)


def picture(page: Page) -> np.ndarray[Any, Any]:
    png = Pictures.open(io.BytesIO(base64.b64decode(page.evaluate(PNG))))
    return np.asarray(png.convert("RGB"), np.int16)


def rendered(page: Page, m: Any, **scene: Any) -> np.ndarray[Any, Any]:
    """What Python draws for the camera of the page."""
    height, width, _ = picture(page).shape
    camera = Camera(**page.evaluate("viewer.camera()"))
    image = brdf.render(m, camera=camera, size=(width, height), backend="gl", supersampling=4, progress=False, **scene)
    return image.developed().astype(np.int16)


@pytest.mark.parametrize("mesh", ["teapot", "sphere", "plane"])
def test_lights_give_the_picture_that_python_draws(modules: Page, gl: GLCard, mesh: str) -> None:
    mounted(modules, payload([SATIN], View(mesh, LIGHTS)))
    found, expected = picture(modules), rendered(modules, SATIN, mesh=mesh, lights=LIGHTS)
    assert expected.std() > 10
    assert (np.abs(found - expected).max(-1) > 1).mean() < 2e-3  # the page's corners stand in steps of 16 bits
    assert np.abs(found - expected).mean() < 0.1


def fold() -> Mesh:
    """Two squares that meet in a line and shade each other."""
    vertices = np.array([(0, 0, 1), (0, 0, -1), (-1, 1, -1), (-1, 1, 1), (1, 0.7, -1), (1, 0.7, 1)], np.float32)
    faces = np.array([(0, 1, 2), (0, 2, 3), (0, 4, 1), (0, 5, 4)], np.int32)
    return Mesh("fold", vertices, faces, corner_normals(vertices, faces, 10).astype(np.float32))


def test_near_and_far_turned_and_shifted_it_is_the_same_picture(modules: Page, gl: GLCard) -> None:
    mounted(modules, payload([SATIN], View("sphere", LIGHTS)))
    for zoom in (0.5, 3):
        modules.evaluate("(zoom) => viewer.setState({ zoom, theta: 110, phi: -70, pan: [0.05, -0.02] })", zoom)
        finished(modules)
        expected = rendered(modules, SATIN, mesh="sphere", lights=LIGHTS)
        assert expected.std() > 10
        assert (np.abs(picture(modules) - expected).max(-1) > 1).mean() < 2e-3


def test_surroundings_give_the_picture_that_python_draws_but_for_noise(modules: Page, gl: GLCard) -> None:
    mounted(modules, payload([SATIN], View(fold(), env="studio")), 96, 96)
    scene: dict[str, Any] = {"mesh": fold(), "env": "studio", "samples": 256}
    expected = rendered(modules, SATIN, **scene)
    assert np.abs(picture(modules) - expected).mean() < 0.5
    assert np.abs(rendered(modules, SATIN, **scene | {"shadows": False}) - expected).mean() > 1.5
    modules.evaluate("viewer.setState({ turn: 90, strength: 2, background: 'environment' })")
    finished(modules)
    scene["env"] = Environment(2 * environments.load("studio").pixels, rotation=90)
    print("turned")
    turned = rendered(modules, SATIN, **scene, background="environment")
    assert np.abs(picture(modules) - turned).mean() < 0.5
    assert np.abs(turned - expected).mean() > 6


PASSES = """async () => {
    const { Picture } = await import("./renderer.js");
    const { renderer, gl } = viewer;
    const [shot] = viewer.shots();
    const brightness = (numbers) => {
        const picture = new Picture();
        picture.restart(shot.width, shot.height);
        for (const number of numbers) {
            renderer.draw(shot, { number, place: [0.5, 0.5], samples: 4, total: 256 }, 0, shot.height);
            renderer.add(picture);
        }
        picture.mean.use(shot.width, shot.height);
        const pixels = new Float32Array(4 * shot.width * shot.height);
        gl.readPixels(0, 0, shot.width, shot.height, gl.RGBA, gl.FLOAT, pixels);
        picture.dispose();
        return pixels.reduce((sum, value, i) => sum + (i % 4 === 1 ? value : 0), 0);
    };
    const all = brightness(Array(64).keys());
    return [0, 1, 2, 3].map((number) => brightness([number]) / all);
}"""


def test_the_first_pass_under_surroundings_is_noisy_but_not_dark(modules: Page) -> None:
    mounted(modules, payload([GGX(alpha=0.3)], View("sphere", env="studio")), 96, 96)
    assert modules.evaluate(PASSES) == pytest.approx([1, 1, 1, 1], abs=0.05)


@pytest.mark.parametrize("mesh", ["teapot", "sphere"])
def test_a_shape_is_framed_as_python_frames_it(modules: Page, mesh: str) -> None:
    data = base64.b64encode(payload([GOLD], View(mesh))).decode()
    target, distance = modules.evaluate(
        """async (data) => {
            const { framing } = await import("./camera.js");
            const { decode } = await import("./payload.js");
            const { decodedMesh } = await import("./mesh.js");
            const contents = decode(Uint8Array.from(atob(data), (c) => c.charCodeAt(0)).buffer);
            const half = Math.tan(Math.PI / 12);
            const { target, distance } = framing(decodedMesh(contents.meshes[0], contents).points, [half * 1.5, half]);
            return [target, distance];
        }""",
        data,
    )
    camera = Camera.framing(meshes.load(mesh), aspect=1.5)
    np.testing.assert_allclose(target, camera.target, atol=2e-3)
    assert distance == pytest.approx(np.linalg.norm(camera.position - camera.target), rel=1e-3)


@pytest.mark.parametrize("kind", ["directional:theta=40,phi=50,power=2", "point:-3/4/2,power=40"])
def test_a_light_is_dragged_by_its_reflection(modules: Page, kind: str) -> None:
    mounted(modules, payload([GGX(alpha=0.05)], View("sphere", kind)))
    for place in ((60, 70), (95, 85), (80, 55)):
        modules.evaluate("(place) => viewer.moveLight(0, place)", place)
        finished(modules)
        bright = picture(modules).sum(-1) == picture(modules).sum(-1).max()
        row, column = (np.mean(index) + 0.5 for index in np.nonzero(bright))
        assert np.hypot(column - place[0], row - place[1]) < 1.5
        handle = modules.evaluate("""() => {
            const box = document.querySelector(".handle").getBoundingClientRect();
            return [box.x + box.width / 2, box.y + box.height / 2];
        }""")
        np.testing.assert_allclose(handle, place, atol=0.5)


def test_the_driver_of_chromium_itself_draws_the_same(modules: Page, modules_on_itself: Page) -> None:
    data = payload([SATIN], View(fold(), env="studio"))
    found = []
    for page in (modules, modules_on_itself):
        mounted(page, data, 64, 96)
        found.append(picture(page))
    assert "SwiftShader" in modules_on_itself.evaluate("""
        viewer.gl.getParameter(viewer.gl.getExtension("WEBGL_debug_renderer_info").UNMASKED_RENDERER_WEBGL)""")
    assert found[0].std() > 10
    assert np.abs(found[1] - found[0]).mean() < 0.5


def test_two_materials_are_compared(modules: Page, gl: GLCard) -> None:
    mounted(modules, payload([GOLD, SATIN], View("sphere", LIGHTS[:1]), compare=False))
    whole = {}
    for which in ("first", "second", "split", "difference"):
        modules.evaluate("(compare) => viewer.setState({ compare, divider: 0.25, gain: 2 })", which)
        finished(modules)
        whole[which] = picture(modules)
    np.testing.assert_array_equal(whole["split"][:, :40], whole["first"][:, :40])
    np.testing.assert_array_equal(whole["split"][:, 40:], whole["second"][:, 40:])
    difference = np.minimum(2 * np.abs(whole["first"] - whole["second"]), 255)
    assert difference.max() > 100
    assert np.abs(whole["difference"] - difference).max() <= 2  # of two rounded values, twice
    modules.evaluate("viewer.setState({ compare: 'side', parameters: [{}, {}] })")
    finished(modules)
    shots = modules.evaluate("viewer.shots().map((shot) => [shot.width, shot.height])")
    assert shots == [[80, 120], [80, 120]]


def test_a_lost_context_comes_back(modules: Page) -> None:
    mounted(modules, payload([GOLD], View("teapot", LIGHTS[:1])))
    before = picture(modules)
    modules.evaluate("""async () => {
        const lost = viewer.gl.getExtension("WEBGL_lose_context");
        const back = new Promise((done) => viewer.canvas.addEventListener("webglcontextrestored", done));
        lost.loseContext();
        await new Promise((done) => setTimeout(done, 50));
        lost.restoreContext();
        await back;
    }""")
    finished(modules)
    np.testing.assert_array_equal(picture(modules), before)


def test_parameters_are_set_within_their_bounds_and_reset(modules: Page, gl: GLCard) -> None:
    mounted(modules, payload([GOLD], View("sphere", LIGHTS[:1])))
    modules.evaluate("viewer.setState({ parameters: [{ alpha: 0.1, F0: [2, 0.5, -1], unknown: 3 }, {}] })")
    finished(modules)
    assert modules.evaluate("viewer.slots.at(0).values") == {"alpha": 0.1, "F0": [1, 0.5, 0]}
    expected = rendered(modules, GGX(alpha=0.1, F0=(1, 0.5, 0)), mesh="sphere", lights=LIGHTS[0])
    assert np.abs(picture(modules) - expected).max() <= 1
    modules.evaluate("viewer.setState({ parameters: [{}, {}] })")
    finished(modules)
    assert modules.evaluate("viewer.slots.at(0).values") == {"alpha": 0.3, "F0": [1, 0.78, 0.34]}


def test_a_state_passes_through_the_address(modules: Page) -> None:
    mounted(modules, payload([GOLD, SATIN], View("sphere", LIGHTS)))
    found = modules.evaluate("""async () => {
        const { decodedHash, encoded, merged } = await import("./state.js");
        const patch = { theta: 30.5, phi: 123456.789, turn: -400,
            lights: [{ kind: "point", position: [1, 2, 3], power: [1, 2, 0.5] }],
            compare: "side", environment: null, tone: "clip", parameters: [{ alpha: 0.5 }, {}] };
        const state = merged(viewer.home, patch, viewer.choices);
        const hash = encoded(state, viewer.home);
        const again = merged(viewer.home, decodedHash("#" + hash), viewer.choices);
        return [hash, encoded(again, state) === "", encoded(viewer.home, viewer.home),
            Math.abs(state.phi - 336.789) < 1e-6 && hash.includes("phi=336.79&"), again.turn];
    }""")
    assert found[1:] == [True, "", True, -40]
    assert len(found[0]) < 400


INVALID: list[dict[str, Any]] = [
    {"mesh": "dragon"}, {"theta": "NaN"}, {"zoom": None}, {"materials": [0, 7]}, {"lights": [{"kind": "directional"}]},
    {"tone": "loud"}, {"parameters": 3}, {"pan": [1]}, {"environment": "moon"}, {"constructor": 1}, {"shadows": 1},
]  # fmt: skip


def test_what_is_not_valid_of_a_state_is_passed_over(modules: Page) -> None:
    data = base64.b64encode(payload([GOLD], View("sphere"))).decode()
    state, *patched = modules.evaluate(
        """async ([data, patches]) => {
            const { decode } = await import("./payload.js");
            const { initialState, merged } = await import("./state.js");
            const contents = decode(Uint8Array.from(atob(data), (c) => c.charCodeAt(0)).buffer);
            const state = initialState(contents);
            return [state, ...patches.map((patch) => merged(state, patch, contents))];
        }""",
        [data, INVALID],
    )
    assert patched == [state] * len(INVALID)


@pytest.mark.parametrize(("data", "message"), [
    (b"", "cut short"), (b"\xff\xff\xff\xff{}", "cut short"), (b"\x0d\0\0\0{\"version\":2}", "has version 2, not 1"),
])  # fmt: skip
def test_what_is_no_payload_is_said_in_a_sentence(modules: Page, data: bytes, message: str) -> None:
    with pytest.raises(Exception, match=message):
        mounted(modules, data)
